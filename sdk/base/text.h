#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace brume {

bool valid_utf8(std::string_view text);

// Text of unknown origin for a message: in quotes, printable, of bounded length.
std::string in_quotes(std::string_view text);

// "1.6 GB"
std::string bytes_text(uint64_t bytes);

// "12288 x 8192 x 4 floats, 1.6 GB", for the message of what could not be had. `sample`: "float" or "half".
std::string image_text(int32_t width, int32_t height, int32_t channels, const char *sample, uint64_t bytes);

}  // namespace brume
