// What shadows leave of the airlight.
#include <limits>

#include <gtest/gtest.h>

#include <brume/brume.h>

#include "airlight_world.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;
using airlight_cases::Case;
using airlight_cases::World;

// The integral over what is lit.
TEST(ShadowedAirlight, IsTheIntegralOverWhatIsLit)
{
    airlight_cases::Dice dice(5);
    // Seen from above (3, 5, 0.3), 90 degrees wide: at height 5 the map spans x from -2 to 8.
    const std::array<float, 16> projection{
        1, 0, 0, -3, 0, 0, -1, 0.3f, 0, 1, 0, -5, BRUME_SHADOW_PERSPECTIVE, 1, BRUME_DEPTH_PLANAR, 0};
    std::vector<float> map(64 * 64, std::numeric_limits<float>::quiet_NaN());
    for (int i = 0; i < 64 * 64; ++i)
        if (const int column = i % 64; (column >= 20 && column < 24) || (column >= 36 && column < 48))
            map[size_t(i)] = 2;
    const auto x = [](int column) { return -2 + column * 10.0 / 64; };
    for (int i = 0; i < 40; ++i) {
        Case c;
        c.direction = {1, 0, 0};
        c.distance = 20;
        c.lights = {airlight_cases::light_at({3, 5, 0.3})};
        c.medium.scattering = f64::vec3(dice.uniform(0.01, 0.2));
        c.medium.absorption = f64::vec3(dice.uniform(0, 0.1));
        c.medium.luminance = f64::vec3(1.0 / 3);
        c.medium.phase.x = dice.uniform(-0.5, 0.8);
        c.medium.constant = 1;
        if (i % 2)
            c.gaussians = {airlight_cases::on_ray(dice, c, dice.uniform(0, 6), 1, 0.5)};
        auto up_to = [&](double distance) {
            Case part = c;
            part.distance = distance;
            return World(part).reference().radiance.x;
        };
        const double expected = up_to(x(20)) + up_to(x(36)) - up_to(x(24)) + up_to(20) - up_to(x(48));
        World world(c, 0.001);
        const f32::Texture texture{map.data(), 64, 64, 64, 1};
        world.add_shadow(0, projection, texture);
        EXPECT_NEAR(world.airlight(f32::airlight_nodes).radiance.x / expected, 1, 1e-3) << "by parts, case " << i;
        world.settings.dense_from = -1;
        EXPECT_NEAR(world.airlight(f32::airlight_nodes).radiance.x / expected, 1, 2e-2) << "by cells, case " << i;
    }
}
