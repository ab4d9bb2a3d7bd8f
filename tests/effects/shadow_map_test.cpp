// shaders/lib/shadow_map.glsl: where a map sees a ray, and which parts of it are lit, against plain geometry.
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <brume/brume.h>

#include "maths.hpp"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;

namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

// Over the point (x, height, z) of camera space, looking down: its right is +x, its up is -z.
struct Above {
    double x = 3, height = 5, z = 0.3;
    int kind = BRUME_SHADOW_PERSPECTIVE;
    double extent = 1;  // 90 degrees

    std::array<float, 16> projection(int depth = BRUME_DEPTH_PLANAR) const
    {
        return {1, 0, 0, float(-x), 0, 0, -1, float(z), 0, 1, 0, float(-height), float(kind), float(extent), float(depth),
                0};
    }
};

template <class Real> struct Maths;
#define MATHS(Real, space)                                                                                                  \
    template <> struct Maths<Real> {                                                                                        \
        using vec3 = space::vec3;                                                                                           \
        static constexpr space::ShadowDepth units{BRUME_DEPTH_PLANAR, 1, {0, 0}};                                           \
        static std::vector<std::array<double, 2>> parts(const std::array<float, 16> &projection,                            \
                                                        const std::vector<Real> &texels, int width, vec3 direction,         \
                                                        Real end, Real row_sign = -1)                                       \
        {                                                                                                                   \
            /* Amid the maps of others, which would throw shadows everywhere. */                                            \
            const int height = int(texels.size()) / width, all = width + 5;                                                 \
            std::vector<Real> atlas(size_t(all *(height + 4)), Real(0.01));                                                 \
            for (int y = 0; y < height; ++y)                                                                                \
                for (int x = 0; x < width; ++x)                                                                             \
                    atlas[size_t((y + 2) * all + x + 3)] = space::shadow_distance(units, texels[size_t(y * width + x)]);    \
            std::vector<Real> rows(4096);                                                                                   \
            std::copy(projection.begin(), projection.end(), rows.begin());                                                  \
            rows[14] = projection[14] == float(BRUME_DEPTH_RAY);                                                            \
            rows[16] = 3, rows[17] = 2, rows[18] = Real(width), rows[19] = Real(height);                                    \
            const space::Texture light_shadows{rows.data(), 4096, 1024, 1, 4},                                              \
                shadow_maps{atlas.data(), all, all, height + 4, 1};                                                         \
            space::Camera camera{};                                                                                         \
            camera.tangent_scale.y = row_sign;                                                                              \
            const space::ShadowRay ray = space::shadow_ray(camera, SHADOW_MAP_PASSED, 1, 0, direction, end);                \
            std::vector<std::array<double, 2>> parts;                                                                       \
            for (space::LitWalk walk = space::next_lit(shadow_maps, ray, space::lit_walk(0), end);                          \
                 walk.part.x < walk.part.y; walk = space::next_lit(shadow_maps, ray, walk, end))                            \
                parts.push_back({walk.part.x, walk.part.y});                                                                \
            return parts;                                                                                                   \
        }                                                                                                                   \
    };
MATHS(float, f32)
MATHS(double, f64)

// By columns: what stands over [from, to) of 64 columns is at this depth.
template <class Real> std::vector<Real> fence(std::vector<std::array<int, 2>> slats, Real depth, int rows = 64)
{
    std::vector<Real> texels(size_t(64 * rows), Real(nothing));
    for (int y = 0; y < rows; ++y)
        for (auto [from, to] : slats)
            std::fill(&texels[size_t(64 * y + from)], &texels[size_t(64 * y)] + to, depth);
    return texels;
}

template <class Real> class ShadowMap : public testing::Test {
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(ShadowMap, Reals);

}  // namespace

// At height 5 the map spans x from -2 to 8: 64 columns of 10/64 m.
TYPED_TEST(ShadowMap, ThingsEndWhatIsLitWhereTheirTexelsDo)
{
    using M = Maths<TypeParam>;
    const typename M::vec3 along(1, 0, 0);
    auto expect = [&](const std::vector<std::array<int, 2>> &slats, const std::vector<std::array<double, 2>> &lit) {
        for (TypeParam sign : {TypeParam(-1), TypeParam(1)}) {
            const auto parts = M::parts(Above{}.projection(), fence<TypeParam>(slats, 2), 64, along, 20, sign);
            ASSERT_EQ(parts.size(), lit.size());
            for (size_t i = 0; i < lit.size(); ++i)
                for (size_t k = 0; k < 2; ++k)
                    EXPECT_NEAR(parts[i][k], lit[i][k], 1e-4) << "part " << i;
        }
    };
    const auto x = [](int column) { return -2 + column * 10.0 / 64; };
    expect({{0, 32}}, {{x(32), 20}});
    expect({{32, 64}}, {{0, x(32)}, {8, 20}});  // outside of the map all is lit
    expect({{20, 24}, {30, 31}, {40, 50}}, {{0, x(20)}, {x(24), x(30)}, {x(31), x(40)}, {x(50), 20}});
    expect({}, {{0, 20}});
}

