// Light of lamps that scatters more than once: the model's own balance, its integral along rays, and what it must never do.
#include <gtest/gtest.h>

#include "airlight_world.h"
#include "fog.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;
using airlight_cases::Case;
using airlight_cases::Dice;
using airlight_cases::World;
using std::numbers::pi;

namespace {

double g_of(int i)
{
    constexpr double values[] = {0, 0.3, 0.5, 0.7, 0.85, 0.95};
    return values[i];
}

f64::Medium constant_medium(f64::vec3 scattering, f64::vec3 absorption, double g)
{
    f64::Medium m{};
    m.scattering = airlight_cases::rounded(scattering);
    m.absorption = airlight_cases::rounded(absorption);
    m.asymmetry = float(g);
    m.phase = f64::vec4(float(g), 0, 0, 0);
    m.constant = 1;
    return m;
}

// By Simpson over equal angles, finer toward straight on.
template <class Function> double over_sphere(const Function &f)
{
    double sum = 0;
    const int pieces = 2000;
    for (int i = 0; i < pieces; ++i) {
        auto at = [&](double u) {
            const double angle = pi * u * u * u;
            return 2 * pi * f(std::cos(angle)) * std::sin(angle) * pi * 3 * u * u;
        };
        const double a = double(i) / pieces, width = 1.0 / pieces;
        sum += width / 6 * (at(a) + 4 * at(a + width / 2) + at(a + width));
    }
    return sum;
}

}  // namespace

// What leaves the lamp goes through every sphere around it, straight or scattered, as the camera's source says it goes.
TEST(LampOrders, NetFluxThroughSpheresIsTheLampsWhereNothingIsAbsorbed)
{
    for (int i = 0; i < 6; ++i)
        for (double x = 0.05; x < 5.01; x *= 1.3) {
            const double g = g_of(i), scattering = x / (1 - g);
            const f64::Rescattered r = f64::rescattered(scattering, 0, g);
            EXPECT_NEAR(r.fluence * r.cosine + std::exp(-scattering), 1, 1e-7) << "g " << g << " s'r " << x;
            const double again = over_sphere([&](double c) { return c * f64::turned_again(g, r.cosine, c); });
            EXPECT_NEAR(r.fluence * again + g * std::exp(-scattering), g, 0.03 * g + 1e-6) << "g " << g << " s'r " << x;
            EXPECT_NEAR(over_sphere([&](double c) { return f64::turned_again(g, r.cosine, c); }), 1, 1e-3);
        }
}

// What is absorbed within a sphere is what does not leave it.
TEST(LampOrders, AbsorptionTakesFromTheFluxWhatTheFluenceSays)
{
    for (int i = 0; i < 6; ++i)
        for (double albedo : {0.99, 0.9, 0.5, 0.1}) {
            const double g = g_of(i), absorption = (1 - albedo) / albedo, extinction = absorption + 1;
            double absorbed = 0;
            const double step = 0.002 / (absorption + 1 - g);
            for (int n = 0; n < 4000; ++n) {
                const double r = (n + 0.5) * step;
                absorbed += absorption * step * (f64::rescattered(r, absorption * r, g).fluence + std::exp(-extinction * r));
                if (n % 500 == 499) {
                    const double end = (n + 1) * step;
                    const f64::Rescattered at = f64::rescattered(end, absorption * end, g);
                    EXPECT_NEAR(at.fluence * at.cosine + std::exp(-extinction * end) + absorbed, 1, 1e-4)
                        << "g " << g << " albedo " << albedo << " at " << end;
                }
            }
        }
}

TEST(LampOrders, FarAwayIsDiffusion)
{
    for (int i = 0; i < 6; ++i) {
        const double g = g_of(i), x = 40;
        EXPECT_NEAR(f64::rescattered(x / (1 - g), 0, g).fluence, 3 * x, 0.01 * 3 * x);
        EXPECT_NEAR(f64::rescattered(x / (1 - g), 0, g).cosine, 1 / (3 * x), 0.01 / (3 * x));
    }
}

// A thin medium's light has scattered once: in the plane of lamp and point by all angles alike (physics of equiangular
// rays).
TEST(LampOrders, ThinMediaApproachOneScattering)
{
    for (int i = 0; i < 6; ++i) {
        const double g = g_of(i), depth = 1e-4;
        double once = 0;
        const int pieces = 20000;
        for (int n = 0; n < pieces; ++n) {
            // Crowded at 0, where the phase function may peak.
            const double u = (n + 0.5) / pieces, angle = pi * u * u;
            once += 2 * pi * f64::henyey_greenstein(g, std::cos(angle)) * angle * pi * 2 * u / pieces;
        }
        EXPECT_NEAR(f64::rescattered(depth, 0, g).fluence / (depth * once), 1, g < 0.9 ? 0.04 : 0.08) << "g " << g;
    }
}

