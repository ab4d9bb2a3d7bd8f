// The default kernel's stencils on random levels: the texels that the library's functions gather, in float, and the sums
// that the CPU takes for pixels side by side, against the same functions in double.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
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

// expect(Rows) for each set of instructions.
template <class Expect> void on_each_machine(Expect expect)
{
    expect(generic::Rows());
#ifdef BRUME_AVX2
    if (brume::runs_avx2())
        expect(avx2::Rows());
#endif
}

TEST(Stencils, SideBySideAsInDouble)
{
    on_each_machine([](auto rows) { expect_rows(rows); });
}

// With lines of one texel either way, and the smallest that has two.
const std::pair<int, int> sizes[] = {{37, 11}, {16, 9}, {9, 3}, {5, 6}, {2, 2}, {1, 9}, {19, 1}, {1, 1}};

// What the squares, the first surroundings and what is brought from squares to pixels are, written down once more in double.
f64::vec3 color_of(const Stack &stack, int x, int y)
{
    const double *v = &stack.wide[size_t((y * stack.width + x) * stack.channels)];
    return stack.channels == 1 ? f64::vec3(v[0]) : f64::vec3(v[0], v[1], v[2]);
}

Stack with_bad_pixels(Stack stack)
{
    for (size_t i = 0; i < stack.single.size(); i += 7)
        stack.wide[i] = stack.single[i] =
            i % 3 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    return stack;
}

struct PlainSquare {
    f64::vec3 color{0};
    int x, y;
    double share = 0;
};

// density: no more than 0 where pixels have no part in it.
PlainSquare plain_square(const Stack &picture, const Stack &density, const f64::vec3 &weights, int reduction, int column,
                         int row)
{
    PlainSquare square{.x = column * reduction, .y = row * reduction};
    double most = -1;
    int count = 0, fogged = 0;
    for (int y = row * reduction; y < (row + 1) * reduction && y < picture.height; ++y)
        for (int x = column * reduction; x < (column + 1) * reduction && x < picture.width; ++x, ++count) {
            if (density.wide[size_t(2 * (y * density.width + x))] <= 0)
                continue;
            ++fogged;
            f64::vec3 color = color_of(picture, x, y);
            for (int c = 0; c < 3; ++c)
                color[c] = std::isfinite(color[c]) ? color[c] : 0;
            square.color += color;
            if (const double seen = dot(weights, color); seen > most) {
                most = seen;
                square.x = x;
                square.y = y;
            }
        }
    square.color /= std::max(double(fogged), 1.0);
    square.share = double(fogged) / count;
    return square;
}

f64::vec4 plain_surroundings(const Stack &radiance, const Stack &coverage, int column, int row)
{
    f64::vec4 sum(0);
    for (int y = 2 * row; y <= 2 * row + 1 && y < radiance.height; ++y)
        for (int x = 2 * column; x <= 2 * column + 1 && x < radiance.width; ++x) {
            const f64::vec3 light = color_of(radiance, x, y), covered = color_of(coverage, x, y);
            if (covered.x + covered.y + covered.z == 0)
                continue;
            for (int c = 0; c < 3; ++c)
                sum[c] += 0.25 * std::pow(light[c] / covered[c], 0.25);
            sum.w += 0.25;
        }
    return sum;
}

f64::Collected plain_upsampled(const Stack &radiance, const Stack &coverage, int reduction, double distance, int x, int y)
{
    const double column = double(x - reduction / 2) / reduction, row = double(y - reduction / 2) / reduction,
                 left = std::floor(column), top = std::floor(row);
    double sum = 0, nearest = 1e30;
    f64::Collected mean{f64::vec3(0), f64::vec3(0)}, of_nearest = mean;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int at = std::clamp(int(left) + i, 0, radiance.width - 1),
                      over = std::clamp(int(top) + j, 0, radiance.height - 1);
            const f64::vec3 light = color_of(radiance, at, over), covered = color_of(coverage, at, over);
            const double other = radiance.wide[size_t((over * radiance.width + at) * 4 + 3)],
                         gap = std::abs(other - distance) / (other + distance),
                         weight = (i ? column - left : 1 - (column - left)) * (j ? row - top : 1 - (row - top)) *
                                  std::pow(1 + 300 * gap * gap, -4);
            sum += weight;
            mean.radiance += weight * light;
            mean.coverage += weight * covered;
            if (gap < nearest) {
                nearest = gap;
                of_nearest = {light, covered};
            }
        }
    if (sum <= 1e-3)
        return of_nearest;
    return {mean.radiance / sum, mean.coverage / sum};
}