TYPED_TEST(ShadowMap, RowsRunAsTheImagesDo)
{
    using M = Maths<TypeParam>;
    // The upper half of the map is what lies at smaller z.
    std::vector<TypeParam> texels(64 * 64, TypeParam(nothing));
    std::fill_n(texels.begin(), 64 * 32, TypeParam(2));
    Above above;
    above.x = 0.3;
    above.z = -3;
    const auto top_left = M::parts(above.projection(), texels, 64, {0, 0, -1}, 20, -1),
               bottom_left = M::parts(above.projection(), texels, 64, {0, 0, -1}, 20, 1);
    ASSERT_EQ(top_left.size(), 2u);
    EXPECT_NEAR(top_left[0][1], 3, 1e-4);
    EXPECT_NEAR(top_left[1][0], 8, 1e-4);
    ASSERT_EQ(bottom_left.size(), 1u);
    EXPECT_NEAR(bottom_left[0][0], 3, 1e-4);
}

TYPED_TEST(ShadowMap, ParallelLightCastsAsWideAsThingsAre)
{
    using M = Maths<TypeParam>;
    Above sun;
    sun.kind = BRUME_SHADOW_ORTHOGRAPHIC;
    sun.extent = 4;  // x from -1 to 7
    const auto parts = M::parts(sun.projection(), fence<TypeParam>({{16, 24}}, 2), 64, {1, 0, 0}, 20);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_NEAR(parts[0][1], 1, 1e-4);
    EXPECT_NEAR(parts[1][0], 2, 1e-4);
    EXPECT_EQ(parts[1][1], 20);
}

// A light at the camera: shadows begin one texel's width behind what the ray meets.
// A ray along +x that passes 5 m from the map's place: before it, behind it, where the picture's edges meet, and below.
TYPED_TEST(ShadowMap, AllAroundIsAMapToo)
{
    using M = Maths<TypeParam>;
    auto lit = [](double y, double z, int from_column, int to_column, int from_row, int to_row) {
        std::vector<TypeParam> texels(64 * 32, TypeParam(nothing));
        for (int row = from_row; row < to_row; ++row)
            for (int column = from_column; column < to_column; ++column)
                texels[size_t(64 * row + (column + 64) % 64)] = 2;
        const std::array<float, 16> place{
            1, 0, 0, -3, 0, 1, 0, float(-y), 0, 0, 1, float(-z), BRUME_SHADOW_LATLONG, 0, BRUME_DEPTH_RAY, 0};
        return M::parts(place, texels, 64, {1, 0, 0}, 20);
    };
    const double eighth = 5 * std::tan(M_PI / 8);
    auto expect = [](const std::vector<std::array<double, 2>> &parts, const std::vector<std::array<double, 2>> &expected) {
        ASSERT_EQ(parts.size(), expected.size());
        for (size_t i = 0; i < parts.size(); ++i)
            for (size_t k = 0; k < 2; ++k)
                EXPECT_NEAR(parts[i][k], expected[i][k], 2e-4) << "part " << i;
    };
    expect(lit(0, 5, 36, 40, 0, 32), {{0, 3 + eighth}, {8, 20}});
    expect(lit(0, -5, -4, 4, 0, 32), {{0, 3 - eighth}, {3 + eighth, 20}});
    expect(lit(5, 0, 0, 64, 28, 32), {{0, 3 - eighth}, {3 + eighth, 20}});
    expect(lit(5, 0, 0, 64, 0, 4), {{0, 20}});
    // Through the map's own place: what is behind 2 m on either side is in shadow.
    const auto through = lit(0, 0, 0, 64, 0, 32);
    ASSERT_EQ(through.size(), 1u);
    EXPECT_NEAR(through[0][0], 1, 0.3);
    EXPECT_NEAR(through[0][1], 5, 0.3);
}

