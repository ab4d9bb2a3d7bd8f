// Pixels side by side (lanes.hpp): as exact as one by one, and the same bits with every set of instructions.
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "lanes.hpp"
#include "scene_maths.hpp"

namespace {

namespace f32 = brume::maths_float;

#define BRUME_LANES_BODY "lanes_probe.inc"
#include "lanes_bodies.inc"

#ifdef BRUME_AVX2
// What `call` gives in either namespace, which must be the same bits where the machine has both.
#define IN_BOTH(call) same_bits(generic::call, brume::runs_avx2() ? avx2::call : generic::call)
#else
#define IN_BOTH(call) generic::call
#endif

[[maybe_unused]] std::vector<float> same_bits(const std::vector<float> &a, const std::vector<float> &b)
{
    EXPECT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i)
        EXPECT_EQ(std::bit_cast<uint32_t>(a[i]), std::bit_cast<uint32_t>(b[i])) << i << ": " << a[i] << " and " << b[i];
    return a;
}

std::vector<float> uniform(int count, float least, float most)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> between(least, most);
    std::vector<float> values(static_cast<size_t>(count));
    for (float &v : values)
        v = between(random);
    return values;
}

// In units of the last place of the exact result, at most `bound`.
template <class Exact>
void expect_close(const std::vector<float> &x, const std::vector<float> &found, Exact exact, double bound)
{
    double worst = 0;
    size_t at = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double expected = exact(double(x[i]));
        const double off = std::abs(found[i] - expected) / std::ldexp(1.0, std::max(std::ilogb(expected), -126) - 23);
        if (!(off <= worst)) {
            worst = off;
            at = i;
        }
    }
    printf("worst %.2f units of the last place at %g\n", worst, x[at]);
    EXPECT_LE(worst, bound) << x[at] << " gives " << found[at];
}

TEST(Lanes, Exponentials)
{
    const std::vector<float> x = uniform(1 << 20, -87.2f, 87.9f);
    expect_close(
        x, IN_BOTH(exponentials(x)), [](double v) { return std::exp(v); }, 2);
    const std::vector<float> near = uniform(1 << 16, -0.01f, 0.01f);
    expect_close(
        near, IN_BOTH(exponentials(near)), [](double v) { return std::exp(v); }, 1);
    const std::vector<float> y = uniform(1 << 20, -125.9f, 126.9f);
    expect_close(
        y, IN_BOTH(powers_of_two(y)), [](double v) { return std::exp2(v); }, 2);
}

TEST(Lanes, ExponentialsAtTheEnds)
{
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> x{-inf, -1e30f, -88, 0, 1e-30f, 88, inf, nan};
    const std::vector<float> e = IN_BOTH(exponentials(x));
    EXPECT_EQ(e[0], 0);
    EXPECT_EQ(e[1], 0);
    EXPECT_EQ(e[2], 0);
    EXPECT_EQ(e[3], 1);
    EXPECT_EQ(e[4], 1);
    EXPECT_GT(e[5], 1.6e38f);
    EXPECT_EQ(e[6], e[5]);
    EXPECT_TRUE(std::isnan(e[7]));
}

TEST(Lanes, Logarithms)
{
    std::vector<float> x = uniform(1 << 20, -99, 99);
    for (float &v : x)
        v = std::exp2(v);
    // Beside 1, where the result is small, in units of 2^-24.
    const std::vector<float> found = IN_BOTH(logarithms(x));
    double worst = 0;
    for (size_t i = 0; i < x.size(); ++i)
        worst =
            std::max(worst, std::abs(found[i] - std::log2(double(x[i]))) / std::max(std::abs(std::log2(double(x[i]))), 1.0));
    EXPECT_LT(worst, 2e-7);
    const std::vector<float> near = uniform(1 << 16, 0.8f, 1.2f);
    expect_close(
        near, IN_BOTH(logarithms(near)), [](double v) { return std::log2(v); }, 3);
}

