#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace brume::tool {

constexpr int kHarmonicOrder = 6;  ///< l = 0 to 5
constexpr int kHarmonics = kHarmonicOrder * kHarmonicOrder;
using HarmonicsRgb = std::array<std::array<double, 3>, kHarmonics>;

/// Real spherical harmonics of a unit vector: orthonormal, without the Condon-Shortley phase, l = 0, 1, ..., m = -l to l.
std::array<double, kHarmonics> harmonics(const std::array<double, 3> &direction);

/// A lat-long image, or what its file has of it.
struct LatLong {
    int width, height;              ///< of the whole sphere
    int x, y, columns, rows;        ///< the window of it that `pixels` cover
    std::span<const float> pixels;  ///< row by row from the top left
    int stride;                     ///< floats a pixel, of which the first three are radiance
};

/// World direction of a place in the image: u from its left, v from its top, 0 to 1; `up` is BRUME_UP_...
std::array<double, 3> latlong_direction(double u, double v, std::uint32_t up);

/// The radiance projected on the harmonics. Negative values and those that are not finite count as 0.
HarmonicsRgb project_latlong(const LatLong &image, std::uint32_t up);

}  // namespace brume::tool