// Relative to what is scattered once, the rest vanishes with the medium.
TEST(LampOrders, ThinMediaHaveNoHigherOrders)
{
    double before = 0;
    for (double density : {1.0, 0.1, 0.01, 0.001}) {
        Case c;
        c.medium = constant_medium(f64::vec3(0.1 * density), f64::vec3(0), 0.3);
        c.lights = {airlight_cases::light_at({2, 1, -6})};
        c.distance = 20;
        World world(c);
        const double single = world.airlight(f32::airlight_nodes).radiance.x;
        world.settings.orders = f32::orders_all;
        const double share = world.airlight(f32::airlight_nodes).radiance.x / single - 1;
        EXPECT_LT(share, density < 1 ? 0.3 * before : 2);
        EXPECT_GT(share, 0);
        before = share;
    }
    EXPECT_LT(before, 0.005);
}

TEST(LampOrders, FloatIsDouble)
{
    double worst = 0, worst_cosine = 0;
    for (double depth = 1e-8; depth < 1e4; depth *= 1.7)
        for (double g : {-0.9, -0.3, 0.0, 0.3, 0.7, 0.95, 0.999})
            for (double ratio : {0.0, 0.01, 0.3, 3.0}) {
                const f32::Rescattered narrow = f32::rescattered(float(depth), float(ratio * depth), float(g));
                const f64::Rescattered wide = f64::rescattered(float(depth), float(ratio * depth), float(g));
                const double rest = std::exp(-(1 + ratio) * depth),
                             scale = std::min(depth, 1.0) * rest + wide.fluence + 1e-20;
                worst = std::max(worst, std::abs(narrow.fluence - wide.fluence) / scale);
                worst_cosine = std::max(worst_cosine, std::abs(narrow.cosine - wide.cosine) * wide.fluence / scale);
            }
    EXPECT_LT(worst, 3e-5);
    EXPECT_LT(worst_cosine, 3e-5);
}

TEST(LampOrders, ContinuousInDepthAlbedoAndAsymmetry)
{
    Dice dice(3);
    for (int n = 0; n < 20000; ++n) {
        const double s = dice.logarithmic(1e-4, 100), d = dice.chance(0.2) ? 0 : dice.logarithmic(1e-4, 100),
                     g = dice.uniform(-0.98, 0.98);
        const f64::Rescattered a = f64::rescattered(s, d, g),
                               b = f64::rescattered(s * (1 + 1e-6), d * (1 + 1e-6) + 1e-13, g + 1e-8);
        EXPECT_NEAR(a.fluence, b.fluence, 2e-4 * a.fluence + 1e-7) << s << " " << d << " " << g;
        EXPECT_NEAR(a.cosine * a.fluence, b.cosine * b.fluence, 2e-4 * a.fluence + 1e-7) << s << " " << d << " " << g;
    }
    // Through g = 0, where nothing must jump.
    for (double s : {0.1, 1.0, 10.0}) {
        const f64::Rescattered a = f64::rescattered(s, 0.1, -1e-6), b = f64::rescattered(s, 0.1, 1e-6);
        EXPECT_NEAR(a.fluence, b.fluence, 1e-4 * a.fluence);
        EXPECT_NEAR(f64::turned_again(-1e-6, a.cosine, 1), f64::turned_again(1e-6, b.cosine, 1), 1e-5);
    }
}

