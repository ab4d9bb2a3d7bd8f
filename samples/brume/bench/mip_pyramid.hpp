#pragma once

#include <array>
#include <vector>

#include "metrics/metrics.hpp"

namespace brume::tool {

/// Halved images as engines make them for glows: the mean of four pixels, then 5 x 5 binomial taps.
class MipPyramid {
public:
    /// Pixels brighter than `luminance_cap` are made as bright as it on every level but the first.
    MipPyramid(const Picture &image, float luminance_cap);

    /// Between pixels and levels linearly, at the middle of a pixel of the image; edges repeat. Level 0 is the image.
    std::array<float, 3> at(int x, int y, float level) const;

private:
    std::vector<Picture> levels_;
};

}  // namespace brume::tool
