#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "metrics/metrics.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

Picture flat(int width, int height, float value)
{
    return {0, 0, width, height, std::vector<float>(3 * std::size_t(width) * std::size_t(height), value)};
}

TEST(Metrics, EqualPicturesDifferInNothing)
{
    const Picture p = flat(7, 5, 0.3f);
    const Metrics m = measure(p, p);
    EXPECT_EQ(m.relative_mse, 0);
    EXPECT_EQ(m.log2_rms, 0);
    EXPECT_EQ(m.max_difference, 0);
    EXPECT_EQ(m.different, 0u);
    EXPECT_DOUBLE_EQ(m.energy, 1);
}

TEST(Metrics, FollowTheirDefinitionsOnFlatPictures)
{
    const Metrics m = measure(flat(8, 8, 3), flat(8, 8, 2));
    EXPECT_NEAR(m.relative_mse, 1 / (4 + 0.01), 1e-12);
    EXPECT_NEAR(m.log2_rms, std::log2(1.52) - std::log2(1.02), 1e-12);
    EXPECT_NEAR(m.energy, 1.5, 1e-12);
    EXPECT_EQ(m.max_difference, 1);
}

TEST(Metrics, AverageOverTwoByTwoAndThreeByThree)
{
    // 36 more in one pixel is 9 in its 2 x 2 block and 1 in each of nine blocks, of 6 x 6.
    const Picture reference = flat(12, 12, 1);
    Picture a = reference;
    const std::size_t lit = 3 * (5 * 12 + 5);
    for (std::size_t c = 0; c < 3; ++c)
        a.rgb[lit + c] += 36;
    const Metrics m = measure(a, reference);
    EXPECT_NEAR(m.relative_mse, 9.0 / 36 / (1 + 0.0025), 1e-12);
    EXPECT_EQ(m.max_difference, 36);
    EXPECT_EQ(m.max_x, 5);
    EXPECT_EQ(m.max_y, 5);
    EXPECT_EQ(m.different, 1u);
}

TEST(Metrics, LeaveOutAndCountWhatIsNotFinite)
{
    Picture a = flat(6, 6, 1), r = flat(6, 6, 1);
    a.rgb[0] = std::numeric_limits<float>::quiet_NaN();
    r.rgb[3] = a.rgb[3] = std::numeric_limits<float>::infinity();
    const Metrics m = measure(a, r);
    EXPECT_EQ(m.relative_mse, 0);
    EXPECT_EQ(m.not_finite_a, 2u);
    EXPECT_EQ(m.not_finite_reference, 1u);
    EXPECT_EQ(m.not_finite_mismatch, 1u);
    EXPECT_EQ(m.different, 1u);
}

TEST(Metrics, TheMeanDifferenceHasASign)
{
    Picture a = flat(4, 1, 1);
    a.rgb[0] = a.rgb[1] = a.rgb[2] = 0.5f;
    EXPECT_DOUBLE_EQ(measure(a, flat(4, 1, 1)).mean_difference, -0.125);
    EXPECT_DOUBLE_EQ(measure(flat(4, 1, 1), a).mean_difference, 0.125);
    a.rgb[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_DOUBLE_EQ(measure(a, flat(4, 1, 1)).mean_difference, -1.0 / 11) << "of what is finite in both";
}

TEST(Metrics, WhatIsMaskedDoesNotCount)
{
    const Picture r = flat(6, 6, 1);
    Picture a = r;
    a.rgb[3 * 14] = 5;
    a.rgb[3 * 15] = std::numeric_limits<float>::quiet_NaN();
    Mask mask(36, 1);
    mask[14] = mask[15] = 0;
    const Metrics m = measure(a, r, kRec709Luminance, mask);
    EXPECT_EQ(m.relative_mse, 0);
    EXPECT_EQ(m.log2_rms, 0);
    EXPECT_EQ(m.max_difference, 0);
    EXPECT_EQ(m.mean_difference, 0);
    EXPECT_EQ(m.different, 0u);
    EXPECT_EQ(m.not_finite_mismatch, 0u);
    EXPECT_EQ(m.pixels, 34u);
    EXPECT_DOUBLE_EQ(m.energy, 1);
    EXPECT_GT(measure(a, r).max_difference, 0);
}

TEST(Metrics, AlphaCountsAsDifferent)
{
    Picture a = flat(2, 2, 1), r = a;
    a.alpha = {1, 1, 1, 1};
    r.alpha = {1, 1, 0, 1};
    EXPECT_EQ(measure(a, r).different, 1u);
    EXPECT_EQ(measure(a, a).different, 0u);
}

TEST(Metrics, AreDefinedForTheSmallestAndTheBlack)
{
    const Metrics one = measure(flat(1, 1, 2), flat(1, 1, 1));
    EXPECT_NEAR(one.energy, 2, 1e-12);
    const Metrics black = measure(flat(3, 2, 0), flat(3, 2, 0));
    EXPECT_EQ(black.relative_mse, 0);
    EXPECT_EQ(black.energy, 1);
}

TEST(Metrics, CropToWhatIsCommon)
{
    Picture a = flat(4, 4, 1), b = flat(4, 4, 2);
    b.x = 2;
    b.y = -1;
    crop_to_common(a, b);
    EXPECT_EQ(a.width, 2);
    EXPECT_EQ(a.height, 3);
    EXPECT_EQ(a.rgb.size(), b.rgb.size());
    Picture far = flat(2, 2, 1);
    far.x = 100;
    crop_to_common(a, far);
    EXPECT_TRUE(a.rgb.empty());
}

}  // namespace
}  // namespace brume::tests
