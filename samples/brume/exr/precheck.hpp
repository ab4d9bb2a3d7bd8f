#pragma once

#include <filesystem>

#include "image/limits.hpp"

namespace brume::tool {

/// Walks the headers byte by byte and refuses what would make a decoder allocate or loop without bound. The OpenEXR
/// library allocates an attribute before it knows whether the file is long enough to hold it, hence this pass first.
/// Throws FrameError naming file, part, attribute, value and what was expected.
void precheck_headers(const std::filesystem::path &file, const ReadLimits &limits);

}  // namespace brume::tool
