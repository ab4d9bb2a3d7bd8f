#pragma once
#include <string>
#include <string_view>

namespace brume {

bool valid_utf8(std::string_view text);

// Text of unknown origin for a message: in quotes, printable, of bounded length.
std::string in_quotes(std::string_view text);

}  // namespace brume
