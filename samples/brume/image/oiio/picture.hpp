#pragma once

#include "image/library.hpp"

namespace brume::tool {

std::unique_ptr<PictureSource> open_picture(const std::filesystem::path &file, const std::string &format,
                                            const ReadLimits &limits);

std::vector<std::string> write_picture(const std::filesystem::path &file, const std::string &final_name,
                                       const std::string &format, const Raster &raster);

std::vector<float> shrink_picture(const float *pixels, int channels, int width, int height, int to_width, int to_height);

Display draw_sheet(const std::vector<Display> &cells, const std::vector<std::string> &labels);

}  // namespace brume::tool
