// Surfaces around lamps that take of the fog's light: where the picture shows them, what they leave, and when they are asked
// for.
#include <gtest/gtest.h>

#include "../bench/lamp_tracer.h"
#include "lit_scene.h"
#include "maths.hpp"
#include "relit.h"

using namespace fog;
namespace f64 = brume::maths_double;

namespace {

constexpr int width = 64, height = 36;

// A camera at the origin that looks down -z and sees 90 degrees across.
f64::Camera wide_camera()
{
    f64::Camera c{};
    c.right = {1, 0, 0};
    c.up = {0, 1, 0};
    c.back = {0, 0, 1};
    c.metres_per_unit = 1;
    c.far_distance = 1e9;
    c.depth_kind = f64::depth_planar;
    c.center = {width / 2.0, height / 2.0};
    c.tangent_scale = {2.0 / width, -2.0 / width};
    return c;
}

// Planar depth of planes at these distances from the camera along -x, x, -y, y, -z; INFINITY: none.
struct Seen {
    explicit Seen(const std::array<double, 5> &away) : values(size_t(width) * height)
    {
        const f64::Camera c = wide_camera();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const f64::vec3 d = f64::ray_through(c, {x + 0.5, y + 0.5});
                double depth = away[4];
                for (int axis = 0; axis < 2; ++axis)
                    depth = std::min(depth, away[size_t(2 * axis + (d[axis] > 0))] / std::max(std::abs(d[axis]), 1e-9));
                values[size_t(y) * width + size_t(x)] = depth;
            }
    }
    // Height and weight of a side of a lamp.
    f64::vec4 side(const f64::vec3 &lamp, int index) const
    {
        f64::Light light{};
        light.position = lamp;
        return f64::surroundings_texel({f64::surroundings_seen, 0, 0}, camera, {values.data(), width, width, height, 1},
                                       {width, height}, light, index);
    }
    f64::Camera camera = wide_camera();
    std::vector<double> values;
};

f64::Surroundings planes(const f64::vec3 &low, const f64::vec3 &low_weight, const f64::vec3 &high,
                         const f64::vec3 &high_weight)
{
    return {low, high, low_weight, high_weight};
}

// With scattering .05 or so, and whatever else.
Json foggy_yard(double scattering)
{
    Json scene = lit_scene({{"scattering", scattering}}, Json::array({point_light({2, 1, -6}, 10)}));
    scene["effects"]["multiscatter"] = Json::object();
    return scene;
}

std::string reasons(const Json &scene)
{
    const Plan plan(cpu(), scene.dump(), 16, 12);
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    brume_plan_get_info(plan, &info);
    std::string all;
    for (uint32_t i = 0; i < info.entry_count; ++i) {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        brume_plan_get_entry(plan, i, &entry);
        all += std::string(entry.effect) + "/" + entry.name + ": " + entry.reason + "\n";
    }
    return all;
}

}  // namespace

TEST(Surroundings, RoomsAreFoundWhereTheyAreSeen)
{
    const Seen room({3, 4, 1.5, 2, 10});
    const f64::vec3 lamp(1, 1, -5);
    const double expected[] = {4, 3, 2.5, 1, 5};
    for (int side = 0; side < 5; ++side) {
        const f64::vec4 found = room.side(lamp, side);
        EXPECT_NEAR(found.x, expected[side], 0.05 * expected[side]) << side;
        EXPECT_GT(found.y, 0.9) << side;
    }
    EXPECT_LT(room.side(lamp, 5).y, 0.1) << "behind the camera nobody knows";
}

TEST(Surroundings, SkyIsNoCeilingAndFieldsAreNoWalls)
{
    const Seen field({INFINITY, INFINITY, 1.5, INFINITY, INFINITY});
    const f64::vec3 lamp(0, 2, -8);
    const f64::vec4 ground = field.side(lamp, 2);
    EXPECT_NEAR(ground.x, 3.5, 0.05);
    EXPECT_GT(ground.y, 0.9);
    for (int side : {0, 1, 3, 4, 5}) {
        EXPECT_LT(field.side(lamp, side).y, 0.02) << side;
    }
    Seen nothing({INFINITY, INFINITY, INFINITY, INFINITY, INFINITY});
    nothing.camera.sky_distance = 12;
    for (int sky : {f64::sky_fog, f64::sky_keep, f64::sky_clamp}) {
        nothing.camera.sky = sky;
        for (int side = 0; side < 6; ++side)
            EXPECT_EQ(nothing.side(lamp, side).y, 0) << side << ", sky " << sky;
    }
}