// A lamp's light in the fog at the camera is that of a lamp at the camera where the first one was: exchange of the two.
TEST(LampOrders, LampAndPointMayChangePlaces)
{
    Dice dice(4);
    for (int n = 0; n < 500; ++n) {
        f64::Medium m = constant_medium(f64::vec3(dice.logarithmic(0.01, 1)), f64::vec3(dice.logarithmic(0.001, 1)),
                                        dice.uniform(0, 0.9));
        m.term_count = 1;
        m.terms[0] = f64::vec4(airlight_cases::rounded(dice.logarithmic(1e-3, 0.3) * dice.direction()), dice.uniform(-2, 1));
        f64::Light lamp = airlight_cases::light_at(dice.uniform(1, 10) * dice.direction());
        const f64::vec3 point = airlight_cases::rounded(dice.uniform(1, 10) * dice.direction());
        const double there = f64::terms_to_light(m, lamp, point);
        f64::Light other = lamp;
        other.position = point;
        const double back = f64::terms_to_light(m, other, lamp.position);
        const f64::Rescattered a = f64::rescattered(m.scattering.x * there, m.absorption.x * there, m.asymmetry),
                               b = f64::rescattered(m.scattering.x * back, m.absorption.x * back, m.asymmetry);
        EXPECT_NEAR(a.fluence, b.fluence, 1e-6 * a.fluence);
        const double up = dice.uniform(0, 5), down = dice.uniform(0, 5),
                     distance = std::abs(up - down) + dice.uniform(0.1, 5);
        EXPECT_NEAR(f64::left_by_plane(a, f64::beside_planes(a, there), distance, up, down),
                    f64::left_by_plane(b, f64::beside_planes(b, back), distance, down, up), 1e-12);
    }
}

TEST(LampOrders, BlackGroundTakesMostWhereItIsNear)
{
    double before = 1;
    for (double height : {30.0, 3.0, 1.0, 0.3, 0.0}) {
        const f64::Rescattered r = f64::rescattered(2, 0, 0);
        const double left = f64::left_by_plane(r, f64::beside_planes(r, 2), 2, height, height);
        EXPECT_LT(left, before);
        EXPECT_GT(left, 0);
        before = left;
    }
    EXPECT_GT(f64::left_by_plane(f64::rescattered(2, 0, 0), 1, 2, 1e6, 1e6), 0.999);
}

// A spot of all directions is a point, and what a narrow one scatters far away is even.
TEST(LampOrders, SpotsAreAsBrightAsTheyEmit)
{
    const f64::Medium m = constant_medium(f64::vec3(0.1), f64::vec3(0), 0);
    f64::Light point = airlight_cases::light_at({3, 0, -4});
    f64::Light spot = point;
    spot.type = f64::light_spot;
    spot.cos_inner = spot.cos_outer = 0;
    const f64::vec3 direction(0, 0, -1);
    const double far = 500;
    auto of = [&](const f64::Light &l, double t, double depth) {
        return f64::rescattered_strength(m, {}, l, f64::aspect_of(l, direction), f64::open_surroundings(), direction, t,
                                         depth)
            .x;
    };
    const double wide = of(spot, far, far) / of(point, far, far);
    EXPECT_NEAR(wide, 0.5, 0.02);
    // Above it nothing arrives straight, and near the lamp little.
    spot.direction = f64::vec3(1, 0, 0);
    EXPECT_LT(of(spot, 4, 3), 0.5 * of(point, 4, 3));
    EXPECT_GT(of(spot, 4, 3), 0);
    for (double outer : {0.0, 0.5, 0.9})
        for (double cosine : {0.0, 0.1, 0.6, 1.0}) {
            spot.cos_outer = outer;
            spot.cos_inner = 0.5 + 0.5 * outer;
            const double all = over_sphere([&](double c) { return f64::spot_spread(spot, cosine, c); });
            EXPECT_NEAR(all, over_sphere([&](double c) { return f64::spot_factor(spot, c); }), 1e-4)
                << outer << " " << cosine;
        }
}

