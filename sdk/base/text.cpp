#include "base/text.h"

#include <fmt/format.h>

namespace brume {
namespace {

constexpr size_t longest_quote = 80;

// Bytes of the well-formed character at the head of `text`, 0 if there is none (Unicode, table 3-7).
size_t character_length(std::string_view text)
{
    auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : uint8_t(0); };
    auto continues = [&](size_t i) { return (byte(i) & 0xc0) == 0x80; };
    const uint8_t lead = byte(0), second = byte(1);
    if (lead < 0x80)
        return text.empty() ? 0 : 1;
    if (lead >= 0xc2 && lead <= 0xdf)
        return continues(1) ? 2 : 0;
    if (lead >= 0xe0 && lead <= 0xef) {
        const bool overlong = lead == 0xe0 && second < 0xa0;
        const bool surrogate = lead == 0xed && second > 0x9f;
        return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (lead >= 0xf0 && lead <= 0xf4) {
        const bool overlong = lead == 0xf0 && second < 0x90;
        const bool beyond = lead == 0xf4 && second > 0x8f;
        return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
    }
    return 0;
}

}  // namespace

bool valid_utf8(std::string_view text)
{
    while (!text.empty()) {
        const size_t length = character_length(text);
        if (length == 0)
            return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string in_quotes(std::string_view text)
{
    std::string out = "\"";
    while (!text.empty()) {
        if (out.size() > longest_quote)
            return out + "...\"";
        const size_t length = character_length(text);
        const bool printable = length > 1 || (length == 1 && uint8_t(text[0]) >= 0x20 && text[0] != 0x7f);
        if (printable)
            out += text.substr(0, length);
        else
            out += '?';
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return out + '"';
}

std::string bytes_text(uint64_t bytes)
{
    const bool large = bytes >= 100'000'000;
    return fmt::format("{:.1f} {}", double(bytes) * (large ? 1e-9 : 1e-6), large ? "GB" : "MB");
}

std::string image_text(int32_t width, int32_t height, int32_t channels, const char *sample, uint64_t bytes)
{
    return fmt::format("{} x {} x {} {}{}, {}", width, height, channels, sample, channels == 1 ? "" : "s",
                       bytes_text(bytes));
}

}  // namespace brume
