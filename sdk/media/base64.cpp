#include "media/base64.h"

#include <cstdint>

namespace brume::media {
namespace {

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64_of(std::string_view bytes)
{
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t j = 0; j < 3; ++j)
            group = group << 8 | (i + j < bytes.size() ? uint8_t(bytes[i + j]) : 0u);
        for (size_t j = 0; j < 4; ++j)
            text += i + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63];
    }
    return text;
}

std::optional<std::string> bytes_of_base64(std::string_view text)
{
    if (text.size() % 4 != 0)
        return std::nullopt;
    const size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (size_t i = 0; i < text.size(); i += 4) {
        uint32_t group = 0;
        for (size_t j = i; j < i + 4; ++j) {
            const size_t digit = j + padding >= text.size() ? 0 : digits.find(text[j]);
            if (digit == std::string_view::npos)
                return std::nullopt;
            group = group << 6 | uint32_t(digit);
        }
        for (int shift = 16; shift >= 0; shift -= 8)
            bytes += char(group >> shift & 255);
    }
    bytes.resize(bytes.size() - padding);
    return bytes;
}

}  // namespace brume::media