// The yardstick is adaptive quadrature in double of the same integrand, in constant fog, fog that thins out, and Gaussians.
TEST(LampOrders, RaysAgreeWithQuadrature)
{
    std::vector<double> errors;
    Dice dice(5);
    for (int n = 0; n < 600; ++n) {
        Case c;
        const double g = dice.chance(0.3) ? 0 : dice.uniform(0, 0.95), s = dice.logarithmic(0.005, 1);
        c.medium =
            constant_medium(f64::vec3(s, 1.2 * s, 1.5 * s), f64::vec3(dice.chance(0.5) ? 0 : s * dice.uniform(0, 0.3)), g);
        if (dice.chance(0.3)) {
            c.medium.constant = 0;
            c.medium.term_count = 1;
            c.medium.terms[0] = f64::vec4(airlight_cases::rounded(dice.logarithmic(0.01, 0.5) * dice.direction()), 0);
        }
        c.lights = {airlight_cases::light_at(dice.logarithmic(0.5, 50) *
                                             dice.near_direction({0, 0, -1}, dice.logarithmic(0.01, 3)))};
        c.lights[0].radius = 0.1f;
        c.distance = dice.chance(0.2) ? 1e30 : dice.logarithmic(1, 100);
        if (dice.chance(0.3))
            c.gaussians.push_back(
                {airlight_cases::rounded(f64::vec3(dice.uniform(-2, 2), dice.uniform(-2, 2), dice.uniform(-20, 0))),
                 dice.logarithmic(0.2, 2), dice.logarithmic(0.1, 10), f64::vec3(1)});
        World world(c);
        auto both = [&](int orders) {
            world.settings.orders = orders;
            return std::pair(world.airlight(f32::airlight_nodes).radiance, world.reference().radiance);
        };
        const auto [single, exact_single] = both(f32::orders_single);
        const auto [all, exact_all] = both(f32::orders_all);
        if (exact_all.y < 1e-12)
            continue;
        errors.push_back(std::abs((all.y - single.y) - (exact_all.y - exact_single.y)) / exact_all.y);
    }
    std::sort(errors.begin(), errors.end());
    const double median = errors[errors.size() / 2], p95 = errors[errors.size() * 95 / 100];
    printf("orders of two and more along %zu rays, of all: median %.2g, p95 %.2g, worst %.2g\n", errors.size(), median, p95,
           errors.back());
    EXPECT_LT(median, 0.0001);
    EXPECT_LT(p95, 0.002);
    EXPECT_LT(errors.back(), 0.02);
}

// Many Gaussians are integrated as one density, in cells.
TEST(LampOrders, CloudsAgreeWithQuadrature)
{
    std::vector<double> errors;
    Dice dice(6);
    for (int n = 0; n < 150; ++n) {
        Case c;
        c.medium = constant_medium(f64::vec3(dice.logarithmic(0.05, 1)), f64::vec3(0), dice.uniform(0, 0.9));
        c.medium.constant = dice.chance(0.5) ? 0 : 0.1f;
        c.lights = {airlight_cases::light_at({dice.uniform(-3, 3), dice.uniform(-3, 3), dice.uniform(-14, -2)})};
        c.lights[0].radius = 0.1f;
        if (dice.chance(0.5)) {
            c.lights[0].type = f64::light_spot;
            c.lights[0].direction = airlight_cases::rounded(dice.direction());
            c.lights[0].cos_outer = 0.7f;
            c.lights[0].cos_inner = 0.8f;
        }
        c.distance = 30;
        for (int i = 0; i < 12; ++i)
            c.gaussians.push_back(
                {airlight_cases::rounded(f64::vec3(dice.uniform(-2, 2), dice.uniform(-2, 2), dice.uniform(-12, -2))),
                 dice.logarithmic(0.4, 1.5), dice.logarithmic(0.1, 2), f64::vec3(1)});
        World world(c);
        world.settings.orders = f32::orders_all;
        const double got = world.airlight(f32::airlight_nodes).radiance.y, exact = world.reference().radiance.y;
        if (exact > 1e-12)
            errors.push_back(std::abs(got / exact - 1));
    }
    std::sort(errors.begin(), errors.end());
    const double median = errors[errors.size() / 2], p95 = errors[errors.size() * 95 / 100];
    printf("all orders in clouds along %zu rays: median %.2g, p95 %.2g\n", errors.size(), median, p95);
    EXPECT_LT(median, 0.005);
    EXPECT_LT(p95, 0.03);
}

// Its glow is all there beside the picture, so the filter must not make it again.
TEST(LampOrders, PixelsThatShowALampAreLeftOutOfTheFilter)
{
    f32::Camera camera{};
    camera.tangent_scale = f32::vec2(0.01f);
    camera.center = f32::vec2(50);
    camera.metres_per_unit = 1;
    camera.far_distance = 1e9f;
    std::vector<float> values(4096);
    const float lamp[] = {0, 0, -10, 0.2f};
    std::copy_n(lamp, 4, values.begin());
    const f32::Texture lights{values.data(), 4096, 1024, 1, 4};
    f32::Pixel pixel{};
    pixel.share = f32::vec3(0.5f);
    auto share = [&](f32::vec2 at, float distance, int count) {
        pixel.distance = distance;
        return f32::share_beside_lights(lights, count, 1, f32::Medium{}, camera, at, pixel).x;
    };
    EXPECT_EQ(share(f32::vec2(50), 9.8f, 1), 0) << "the lamp";
    EXPECT_EQ(share(f32::vec2(50), 20, 1), 0.5f) << "beyond it";
    EXPECT_EQ(share(f32::vec2(70), 9.8f, 1), 0.5f) << "beside it";
    EXPECT_EQ(share(f32::vec2(50), 9.8f, 0), 0.5f) << "no lights are listed";
}

