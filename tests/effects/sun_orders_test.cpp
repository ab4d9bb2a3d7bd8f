// Airlight of all orders for suns: layers above a black ground (shaders/lib/slab_field.glsl).
#include <gtest/gtest.h>

#include "../bench/slab_tracer.h"
#include "airlight_world.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;

namespace {

// Radiance that leaves the top of a layer of fog straight up, over the sun's irradiance; the camera looks down to its
// ground.
double seen_from_above(double scattering, double absorption, double g, double depth, int orders, bool reference = false)
{
    airlight_cases::Case c;
    c.medium.scattering = f64::vec3(float(scattering));
    c.medium.absorption = f64::vec3(float(absorption));
    c.medium.asymmetry = g;
    c.medium.phase = f64::vec4(g, 0, 0, 0);
    c.medium.term_count = 1;
    // Of mass `depth` above the ground, which lies 60 m below.
    const double falloff = 0.2;
    c.medium.terms[0] = f64::vec4(0, float(falloff), 0, float(std::log(depth * falloff) - falloff * 60));
    f64::Light sun{};
    sun.type = f64::light_directional;
    sun.direction = {0, -1, 0};
    sun.intensity = f64::vec3(1);
    c.lights = {sun};
    c.direction = {0, -1, 0};
    c.distance = 60;
    airlight_cases::World world(c);
    world.add_plane(1, false, 60);
    world.settings.orders = orders;
    return reference ? world.reference().radiance.x : double(world.airlight(f32::airlight_nodes).radiance.x);
}

}  // namespace

// The yardstick is a radiance by paths; single scattering has a tenth of it.
TEST(SunOrders, DenseFogIsAsBrightAsPathsHaveIt)
{
    for (double albedo : {1.0, 0.95})
        for (double depth : {2.0, 10.0}) {
            lamp_tracer::Random random(5);
            const lamp_tracer::Slab slab{albedo, 0, depth, 1, 0};
            double paths = 0;
            for (int i = 0; i < 20000; ++i)
                paths += lamp_tracer::trace_slab(slab, 0, {0, 0, -1}, 1, random) / 20000;
            const double all = seen_from_above(albedo, 1 - albedo, 0, depth, f32::orders_all);
            EXPECT_NEAR(all / paths, 1, 0.12) << albedo << " " << depth;
            EXPECT_LT(seen_from_above(albedo, 1 - albedo, 0, depth, f32::orders_single), 0.6 * paths);
        }
}

TEST(SunOrders, RaysAgreeWithQuadrature)
{
    for (double g : {0.0, 0.6})
        for (double depth : {0.01, 1.0, 20.0}) {
            const double exact = seen_from_above(1, 0.1, g, depth, f32::orders_all, true);
            EXPECT_NEAR(seen_from_above(1, 0.1, g, depth, f32::orders_all) / exact, 1, 2e-3) << g << " " << depth;
        }
}

TEST(SunOrders, ThinFogScattersOnce)
{
    double before = 3;
    for (double depth : {0.3, 0.03, 0.003}) {
        const double more =
            seen_from_above(1, 0, 0.3, depth, f32::orders_all) / seen_from_above(1, 0, 0.3, depth, f32::orders_single) - 1;
        EXPECT_GT(more, 0);
        EXPECT_LT(more, 0.3 * before);
        before = more;
    }
}

// What the ground gives back is the picture's light, which multiscatter spreads: the nearer the black ground, the less there
// is.
TEST(SunOrders, GroundTakesLight)
{
    airlight_cases::Case c;
    c.medium.scattering = f64::vec3(0.1f);
    c.medium.term_count = 1;
    c.medium.terms[0] = f64::vec4(0, 0.1f, 0, 0);
    f64::Light sun{};
    sun.type = f64::light_directional;
    sun.direction = {0, -1, 0};
    sun.intensity = f64::vec3(1);
    c.lights = {sun};
    c.direction = {0, 0, -1};
    c.distance = 50;
    double before = 1e9;
    for (double height : {1e30, 20.0, 5.0, 1.0}) {
        airlight_cases::World world(c);
        if (height < 1e30)
            world.add_plane(1, false, height);
        world.settings.orders = f32::orders_all;
        const double now = world.airlight(f32::airlight_nodes).radiance.x;
        EXPECT_LT(now, before) << height;
        before = now;
    }
    airlight_cases::World world(c);
    EXPECT_GT(before, world.airlight(f32::airlight_nodes).radiance.x);
}