TYPED_TEST(ShadowMap, ShadowsBeginBehindThings)
{
    using M = Maths<TypeParam>;
    const std::array<float, 16> planar{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, BRUME_SHADOW_PERSPECTIVE, 1, BRUME_DEPTH_PLANAR,
                                       0};
    std::array<float, 16> radial = planar;
    radial[14] = BRUME_DEPTH_RAY;
    const std::vector<TypeParam> wall(128 * 128, 4);
    const double bias = 4 * 2.0 / 128;
    const typename M::vec3 ahead(0, 0, -1), aside(TypeParam(0.6), 0, TypeParam(-0.8));
    for (const auto &[projection, direction, end] :
         {std::tuple(planar, ahead, 4 + bias), std::tuple(planar, aside, (4 + bias) / 0.8),
          std::tuple(radial, aside, 4 + bias)}) {
        const auto parts = M::parts(projection, wall, 128, direction, 1000);
        ASSERT_EQ(parts.size(), 1u);
        EXPECT_EQ(parts[0][0], 0);
        EXPECT_NEAR(parts[0][1], end, 1e-3);
    }
}

// Nearest texels alone would let light through steps of a surface that is seen aslant.
TYPED_TEST(ShadowMap, SlantedSurfacesAreTight)
{
    using M = Maths<TypeParam>;
    std::vector<TypeParam> texels;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            texels.push_back(TypeParam(2.5 + 2 * (x - 31.5) / 64));
    // The roof is at depth 1.75 + x / 4, of which a texel has all but 1/64; the ray is 1/100 deeper than the bias.
    Above sun;
    sun.kind = BRUME_SHADOW_ORTHOGRAPHIC;
    sun.extent = 4;  // x from -1 to 7
    sun.height = 1.75 + 0.125 + 0.01;
    const double slope = std::atan(0.25);
    const auto parts =
        M::parts(sun.projection(), texels, 64, {TypeParam(std::cos(slope)), TypeParam(-std::sin(slope)), 0}, 6.5);
    EXPECT_TRUE(parts.empty()) << parts[0][0] << " to " << parts[0][1];
}

TYPED_TEST(ShadowMap, MapsThatShowNothingShadowNothing)
{
    using M = Maths<TypeParam>;
    const TypeParam inf = std::numeric_limits<TypeParam>::infinity();
    for (TypeParam value : {TypeParam(nothing), inf, -inf, TypeParam(0), TypeParam(-1), TypeParam(1e10), TypeParam(3e38)})
        for (int width : {1, 3, 64}) {
            const auto parts =
                M::parts(Above{}.projection(), std::vector<TypeParam>(size_t(width * 2), value), width, {1, 0, 0}, 20);
            ASSERT_EQ(parts.size(), 1u) << value;
            EXPECT_EQ(parts[0][0], 0);
            EXPECT_EQ(parts[0][1], 20);
        }
}

// As a buffer of near and far planes, reversed or not, has it.
TYPED_TEST(ShadowMap, DepthBuffersAreDistances)
{
    using Real = TypeParam;
    using Depth = std::conditional_t<std::is_same_v<Real, float>, f32::ShadowDepth, f64::ShadowDepth>;
    const Real near = Real(0.1), far = 50, none = Real(1e30);
    auto stored = [&](Real z) { return (1 / near - 1 / z) / (1 / near - 1 / far); };
    for (const Real z : {Real(0.1), Real(0.5), Real(7), Real(49)}) {
        const Depth usual{BRUME_DEPTH_DEVICE, 1, {1 / near, 1 / far}}, reversed{BRUME_DEPTH_DEVICE, 1, {1 / far, 1 / near}},
            endless{BRUME_DEPTH_DEVICE, 1, {0, 1 / near}}, parallel{BRUME_DEPTH_NORMALIZED, 1, {near, far}},
            turned{BRUME_DEPTH_NORMALIZED, 1, {far, near}};
        const Real linear = (z - near) / (far - near);
        EXPECT_NEAR(shadow_distance(usual, stored(z)) / z, 1, 1e-4);
        EXPECT_NEAR(shadow_distance(reversed, 1 - stored(z)) / z, 1, 1e-3);
        EXPECT_NEAR(shadow_distance(endless, near / z) / z, 1, 1e-5);
        EXPECT_NEAR(shadow_distance(parallel, linear) / z, 1, 1e-4);
        EXPECT_NEAR(shadow_distance(turned, 1 - linear) / z, 1, 1e-4);
        // Cleared texels.
        EXPECT_EQ(shadow_distance(usual, Real(1)), none);
        EXPECT_EQ(shadow_distance(reversed, Real(0)), none);
        EXPECT_EQ(shadow_distance(endless, Real(0)), none);
        EXPECT_EQ(shadow_distance(parallel, Real(1)), none);
        EXPECT_EQ(shadow_distance(turned, Real(0)), none);
        EXPECT_EQ(shadow_distance(usual, Real(nothing)), none);
    }
}

TYPED_TEST(ShadowMap, OneTexelIsAMap)
{
    using M = Maths<TypeParam>;
    const auto parts = M::parts(Above{}.projection(), {TypeParam(1)}, 1, {1, 0, 0}, 20);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_NEAR(parts[0][0], 8, 1e-5);
}