TEST(LampOrders, FiniteAtTheExtremes)
{
    const float nothing = 0, tiny = 1e-12f;
    for (float g : {-1.0f, -0.999f, 0.0f, 0.999f, 1.0f})
        for (float s : {nothing, tiny, 1e-4f, 1.0f, 50.0f, 1e4f, 1e30f})
            for (float d : {nothing, tiny, 1.0f, 1e4f, 1e30f}) {
                const f32::Rescattered r = f32::rescattered(s, d, g);
                ASSERT_TRUE(std::isfinite(r.fluence) && r.fluence >= 0) << g << " " << s << " " << d;
                ASSERT_TRUE(r.cosine >= 0 && r.cosine <= 1) << g << " " << s << " " << d;
                for (float distance : {0.0f, 1e-7f, 1.0f, 1e6f, 1e30f})
                    for (float height : {0.0f, 1.0f, 1e6f, 1e30f}) {
                        const float left =
                            f32::left_by_plane(r, f32::beside_planes(r, std::min(s + d, 1e9f)), distance, height, 1.0f);
                        ASSERT_TRUE(left >= 0 && left <= 1) << g << " " << s << " " << d << " " << distance << " " << height;
                    }
                for (float cosine : {-1.0f, 0.0f, 1.0f})
                    ASSERT_TRUE(std::isfinite(f32::turned_again(g, r.cosine, cosine)));
            }
    for (double away : {0.0, 1e-7, 1.0, 1e6})
        for (double distance : {0.0, 1e-6, 1.0, 1e30})
            for (double s : {0.0, 1e-12, 0.1, 1e4})
                for (double g : {-1.0, 0.0, 1.0}) {
                    Case c;
                    c.medium = constant_medium(f64::vec3(s, 0, s), f64::vec3(0, s, s), g);
                    c.lights = {airlight_cases::light_at({0, 0, -away}), airlight_cases::light_at({away, 0, 0})};
                    c.lights[1].type = f64::light_spot;
                    c.lights[1].cos_outer = 0.5;
                    c.lights[1].cos_inner = 0.7f;
                    c.distance = distance;
                    World world(c);
                    for (int planes : {0, 1, 6}) {
                        for (int side = 0; side < planes; ++side)
                            world.add_plane((side + 2) % 6 / 2, side % 2 == 1, 2);
                        const f32::vec3 single = world.airlight(f32::airlight_nodes).radiance;
                        world.settings.orders = f32::orders_all;
                        const f32::vec3 all = world.airlight(f32::airlight_nodes).radiance;
                        world.settings.orders = f32::orders_single;
                        for (int k = 0; k < 3; ++k)
                            ASSERT_TRUE(std::isfinite(all[k]) && all[k] >= single[k])
                                << all[k] << ": light at " << away << ", D " << distance << ", sigma " << s << ", g " << g;
                    }
                }
}

// The brightest lamp there may be, in units so small that all is at hand: its light is cut at a limit, and not an infinity
// of which transmittances of 0 make no number.
TEST(LampOrders, TheBrightestLampAmongGaussiansIsFinite)
{
    const std::string text = R"({"brume":1,"metres_per_unit":1e-10,
        "camera":{"vertical_fov":100,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":[1e-20,1e10,1e25],"density":[
          {"type":"gaussian","center":[-0.6,-3,-9],"scale":3e-4,"amplitude":1},
          {"type":"gaussian","center":[-3,3,-7],"scale":1.7e-3,"amplitude":1e28},
          {"type":"gaussian","center":[5,2,-9],"scale":1.6e-7,"amplitude":50}]},
        "lights":[{"type":"spot","position":[3,9,-8],"direction":[0,-1,0],"intensity":1e30,"angle":100,"penumbra":0.4}],
        "effects":{"airlight":{"orders":"all"}}})";
    for (fog::Context *context : {&fog::cpu(), fog::gl()}) {
        if (!context)
            continue;
        const fog::Picture out = fog::run(*context, text, fog::Picture(8, 6, 4, 0.5f), fog::Picture(8, 6, 1, 10)).output;
        for (float v : out.data)
            ASSERT_TRUE(std::isfinite(v)) << v;
    }
}
