#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace brume::tool {

/// Damaged files put control characters and broken UTF-8 into names, and megabytes of them; a message may quote them, a
/// terminal must not obey them.
inline std::string printable(std::string text)
{
    constexpr std::size_t most = 4096;
    if (text.size() > most)
        text.replace(most, std::string::npos, " ...");
    for (char &c : text)
        if ((unsigned char)c < 0x20 || c == 0x7f)
            c = '?';
    return text;
}

inline std::vector<std::string> split(const std::string &text, char at)
{
    std::vector<std::string> parts;
    std::size_t from = 0;
    for (std::size_t to; (to = text.find(at, from)) != std::string::npos; from = to + 1)
        parts.push_back(text.substr(from, to - from));
    parts.push_back(text.substr(from));
    return parts;
}

/// Whether the whole text is a finite number.
inline bool parse_number(std::string_view text, double &value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace brume::tool