// As maths.hpp reads one pixel by one, between texels, beyond edges, in narrow levels.
TEST(Lanes, FetchesAsPixelsOneByOne)
{
    for (int channels : {1, 4}) {
        const int width = 37, height = 23;
        const std::vector<float> data = uniform(width * height * channels, 0, 1);
        const f32::Texture image{data.data(), width * channels, width, height, channels};
        for (const f32::ivec2 size : {f32::ivec2(37, 11), {19, 6}, {9, 3}, {4, 2}, {1, 1}})
            for (float step : {0.5f, 0.25f, 0.03125f})
                for (float y : {-0.5f, -0.1f, 0.3f, 2.75f, float(size.y) - 0.6f})
                    for (float x = -0.75f; x < float(size.x); x += 0.9f) {
                        const std::vector<float> found = IN_BOTH(fetched(image, size, 12, x, y, step));
                        for (int i = 0; i < 8; ++i) {
                            const f32::Region region{size, 12};
                            const f32::vec2 position(x + float(i) * step, y);
                            f32::vec4 expected(0);
                            if (channels == 1)
                                expected.x = f32::fetch_linear_channel(image, region, position, 0);
                            else
                                expected = f32::fetch_linear(image, region, position);
                            for (int c = 0; c < 4; ++c)
                                ASSERT_NEAR(found[size_t(i * 4 + c)], expected[c], 1e-6)
                                    << size.x << "x" << size.y << " at " << position.x << ", " << y << " channel " << c;
                        }
                    }
    }
}

TEST(Lanes, LooksUpAsPixelsOneByOne)
{
    // Of more than one row of a data image.
    const std::vector<float> data = uniform(2048, 0, 1);
    const f32::Texture table{data.data(), 1024, 1024, 2, 1};
    const std::vector<float> places = uniform(64, -2, 40);
    for (int first : {0, 100, 1000, 1023, 1500}) {
        const std::vector<float> found = IN_BOTH(looked_up(table, first, 32, places));
        for (size_t i = 0; i < places.size(); ++i)
            ASSERT_NEAR(found[i], f32::data_between(table, first, 32, places[i]), 1e-6) << first << " at " << places[i];
    }
}

// Every kind of depth and sky, with depths that count as far, as near, as nothing.
TEST(Lanes, PixelsAsOneByOne)
{
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> depths{0, -0.0f, -1, nan, inf, -inf, 1, 0.5f, 1e-30f, 1e30f, 3e38f, 1e-42f, 0.99f, 1.01f, 50, 1000};
    brume_plugin_medium m{};
    brume_plugin_camera c{};
    brume_plugin_scene scene{};
    scene.medium = &m;
    scene.camera = &c;
    for (int i = 0; i < 3; ++i) {
        m.scattering[i] = 0.02f + 0.01f * float(i);
        m.absorption[i] = 0.003f;
        m.emission[i] = 0.1f;
        m.luminance[i] = 1 / 3.0f;
    }
    m.asymmetry = 0.7f;
    m.constant = 0.5f;
    m.term_count = 1;
    m.terms[0][1] = 0.2f;
    c.focal[0] = c.focal[1] = 900;
    c.tangent_scale[0] = 1 / 900.0f;
    c.tangent_scale[1] = -1 / 900.0f;
    c.center[0] = 480;
    c.center[1] = 270;
    c.depth_range[0] = 0.1f;
    c.depth_range[1] = 1000;
    c.far_distance = 1e6f;
    c.sky_distance = 300;
    c.metres_per_unit = 1;
    for (c.depth_kind = 0; c.depth_kind < 5; ++c.depth_kind)
        for (c.sky = 0; c.sky < 3; ++c.sky)
            for (c.nonpositive = 0; c.nonpositive < 2; ++c.nonpositive) {
                const float x = 100.5f, y = 400.5f;
                const std::vector<float> found = IN_BOTH(pixels(scene, x, y, depths));
                for (size_t i = 0; i < depths.size(); ++i) {
                    const f32::Medium medium = f32::medium_of(scene);
                    const f32::Camera camera = f32::camera_of(scene);
                    const f32::Ray ray = f32::pixel_ray(camera, {x, y}, depths[i]);
                    const f32::vec2 texel = f32::density_texel(ray, f32::density_to(medium, ray, 0));
                    const f32::Pixel p = f32::pixel_in_medium(medium, camera, texel);
                    const float expected[] = {p.distance,        p.density,   p.transmittance.x, p.transmittance.y,
                                              p.transmittance.z, p.share.x,   p.share.y,         p.share.z,
                                              p.emitted.x,       p.emitted.y, p.emitted.z,       p.spread};
                    for (size_t v = 0; v < 12; ++v)
                        ASSERT_NEAR(found[i * 12 + v], expected[v], 2e-6f * std::abs(expected[v]) + 1e-37f)
                            << "value " << v << " of depth " << depths[i] << ", kind " << c.depth_kind << ", sky " << c.sky;
                }
            }
}

