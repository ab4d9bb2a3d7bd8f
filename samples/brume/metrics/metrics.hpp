#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace brume::tool {

/// RGB radiance over a window of the picture plane.
struct Picture {
    int x = 0, y = 0, width = 0, height = 0;
    std::vector<float> rgb;
    std::vector<float> alpha = {};  ///< empty where there is none

    std::size_t index(int column, int row) const { return std::size_t(row) * std::size_t(width) + std::size_t(column); }
    const float *at(int column, int row) const { return rgb.data() + 3 * index(column, row); }
};

struct Metrics {
    double relative_mse = 0;
    double log2_rms = 0;
    double energy = 0;          ///< mean luminance of a over that of the reference
    double max_difference = 0;  ///< before any averaging, over RGB
    int max_x = 0, max_y = 0, max_channel = 0;
    double max_a = 0, max_reference = 0;
    double mean_difference = 0;  ///< mean of a - reference, with its sign, before any averaging, over what is finite in both
    std::uint64_t pixels = 0;    ///< that were compared
    std::uint64_t not_finite_a = 0, not_finite_reference = 0;  ///< pixels with a NaN or an Inf
    std::uint64_t not_finite_mismatch = 0;                     ///< components that are NaN, +Inf or -Inf in one only
    std::uint64_t different = 0;                               ///< pixels that are not equal, alpha included
};

/// One byte a pixel, row by row: those of 0 are not compared. Empty: all are.
using Mask = std::vector<std::uint8_t>;
inline bool is_compared(const Mask &mask, std::size_t pixel)
{
    return mask.empty() || mask[pixel] != 0;
}

using LuminanceWeights = std::array<double, 3>;
constexpr LuminanceWeights kRec709Luminance{0.2126, 0.7152, 0.0722};

/// Whether neither is finite in the same way, or both are finite.
bool same_kind(float a, float b);

/// Both pictures must cover the same window, with alpha in both or in neither. relMSE and log2 RMS are taken after a 2x2 box
/// average and a 3x3 box filter; averages run over what is finite in both, and borders average what lies inside.
Metrics measure(const Picture &a, const Picture &reference, const LuminanceWeights &weights = kRec709Luminance,
                const Mask &mask = {});

/// Means over squares of 2 reach + 1 pixels a side, of what is finite inside the picture.
Picture box_blurred(const Picture &picture, int reach);

/// The parts of both that lie in the intersection of their windows; empty pictures where they are disjoint.
void crop_to_common(Picture &a, Picture &b);

}  // namespace brume::tool
