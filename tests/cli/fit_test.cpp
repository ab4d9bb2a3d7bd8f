// Density grids made here, fitted by Gaussians.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "media/fit.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

DensityGrid made(int size, const std::function<double(double x, double y, double z)> &density)
{
    DensityGrid grid{{size, size, size}, {}};
    for (int z = 0; z < size; ++z)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                grid.values.push_back(float(density(x, y, z)));
    return grid;
}

double value(const FittedGaussian &g, double x, double y, double z)
{
    const double dx = x - g.center[0], dy = y - g.center[1], dz = z - g.center[2];
    return g.amplitude * std::exp(-g.scale * g.scale * (dx * dx + dy * dy + dz * dz));
}

double sum(const std::vector<FittedGaussian> &gaussians, double x, double y, double z)
{
    double total = 0;
    for (const FittedGaussian &g : gaussians)
        total += value(g, x, y, z);
    return total;
}

// What the fit says of its error, from the Gaussians it gave.
double residual(const DensityGrid &grid, const Fit &fit)
{
    double difference = 0, total = 0;
    for (int z = 0; z < grid.size[2]; ++z)
        for (int y = 0; y < grid.size[1]; ++y)
            for (int x = 0; x < grid.size[0]; ++x) {
                const double v = grid.values[grid.index(x, y, z)], d = v - sum(fit.gaussians, x, y, z);
                difference += d * d;
                total += v * v;
            }
    return std::sqrt(difference / total);
}

void report(const char *what, const DensityGrid &grid, const Fit &fit)
{
    std::printf("%s: %zu Gaussians, residual %.5f, mass error %+.5f\n", what, fit.gaussians.size(), fit.residual,
                fit.mass_error);
    EXPECT_NEAR(residual(grid, fit), fit.residual, 1e-4 + 0.01 * fit.residual);
    for (const FittedGaussian &g : fit.gaussians)
        EXPECT_GT(g.amplitude, 0);
}

TEST(Fit, OneGaussianComesBack)
{
    const FittedGaussian one{{14.3, 17.8, 15.1}, 1 / 4.7, 2.5};
    const DensityGrid grid = made(32, [&](double x, double y, double z) { return value(one, x, y, z); });
    const Fit fit = fit_gaussians(grid, 1, 0);
    report("one", grid, fit);
    ASSERT_EQ(fit.gaussians.size(), 1u);
    EXPECT_LT(fit.residual, 1e-4);
    EXPECT_NEAR(fit.gaussians[0].center[0], 14.3, 1e-3);
    EXPECT_NEAR(fit.gaussians[0].center[1], 17.8, 1e-3);
    EXPECT_NEAR(fit.gaussians[0].scale, 1 / 4.7, 1e-4);
    EXPECT_NEAR(fit.gaussians[0].amplitude, 2.5, 1e-3);
}

TEST(Fit, ASumOfGaussiansComesBack)
{
    std::mt19937_64 random(5);
    const auto between = [&](double from, double to) { return from + (to - from) * double(random() >> 11) * 0x1p-53; };
    std::vector<FittedGaussian> sources;
    for (int i = 0; i < 20; ++i)
        sources.push_back({{between(10, 38), between(10, 38), between(10, 38)}, 1 / between(2, 5), between(0.3, 1)});
    const DensityGrid grid = made(48, [&](double x, double y, double z) { return sum(sources, x, y, z); });
    const Fit fit = fit_gaussians(grid, 60, 0.005);
    report("twenty", grid, fit);
    EXPECT_LE(fit.gaussians.size(), 60u);
    EXPECT_LE(fit.residual, 0.01);
    EXPECT_NEAR(fit.mass_error, 0, 0.01);
}

TEST(Fit, ASphereTakesManyAndEndsNearIt)
{
    const auto ball = [](double x, double y, double z) {
        return std::clamp(14.5 - std::sqrt((x - 20) * (x - 20) + (y - 20) * (y - 20) + (z - 20) * (z - 20)), 0.0, 1.0);
    };
    const DensityGrid grid = made(41, ball);
    double before = 1;
    for (const std::size_t most : {1, 20, 200}) {
        const Fit fit = fit_gaussians(grid, most, 0);
        report("sphere", grid, fit);
        EXPECT_LT(fit.residual, 0.8 * before);
        before = fit.residual;
        if (most > 1) {
            EXPECT_NEAR(fit.mass_error, 0, 0.15);
        }
    }
    // An edge that Gaussians can only blur.
    EXPECT_LT(before, 0.2);
}

TEST(Fit, IsTheSameEveryTime)
{
    const DensityGrid grid = made(20, [](double x, double y, double z) { return x > 5 && y > 7 && z < 12 ? 1 : 0; });
    const Fit a = fit_gaussians(grid, 30, 0), b = fit_gaussians(grid, 30, 0);
    ASSERT_EQ(a.gaussians.size(), b.gaussians.size());
    for (std::size_t i = 0; i < a.gaussians.size(); ++i) {
        EXPECT_EQ(a.gaussians[i].center, b.gaussians[i].center);
        EXPECT_EQ(a.gaussians[i].scale, b.gaussians[i].scale);
        EXPECT_EQ(a.gaussians[i].amplitude, b.gaussians[i].amplitude);
    }
}

TEST(Fit, OddGridsComeToAnEnd)
{
    EXPECT_TRUE(fit_gaussians(made(5, [](double, double, double) { return 0; }), 10, 0).gaussians.empty());
    const DensityGrid point = made(9, [](double x, double y, double z) { return x == 4 && y == 4 && z == 4 ? 1 : 0; });
    const Fit spike = fit_gaussians(point, 10, 0);
    report("a voxel", point, spike);
    EXPECT_LT(spike.residual, 0.3);
    const DensityGrid single = made(1, [](double, double, double) { return 3; });
    const Fit one = fit_gaussians(single, 10, 1e-3);
    report("one voxel alone", single, one);
    EXPECT_LT(one.residual, 0.01);
    const DensityGrid flat = made(12, [](double, double, double) { return 1; });
    const Fit full = fit_gaussians(flat, 50, 0);
    report("constant", flat, full);
    EXPECT_LT(full.residual, 0.1);
}

}  // namespace
}  // namespace brume::tests
