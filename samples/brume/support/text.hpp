#pragma once

#include <string>

namespace brume::tool {

/// Damaged files put control characters and broken UTF-8 into names; a message may quote them, a terminal must not obey
/// them.
inline std::string printable(std::string text)
{
    for (char &c : text)
        if ((unsigned char)c < 0x20 || c == 0x7f)
            c = '?';
    return text;
}

}  // namespace brume::tool
