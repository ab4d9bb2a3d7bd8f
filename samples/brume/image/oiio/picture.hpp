#pragma once

#include "image/library.hpp"

namespace brume::tool {

std::unique_ptr<PictureSource> open_picture(const std::filesystem::path &file, const std::string &format,
                                            const ReadLimits &limits);

std::vector<std::string> write_picture(const std::filesystem::path &file, const std::string &final_name,
                                       const std::string &format, const Raster &raster);

}  // namespace brume::tool