TEST(Surroundings, PlanesTakeMoreTogetherButNotTwice)
{
    const f64::Rescattered light = f64::rescattered(2, 0, 0.3);
    const f64::vec3 way(0.5, 0.7, -0.4);
    const double r = glm::length(way);
    auto left = [&](const f64::Surroundings &s) { return f64::left_by_planes(light, 2, r, s, way); };
    const f64::vec3 one(1);
    const double floor = left(planes(one, {0, 1, 0}, one, {0, 0, 0}));
    EXPECT_NEAR(floor, f64::left_by_plane(light, f64::beside_planes(light, 2), r, 1, 1.7), 1e-12);
    const double both = left(planes(one, {0, 1, 0}, one, {0, 1, 0})), ceiling = left(planes(one, {0, 0, 0}, one, {0, 1, 0}));
    EXPECT_LT(both, std::min(floor, ceiling));
    EXPECT_GT(both, floor * ceiling);
    EXPECT_LT(left(planes(one, one, one, one)), both);
    EXPECT_EQ(left(f64::open_surroundings()), 1);
    EXPECT_NEAR(left(planes(1e7 * one, one, 1e7 * one, one)), 1, 1e-5);
    EXPECT_GT(left(planes(one, {0, 0.5, 0}, one, {0, 0, 0})), floor);
    // The lamp where the point was.
    const f64::Surroundings there = planes(one, one, 2.0 * one, one), back = planes(one + way, one, 2.0 * one - way, one);
    EXPECT_NEAR(f64::left_by_planes(light, 2, r, there, way), f64::left_by_planes(light, 2, r, back, -way), 1e-12);
}

// Against paths: floors, corridors, cubes.
TEST(Surroundings, BlackRoomsAgreeWithPaths)
{
    double sum = 0;
    int count = 0;
    for (const lamp_tracer::Room &room : lamp_tracer::rooms)
        for (double g : {0.0, 0.7}) {
            const double size = 0.3;
            for (const lamp_tracer::RoomPoint &p : lamp_tracer::trace_in_room(room, g, size, 20000, 11)) {
                const double r = glm::length(p.way);
                const f64::Rescattered light = f64::rescattered(r / (1 - g), 0, g);
                f64::Surroundings around = f64::open_surroundings();
                for (int axis = 0; axis < 3; ++axis) {
                    if (std::isfinite(room.low[axis])) {
                        around.low[axis] = -size * room.low[axis];
                        around.low_weight[axis] = 1;
                    }
                    if (std::isfinite(room.high[axis])) {
                        around.high[axis] = size * room.high[axis];
                        around.high_weight[axis] = 1;
                    }
                }
                const double model = light.fluence / (r * r) * f64::left_by_planes(light, r / (1 - g), r, around, p.way);
                if (p.deviation < 0.1) {
                    sum += std::pow(model / p.fluence - 1, 2);
                    ++count;
                }
            }
        }
    ASSERT_GT(count, 20);
    printf("fluence in black rooms at %d points: rms error %.3f\n", count, std::sqrt(sum / count));
    EXPECT_LT(std::sqrt(sum / count), 0.15);
}

TEST(AirlightOrders, AreAllWhereMuchIsScatteredAgain)
{
    EXPECT_NE(reasons(foggy_yard(0.05)).find("airlight/gather: 1 light scattered any number of times"), std::string::npos)
        << reasons(foggy_yard(0.05));
    // 6 m of it scatter a 300th of a hundredth.
    EXPECT_NE(reasons(foggy_yard(1e-5)).find("airlight/gather: 1 light scattered once"), std::string::npos);
    Json alone = foggy_yard(0.05);
    alone["effects"].erase("multiscatter");
    EXPECT_NE(reasons(alone).find("airlight/gather: 1 light scattered once"), std::string::npos);
    Json published = foggy_yard(0.05);
    published["effects"]["airlight"]["tier"] = "fogshop";
    EXPECT_NE(reasons(published).find("airlight/gather: 1 light scattered once"), std::string::npos);
}

TEST(AirlightOrders, WhatIsSettledIsWhatCouldBeAsked)
{
    const Picture color = Picture(16, 12, 4, 1), depth(16, 12, 1, 8);
    for (const auto &[scattering, orders] : {std::pair(0.05, "all"), std::pair(1e-5, "single")}) {
        Json scene = foggy_yard(scattering);
        const Picture automatic = run(cpu(), scene.dump(), color, depth).output;
        scene["effects"]["airlight"]["orders"] = orders;
        EXPECT_EQ(automatic.data, run(cpu(), scene.dump(), color, depth).output.data) << scattering;
    }
}

// A wish for quality chooses among settings of whatever the scene asks.
TEST(AirlightOrders, QualityKeepsThem)
{
    Json scene = foggy_yard(0.05);
    scene["quality"] = {{"preset", "standard"}, {"transmittance", 0.5}, {"detail", 1}};
    EXPECT_NE(reasons(scene).find("scattered any number of times"), std::string::npos) << reasons(scene);
}

#ifdef BRUME_GL
TEST(Surroundings, BackendsAgree)
{
    Json scene = foggy_yard(0.1);
    scene["medium"]["g"] = 0.5;
    const Seen room({3, 4, 1.5, 2, 10});
    const Picture color = Picture(width, height, 4, 1);
    Picture depth(width, height, 1);
    std::copy(room.values.begin(), room.values.end(), depth.data.begin());
    const Worst worst =
        compare(run(backend("gl"), scene.dump(), color, depth).output, run(cpu(), scene.dump(), color, depth).output, 0.01);
    EXPECT_LT(worst.error, 1e-3) << worst.describe();
}
#endif
