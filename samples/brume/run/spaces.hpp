#pragma once

#include <string>
#include <vector>

#include "colour/color_manager.hpp"
#include "frames/pattern.hpp"
#include "image/file.hpp"

namespace brume::tool {

/// The colour spaces of a run: what was asked for, and where nothing was, what the first picture that opens says of itself
/// and what the output can hold. Integers go out as they came in, and become scene-linear in a format of floats. Throws
/// RequestError where radiance would have to fit into integers, or integers are of no known space.
ColorRequest spaces_of(const ColorRequest &asked, const std::vector<FrameFile> &files, const std::string &output,
                       const std::string &output_type, const LayerRequest &layers, const ReadLimits &limits);

/// Throws FrameError where a picture says of its pixels what the request does not.
void check_space(const ImageFile &file, const ColorRequest &asked, const ColorRequest &used);

}  // namespace brume::tool