// Things of all sizes, between the camera and a light that looks down on its rays.
TEST(Lanes, ShadowsAsPixelsOneByOne)
{
    constexpr int side = 64;
    std::mt19937 random(11);
    const auto between = [&](double a, double b) { return float(std::uniform_real_distribution<>(a, b)(random)); };
    std::vector<float> map(side * side, f32::far_away);
    for (int thing = 0; thing < 60; ++thing) {
        const int x = int(between(0, side - 1)), y = int(between(0, side - 1)), size = int(between(1, 9));
        const float depth = between(0.5, 6);
        for (int i = y; i < std::min(y + size, side); ++i)
            for (int k = x; k < std::min(x + size, side); ++k)
                map[size_t(i * side + k)] = depth;
    }
    const f32::Texture shadow_maps{map.data(), side, side, side, 1};
    f32::Camera camera{};
    camera.tangent_scale.y = -1;
    int dark = 0, partly = 0;
    for (int kind = 1; kind <= 3; ++kind) {
        std::vector<float> rows(4096);
        const float above[] = {1, 0, 0, -3, 0,    0,   -1, -6, 0, 1, 0, -4, float(kind), kind == 2 ? 5.0f : 1.0f,
                               0, 0, 0, 0,  side, side};
        std::copy(std::begin(above), std::end(above), rows.begin());
        const f32::Texture light_shadows{rows.data(), 4096, 1024, 1, 4};
        for (int group = 0; group < 40; ++group) {
            std::vector<f32::ShadowRay> rays;
            std::vector<float> ends;
            for (int i = 0; i < 8; ++i) {
                const f32::vec3 d(between(0.1, 0.6), between(-0.2, 0.1), -1);
                ends.push_back(i == 3 ? 0 : between(4, 25));
                rays.push_back(f32::shadow_ray(camera, light_shadows, shadow_maps, 1, 0, d / f32::length(d), ends.back()));
            }
            const float from = between(0, 12), to = from + between(0.3, 4);
            const std::vector<float> found = IN_BOTH(lit_shares(shadow_maps, rays, from, to));
            for (size_t i = 0; i < 8; ++i) {
                float lit = 0;
                const float end = std::max(ends[i], to);
                for (f32::LitWalk walk = f32::next_lit(shadow_maps, rays[i], f32::lit_walk(0), end);
                     walk.part.x < walk.part.y; walk = f32::next_lit(shadow_maps, rays[i], walk, end))
                    lit += std::max(std::min(walk.part.y, to) - std::max(walk.part.x, from), 0.0f);
                const float share = lit / (to - from);
                EXPECT_NEAR(found[i], share, 2e-3) << "kind " << kind << ", group " << group << ", ray " << i;
                dark += share < 0.01f;
                partly += share > 0.01f && share < 0.99f;
            }
        }
    }
    EXPECT_GT(dark, 30);
    EXPECT_GT(partly, 150);
}

}  // namespace
