// The default kernel's stencils on random levels: the texels that the library's functions gather, in float, and the sums
// that the CPU takes for pixels side by side, against the same functions in double.
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "calibrated/passes.h"
#include "lanes.hpp"

namespace multiscatter {
namespace {

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;
namespace maths_float = brume::maths_float;

#define BRUME_LANES_BODY "calibrated/rows.inc"
#include "lanes_bodies.inc"
#define BRUME_LANES_BODY "stencils_probe.inc"
#include "lanes_bodies.inc"

// One stack of levels, of one channel or four, in both precisions.
struct Stack {
    Stack(int width_, int height_, int channels_, unsigned seed) : width(width_), height(height_), channels(channels_)
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> u(0.1f, 1);
        for (int i = 0; i < width * height * channels; ++i)
            single.push_back(u(random) < 0.15f ? 50 * u(random) : u(random));
        wide.assign(single.begin(), single.end());
    }
    f32::Texture in_float() const { return {single.data(), width * channels, width, height, channels}; }
    f64::Texture in_double() const { return {wide.data(), width * channels, width, height, channels}; }
    brume_plugin_pixels pixels() const
    {
        return {const_cast<float *>(single.data()), width * channels, width, height, channels, 0};
    }

    int width, height, channels;
    std::vector<float> single;
    std::vector<double> wide;
};

struct Levels {
    f32::Level single;
    f64::Level wide;
};

Levels level(int width, int height, double beyond, int row)
{
    // What a float holds, so that both precisions look at the same place.
    const f32::vec2 extent(float(width - beyond), float(height - 0.5 * beyond));
    return {{{width, height}, extent, row}, {{width, height}, f64::vec2(extent), row}};
}

// The picture may end anywhere within the last texels; levels lie below each other.
std::vector<Levels> levels()
{
    std::vector<Levels> all;
    for (auto [width, height] : {std::pair(37, 11), {16, 9}, {9, 3}, {5, 6}, {2, 2}, {1, 4}, {1, 1}})
        for (double beyond : {0.0, 0.37, 0.81})
            all.push_back(level(width, height, beyond, 4));
    return all;
}

constexpr int stack_width = 40, stack_height = 20;

template <class Single, class Wide> void expect_close(const Single &found, const Wide &expected, const char *what)
{
    for (int c = 0; c < 4; ++c)
        // Where the picture ends, 37 texels on, is known to 2e-6 of a texel, and the last texel's share may be a fifth.
        ASSERT_NEAR(found[c], expected[c], 1e-5 * (1 + std::abs(expected[c]))) << what << " channel " << c;
}

TEST(Stencils, InFloatAsInDouble)
{
    const Stack radiance(stack_width, stack_height, 4, 1), coverage(stack_width, stack_height, 1, 2);
    const f32::Texture r = radiance.in_float(), k = coverage.in_float();
    const f64::Texture rr = radiance.in_double(), kk = coverage.in_double();
    for (const auto &[single, wide] : levels())
        for (int y = -3; y < single.size.y + 3; ++y)
            for (int x = -3; x < single.size.x + 3; ++x) {
                SCOPED_TRACE(testing::Message() << single.size.x << " x " << single.size.y << ", extent " << single.extent.x
                                                << " at " << x << ", " << y);
                const f32::ivec2 at(x, y);
                for (float beyond : {0.0f, 0.5f})
                    expect_close(f32::level_texel(r, single, at, beyond, false),
                                 f64::level_texel(rr, wide, at, beyond, false), "texel");
                if (f32::lies_within(single, at, at))
                    expect_close(f32::level_texel(r, single, at, 0.5f, true), f64::level_texel(rr, wide, at, 0.5, false),
                                 "texel known to lie within");
                const f32::LevelSum four = f32::finer_sum(r, k, single, at, false),
                                    five = f32::smoothed_sum(r, k, single, at, false);
                const f64::LevelSum wide_four = f64::finer_sum(rr, kk, wide, at, false),
                                    wide_five = f64::smoothed_sum(rr, kk, wide, at, false);
                expect_close(four.radiance, wide_four.radiance, "4 x 4");
                expect_close(four.coverage, wide_four.coverage, "4 x 4, coverage");
                expect_close(five.radiance, wide_five.radiance, "5 x 5");
                expect_close(five.coverage, wide_five.coverage, "5 x 5, coverage");
            }
}

template <class Rows> void expect_rows(Rows rows)
{
    const Stack radiance(stack_width, stack_height, 4, 3), coverage(stack_width, stack_height, 1, 4);
    const f64::Texture rr = radiance.in_double(), kk = coverage.in_double();
    for (const auto &[single, wide] : levels())
        for (int y = 0; y < single.size.y; ++y)
            for (int x = 0; x < single.size.x; ++x) {
                SCOPED_TRACE(testing::Message() << single.size.x << " x " << single.size.y << ", extent " << single.extent.x
                                                << " at " << x << ", " << y);
                const f64::LevelSum five = f64::smoothed_sum(rr, kk, wide, {x, y}, false);
                expect_close(rows.smoothed(single, radiance.pixels(), x, y), five.radiance, "5 x 5");
                expect_close(rows.smoothed(single, coverage.pixels(), x, y), f64::vec4(five.coverage.x), "5 x 5, coverage");
                if (2 * x >= single.size.x || 2 * y >= single.size.y)
                    continue;
                const f64::LevelSum four = f64::finer_sum(rr, kk, wide, {2 * x - 1, 2 * y - 1}, false);
                expect_close(rows.finer(single, radiance.pixels(), x, y), four.radiance, "4 x 4");
                expect_close(rows.finer(single, coverage.pixels(), x, y), f64::vec4(four.coverage.x), "4 x 4, coverage");
                f64::Calibrated settings{};
                expect_close(rows.surroundings(single, radiance.pixels(), x, y),
                             f64::ambient_texel(settings, rr, kk, rr, wide, {x, y}, 2), "2 x 2");
            }
}

TEST(Stencils, SideBySideAsInDouble)
{
    expect_rows(generic::Rows());
#ifdef BRUME_AVX2
    if (brume::runs_avx2())
        expect_rows(avx2::Rows());
#endif
}

}  // namespace
}  // namespace multiscatter
