#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace brume::tool {

/// Eight bits a channel, RGB, display-encoded. Written beside and renamed, as every output.
void write_png(const std::filesystem::path &file, int width, int height, const std::vector<std::uint8_t> &rgb);

}  // namespace brume::tool
