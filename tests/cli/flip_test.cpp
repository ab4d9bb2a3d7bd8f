#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "metrics/flip.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

constexpr int kSide = 48;

/// A smooth picture with lamps, times `scale`.
Picture scene(float scale = 1)
{
    Picture p{0, 0, kSide, kSide, {}};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const float v = 0.2f + 0.15f * std::sin(0.3f * float(x)) * std::cos(0.2f * float(y));
            const bool lamp = (x % 24) == 12 && (y % 24) == 12;
            for (const float tint : {1.0f, 0.8f, 0.6f})
                p.rgb.push_back(scale * tint * (lamp ? 40 : v));
        }
    return p;
}

/// The scene with every value off by this share, up and down in turns.
Picture noisy(float share)
{
    Picture p = scene();
    for (std::size_t i = 0; i < p.rgb.size(); ++i)
        p.rgb[i] *= (i / 3 * 2654435761u >> 16) % 2 ? 1 + share : 1 - share;
    return p;
}

TEST(HdrFlip, EqualPicturesAreNoughtApart)
{
    EXPECT_EQ(hdr_flip(scene(), scene()), 0);
    const Picture black{0, 0, 4, 3, std::vector<float>(36, 0.0f)};
    EXPECT_EQ(hdr_flip(black, black), 0);
}

TEST(HdrFlip, GrowsWithTheDifferenceAndStaysBelowOne)
{
    double last = 0;
    for (const float share : {0.02f, 0.05f, 0.1f, 0.3f, 0.6f, 0.95f}) {
        const double flip = hdr_flip(noisy(share), scene());
        EXPECT_GT(flip, last) << share;
        EXPECT_LT(flip, 1) << share;
        last = flip;
    }
    for (const float scale : {1.05f, 1.2f, 2.0f, 8.0f}) {
        const double flip = hdr_flip(scene(scale), scene());
        EXPECT_GT(flip, scale == 1.05f ? 0 : last) << scale;
        last = flip;
    }
}

TEST(HdrFlip, IsNearlySymmetric)
{
    const double one = hdr_flip(noisy(0.3f), scene()), other = hdr_flip(scene(), noisy(0.3f));
    EXPECT_NEAR(one, other, 0.1 * one);
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfRadiance)
{
    const double one = hdr_flip(scene(1.3f), scene());
    EXPECT_NEAR(hdr_flip(scene(1.3f * 64), scene(64)), one, 1e-4);
}

// A grey picture of one value has one exposure, at which it is .85; the paper's formulas then need no filter.
TEST(HdrFlip, OfFlatGreysFollowsTheFormulas)
{
    const auto flat = [](float v) { return Picture{0, 0, 32, 32, std::vector<float>(3 * 32 * 32, v)}; };
    const auto aces = [](double x) { return (0.9036 * x + 0.018) * x / ((0.8748 * x + 0.354) * x + 0.14); };
    const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
    // .85 (.8748 x^2 + .354 x + .14) = .9036 x^2 + .018 x
    const double a = 0.9036 - 0.85 * 0.8748, b = 0.018 - 0.85 * 0.354, c = -0.85 * 0.14;
    const double bright = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    const double off = std::pow(lightness(0.85) - lightness(aces(bright / 2)), 0.7);
    // HyAB of Hunt-adjusted green and blue, to .7, worked out by hand from the primaries' XYZ.
    const double largest = 41.2760;
    const double flip = 0.95 * off / (0.4 * largest);
    ASSERT_LT(off, 0.4 * largest);
    EXPECT_NEAR(hdr_flip(flat(1), flat(2)), flip, 2e-3);
}

TEST(HdrFlip, TakesWhatIsNotFiniteForBlack)
{
    Picture a = scene(), b = scene();
    a.rgb[30] = std::numeric_limits<float>::quiet_NaN();
    b.rgb[30] = std::numeric_limits<float>::infinity();
    const double flip = hdr_flip(a, b);
    EXPECT_EQ(flip, 0);
}

}  // namespace
}  // namespace brume::tests
