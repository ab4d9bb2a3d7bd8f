#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace brume::tool {

/// Density at the corners of a lattice of unit cubes; x changes fastest.
struct DensityGrid {
    std::array<int, 3> size{};
    std::vector<float> values;

    std::size_t index(int x, int y, int z) const
    {
        return (std::size_t(z) * std::size_t(size[1]) + std::size_t(y)) * std::size_t(size[0]) + std::size_t(x);
    }
};

/// amplitude exp(-scale^2 |x - center|^2), in the grid's lattice.
struct FittedGaussian {
    std::array<double, 3> center;
    double scale, amplitude;
};

struct Fit {
    std::vector<FittedGaussian> gaussians;
    double residual = 0;    ///< root of the sum of squared differences over that of squared densities
    double mass_error = 0;  ///< of the Gaussians' whole mass against the grid's, as a share of it
};

/// Gaussians whose sum comes near the grid: placed where most of what is left can be explained, at every size at once, then
/// moved, resized and weighed (never below zero) by least squares, in rounds. Stops at `most` Gaussians or where the
/// residual is `error`. The same grid gives the same bits.
Fit fit_gaussians(const DensityGrid &grid, std::size_t most, double error);

}  // namespace brume::tool
