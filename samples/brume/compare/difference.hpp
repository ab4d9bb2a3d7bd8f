#pragma once

#include <string>

#include "metrics/metrics.hpp"

namespace brume::tool {

/// Throws RequestError where the name ends neither in .png nor in .exr.
void check_difference_name(const std::string &path);

/// |A - B|: as radiance in an EXR; in a PNG scaled so that the largest shows as white.
void write_difference(const std::string &path, const Picture &a, const Picture &b, double largest);

}  // namespace brume::tool
