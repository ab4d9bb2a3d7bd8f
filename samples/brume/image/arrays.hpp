#pragma once

#include "image/file.hpp"
#include "image/formats.hpp"
#include "image/library.hpp"

namespace brume::tool {

/// Files that are a short header before an array of numbers, which OpenImageIO does not read: PFM and NumPy's NPY.
bool is_array(const Format &format);

/// NPY arrays of two dimensions, or of three whose last one are channels, in either order of bytes and of dimensions. Throws
/// FrameError.
std::unique_ptr<PictureSource> open_array(const std::filesystem::path &file, const Format &format, const ReadLimits &limits);

/// Of floats. Errors name `final_name`.
void write_array(const std::filesystem::path &file, const std::string &final_name, const Format &format,
                 const Raster &raster);

}  // namespace brume::tool