template <class Single> void expect_three(const Single &found, const f64::vec3 &expected, const char *what)
{
    for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(found[c], expected[c], 1e-5 * (1 + std::abs(expected[c]))) << what << " channel " << c;
}

template <class Rows> void expect_plain_squares(Rows rows)
{
    const f32::vec3 weights(0.25f, 0.625f, 0.125f);
    for (auto [width, height] : sizes)
        for (int reduction : {1, 2, 4}) {
            const Stack picture = with_bad_pixels(Stack(width, height, 4, 5));
            Stack density(width, height, 2, 11);
            for (size_t i = 0; i < density.single.size(); i += 6)
                density.single[i] = 0, density.wide[i] = 0;
            for (int y = 0; y < (height + reduction - 1) / reduction; ++y)
                for (int x = 0; x < (width + reduction - 1) / reduction; ++x) {
                    SCOPED_TRACE(testing::Message()
                                 << width << " x " << height << " by " << reduction << ", " << x << ", " << y);
                    const auto found = rows.square(picture.pixels(), density.pixels(), weights, reduction, x, y);
                    const PlainSquare expected = plain_square(picture, density, f64::vec3(weights), reduction, x, y);
                    expect_three(found.color, expected.color, "mean");
                    ASSERT_NEAR(found.share, expected.share, 1e-6);
                    ASSERT_EQ(found.brightest.x, expected.x);
                    ASSERT_EQ(found.brightest.y, expected.y);
                }
        }
}

template <class Rows> void expect_plain_surroundings(Rows rows)
{
    for (auto [width, height] : sizes)
        for (int channels : {1, 4}) {
            const Stack radiance(width, height, 4, 6);
            Stack coverage(width, height, channels, 7);
            for (int i = 0; i < width * height; i += 5)
                for (int c = 0; c < channels; ++c)
                    coverage.wide[size_t(i * channels + c)] = coverage.single[size_t(i * channels + c)] = 0;
            for (int y = 0; y < (height + 1) / 2; ++y)
                for (int x = 0; x < (width + 1) / 2; ++x) {
                    SCOPED_TRACE(testing::Message()
                                 << width << " x " << height << ", " << channels << " channels, " << x << ", " << y);
                    expect_close(rows.first_of_surroundings(radiance.pixels(), coverage.pixels(), x, y),
                                 plain_surroundings(radiance, coverage, x, y), "surroundings");
                }
        }
}

template <class Rows> void expect_plain_upsampling(Rows rows)
{
    std::mt19937 random(8);
    for (auto [width, height] : sizes)
        for (int reduction : {2, 4})
            for (int channels : {1, 4}) {
                const f32::ivec2 base = f32::reduced_size({width, height}, reduction);
                const Stack radiance(base.x, base.y, 4, 9), coverage(base.x, base.y, channels, 10);
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x) {
                        // As far as a square near by, or as none.
                        const int near = std::min(y / reduction, base.y - 1) * base.x + std::min(x / reduction, base.x - 1);
                        const float distance = random() % 4 == 0 ? 900.0f : 1.03f * radiance.single[size_t(4 * near + 3)];
                        SCOPED_TRACE(testing::Message() << width << " x " << height << " by " << reduction << ", "
                                                        << channels << " channels, " << x << ", " << y);
                        const f32::Collected found =
                            rows.upsampled_at(radiance.pixels(), coverage.pixels(), reduction, width, distance, x, y);
                        const f64::Collected expected =
                            plain_upsampled(radiance, coverage, reduction, double(distance), x, y);
                        expect_three(found.radiance, expected.radiance, "radiance");
                        expect_three(found.coverage, expected.coverage, "coverage");
                    }
            }
}

TEST(Stencils, SquaresAsInDouble)
{
    on_each_machine([](auto rows) { expect_plain_squares(rows); });
}

TEST(Stencils, FirstSurroundingsAsInDouble)
{
    on_each_machine([](auto rows) { expect_plain_surroundings(rows); });
}

TEST(Stencils, UpsampledAsInDouble)
{
    on_each_machine([](auto rows) { expect_plain_upsampling(rows); });
}

}  // namespace
}  // namespace multiscatter
