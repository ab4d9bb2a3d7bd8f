#include <limits>

#include <gtest/gtest.h>

#include "metrics/limits.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

Picture flat(int width, int height, float value)
{
    return {0, 0, width, height, std::vector<float>(3 * std::size_t(width) * std::size_t(height), value)};
}

Verdict judged(const Picture &a, const Picture &r, const Limits &limits, const Mask &mask = {})
{
    return judge(a, r, measure(a, r, kRec709Luminance, mask), limits, mask);
}

bool within(const Picture &a, const Picture &r, const Limits &limits, const Mask &mask = {})
{
    return judged(a, r, limits, mask).beyond.empty();
}

TEST(Limits, WithoutAnyAllIsWithin)
{
    EXPECT_TRUE(within(flat(3, 3, 1), flat(3, 3, 9), {}));
}

TEST(Limits, OfTheMeansAreLargestValues)
{
    const Picture a = flat(8, 8, 3), r = flat(8, 8, 2);
    const Metrics m = measure(a, r);
    Limits limits;
    limits.max_relmse = m.relative_mse;
    limits.max_log2 = m.log2_rms;
    limits.energy = {1.4, 1.5};
    EXPECT_TRUE(within(a, r, limits));
    limits.max_relmse = m.relative_mse * 0.999;
    limits.max_log2 = m.log2_rms * 0.999;
    limits.energy = {1.4, 1.49};
    EXPECT_EQ(judged(a, r, limits).beyond.size(), 3u);
    limits.energy = {1.51, 2};
    EXPECT_EQ(judged(a, r, limits).beyond.size(), 3u);
}

TEST(Limits, AFigureThatDoesNotExistKeepsNone)
{
    Limits limits;
    limits.energy = {0, 1e9};
    EXPECT_FALSE(within(flat(2, 2, 1), flat(2, 2, 0), limits)) << "the energy ratio is NaN";
}

// What idiff 2.4 says of 10 against 10.5: absolute and relative threshold must both be passed, relative is to the mean.
TEST(Limits, OfPixelsMeanWhatIdiffMeans)
{
    const Picture a = flat(10, 10, 10), r = flat(10, 10, 10.5f);
    const auto fails = [&](Limits limits) { return judged(a, r, limits).failing; };
    EXPECT_EQ(fails({.fail = 0.5}), 0u);
    EXPECT_EQ(fails({.fail = 0.49}), 100u);
    EXPECT_EQ(fails({.fail_relative = 0.049}), 0u);
    EXPECT_EQ(fails({.fail_relative = 0.0482}), 100u) << "it is 0.0488 of the mean, and 0.0476 of the larger";
    EXPECT_EQ(fails({.fail = 0.6, .fail_relative = 0.001}), 0u);
    EXPECT_EQ(fails({.fail_percent = 1}), 100u) << "--fail is 1e-6 then";
    EXPECT_TRUE(within(a, r, {.fail_percent = 100}));
    EXPECT_FALSE(within(a, r, {.fail_percent = 99}));
    EXPECT_TRUE(within(a, r, {.allow = 100}));
    EXPECT_FALSE(within(a, r, {.allow = 99}));
    EXPECT_FALSE(within(a, r, {.fail_percent = 100, .hard_fail = 0.1}));
    EXPECT_TRUE(within(a, r, {.hard_fail = 0.1, .allow = 100}));
    EXPECT_FALSE(within(a, r, {.fail = 0.6, .hard_fail = 0.1})) << "of any pixel, unlike idiff's";
}

TEST(Limits, TheFirstPixelThatFailsIsNamed)
{
    Picture a = flat(5, 4, 1), r = a;
    a.x = r.x = 100;
    a.rgb[3 * 13 + 1] = 2;
    const Verdict verdict = judged(a, r, {.fail = 0.5});
    EXPECT_EQ(verdict.failing, 1u);
    EXPECT_EQ(verdict.first_x, 103);
    EXPECT_EQ(verdict.first_y, 2);
    ASSERT_EQ(verdict.beyond.size(), 1u);
    EXPECT_NE(verdict.beyond[0].find("(103, 2)"), std::string::npos) << verdict.beyond[0];
}

TEST(Limits, ASearchRadiusForgivesWhatHasMovedButNotWhatIsGone)
{
    Picture a = flat(9, 9, 0), r = a;
    const auto light = [](Picture &p, std::size_t x, std::size_t y) { p.rgb[3 * (y * 9 + x)] = 7; };
    light(r, 4, 4);
    EXPECT_FALSE(within(a, r, {.fail = 0.1, .search_radius = 2})) << "a lamp that A lacks";
    EXPECT_FALSE(within(r, a, {.fail = 0.1, .search_radius = 2})) << "a lamp that B lacks";
    light(a, 6, 3);
    EXPECT_FALSE(within(a, r, {.fail = 0.1}));
    EXPECT_FALSE(within(a, r, {.fail = 0.1, .search_radius = 1}));
    EXPECT_TRUE(within(a, r, {.fail = 0.1, .hard_fail = 1, .search_radius = 2}));
}

TEST(Limits, MaskedPixelsPassAndAreNoNeighbours)
{
    Picture a = flat(4, 1, 0), r = a;
    a.rgb[3] = 5;
    r.rgb[6] = 5;
    EXPECT_TRUE(within(a, r, {.fail = 0.1, .search_radius = 1}));
    const Mask first_two{1, 1, 0, 1};
    EXPECT_EQ(judged(a, r, {.fail = 0.1, .search_radius = 1}, first_two).failing, 1u);
    const Mask ends{1, 0, 0, 1};
    EXPECT_TRUE(within(a, r, {.fail = 0.1}, ends));
}

TEST(Limits, WhatIsNotFiniteInOneOnlyIsBeyondEveryLimit)
{
    for (const float odd : {kNan, kInf, -kInf}) {
        Picture a = flat(5, 5, 1), r = a;
        a.rgb[20] = odd;
        for (const Limits &limits :
             {Limits{}, Limits{.fail = 1e30, .fail_percent = 100, .allow = 1000, .search_radius = 3}}) {
            EXPECT_FALSE(within(a, r, limits));
            EXPECT_FALSE(within(r, a, limits));
        }
        r.rgb[20] = odd;
        EXPECT_TRUE(within(a, r, {.fail = 0}));
        r.rgb[20] = odd == kInf ? -kInf : kInf;
        EXPECT_FALSE(within(a, r, {})) << "not finite in another way";
        Mask mask(25, 1);
        mask[6] = 0;
        EXPECT_TRUE(within(a, r, {.fail = 0}, mask));
    }
}

TEST(Limits, AlphaIsAComponent)
{
    Picture a = flat(2, 1, 1), r = a;
    a.alpha = {1, 1};
    r.alpha = {1, 0.5f};
    EXPECT_EQ(judged(a, r, {.fail = 0.1}).failing, 1u);
    r.alpha[1] = kNan;
    EXPECT_FALSE(within(a, r, {}));
}

}  // namespace
}  // namespace brume::tests
