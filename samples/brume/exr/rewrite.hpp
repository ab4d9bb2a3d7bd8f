#pragma once

#include "image/write.hpp"

namespace brume::tool {

/// Writes the frame's pixels over the colour channels of a copy of the OpenEXR file that it came from. Parts without colour
/// are copied undecoded.
WriteReport rewrite_exr(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                        const WriteOptions &options = {});

}  // namespace brume::tool
