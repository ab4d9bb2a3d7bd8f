// Lights left out where they cannot matter (lamp_order.glsl): the bounds hold, and no pixel moves by more than its share.
#include <gtest/gtest.h>

#include "airlight_world.h"
#include "lit_scene.h"

namespace {

using namespace airlight_cases;

// Many lights around a camera, of every kind, in any medium without Gaussians.
Case many_lights(Dice &dice, int count)
{
    Case c = dice.chance(0.5) ? homogeneous(dice, 1, dice.logarithmic(0.05, 8)) : exponential(dice);
    if (dice.chance(0.2))
        c.medium.phase = droplets(dice).medium.phase;
    else
        c.medium.phase.x = dice.uniform(0, 0.9);
    const double extent = dice.logarithmic(2, 30) * glm::length(c.lights[0].position);
    while (int(c.lights.size()) < count) {
        Light l = light_at(extent * dice.uniform(0, 1) * dice.direction());
        l.intensity = rounded(dice.logarithmic(0.1, 10) * vec3(1, dice.uniform(0.3, 1), dice.uniform(0.1, 1)));
        l.radius = dice.chance(0.5) ? dice.logarithmic(0.01, 1) : 0;
        if (dice.chance(0.3)) {
            l.type = light_spot;
            l.direction = rounded(dice.direction());
            l.cos_outer = float(std::cos(dice.uniform(10, 80) * degree));
            l.cos_inner = dice.uniform(l.cos_outer, 1);
        } else if (dice.chance(0.05)) {
            l.type = light_directional;
            l.position = vec3(0);
            l.direction = rounded(dice.direction());
            l.distance = dice.uniform(0, 10);
            l.radius = 0;
        }
        c.lights.push_back(l);
    }
    return c;
}

// A tile's rays, of which the case's is one.
narrow::TileRays tile_around(Dice &dice, Case &c)
{
    const vec3 axis = rounded(dice.direction());
    const double angle = dice.logarithmic(1e-3, 0.5);
    c.direction = rounded(dice.near_direction(axis, angle * dice.uniform(0, 1)));
    narrow::TileRays rays{};
    rays.axis = narrow::vec3(axis);
    rays.cosine = float(std::cos(angle));
    rays.sine = 1.0001f * float(std::sin(angle)) + 1e-6f;
    rays.spread = 1.0001f * float(2 * std::sin(angle / 2));
    rays.distance = std::min(float(c.distance * dice.uniform(1, 3)), narrow::quadrature_limit);
    return rays;
}

TEST(LampOrder, NoLightSendsMoreThanItsBound)
{
    Dice dice(1);
    std::vector<double> shares;
    for (int i = 0; i < 400; ++i) {
        Case c = many_lights(dice, 6);
        const narrow::TileRays rays = tile_around(dice, c);
        const World world(c);
        for (int l = 0; l < int(c.lights.size()); ++l) {
            const auto exact =
                brume::airlight::reference_airlight({c.medium, {}, c.lights}, c.direction, c.distance, l, l + 1, 1e-4)
                    .radiance;
            const double most = std::max({exact.x, exact.y, exact.z}), bound = world.bound_of(rays, l);
            ASSERT_LE(most, bound + 1e-30) << "case " << i << ", light " << l;
            if (most > 1e-25)
                shares.push_back(most / bound);
        }
    }
    const double middle = quantile(shares, 0.5);
    printf("of its bound a light sends %.2g in the middle, %.2g at most\n", middle, quantile(shares, 1));
    EXPECT_GT(middle, 0.15);
}

TEST(LampOrder, NoPixelMovesByMoreThanItsShare)
{
    Dice dice(2);
    double worst = 0, kept = 0;
    int some_cut = 0, uncovered = 0;
    constexpr int cases = 400;
    for (int i = 0; i < cases; ++i) {
        const int count = int(dice.logarithmic(2, 64.99));
        Case c = many_lights(dice, count);
        const narrow::TileRays rays = tile_around(dice, c);
        World world(c);
        world.settings.tolerance = 1e-6f;
        world.settings.panels = 64;
        const narrow::Airlight all = world.airlight(narrow::airlight_nodes);
        world.order_for(rays);
        const narrow::Airlight found = world.airlight(narrow::airlight_nodes);
        const double whole = (double(all.radiance.x) + all.radiance.y + all.radiance.z) / 3;
        if (whole < 1e-20)
            continue;
        for (int k = 0; k < 3; ++k) {
            const double apart = std::abs(double(found.radiance[k]) - all.radiance[k]);
            worst = std::max(worst, apart / whole);
            uncovered += apart > found.error[k] + 1e-5 * whole;
        }
        int left = count;
        while (left > 0 && world.rest(left - 1) <= world.settings.spared * whole)
            --left;
        some_cut += left < count;
        kept += double(left) / count / cases;
    }
    printf("all lights but %.2g of a pixel's light; %.0f %% are kept in the mean\n", worst, 100 * kept);
    EXPECT_LT(worst, 0.1 * 0.01 + 1e-5);
    EXPECT_GT(worst, 1e-5);
    EXPECT_EQ(uncovered, 0);
    EXPECT_GT(some_cut, cases / 4);
}

}  // namespace

namespace fog {
namespace {

// A street of lanterns in dense fog, a spot among them, with walls, a post and the sky; and, where asked, a puff in a
// corner.
Json avenue(bool puff = false)
{
    Json lamps = Json::array();
    for (int i = 0; i < 40; ++i) {
        Json lamp = point_light({i % 2 ? 4.0 : -4.0, 2, -4 - 3.0 * i}, 0, 0.1);
        lamp["intensity"] = {9 + i % 5, 6, 3};
        lamps.push_back(lamp);
    }
    lamps.push_back(
        {{"type", "spot"}, {"position", {0, 4, -9}}, {"direction", {0, -1, 0}}, {"intensity", 20}, {"angle", 70}});
    Json density =
        Json::array({constant(0.4), {{"type", "exponential"}, {"value", 1}, {"falloff", 0.2}, {"direction", {0, 1, 0}}}});
    if (puff)
        density.push_back(gaussian({3, 2, -8}, 1.2, 2));
    return lit_scene({{"scattering", {0.12, 0.12, 0.13}}, {"absorption", 0.01}, {"g", 0.7}, {"density", density}}, lamps,
                     {{"orders", "single"}, {"tier", "nodes"}});
}

float brightest(const Picture &p)
{
    return *std::max_element(p.data.begin(), p.data.end());
}

Frame street_frame()
{
    return lit_frame(72, 56);
}

TEST(LampOrder, PicturesAreThoseOfAllLightsAndShowNoTiles)
{
    const Frame frame = street_frame();
    const Json scene = avenue();
    Options options{{}, {"airlight", "airlight_error"}};
    options.lights = uint32_t(scene["lights"].size());
    const Result r = run(cpu(), scene.dump(), frame.color, frame.depth, options);
    const int width = frame.color.width, height = frame.color.height;
    Picture moved(width, height, 1);
    const double floor = 1e-3 * brightest(r.airlight);
    double worst = 0, mean = 0, uncovered = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double all = 0, found = 0;
            for (int c = 0; c < 3; ++c) {
                double of_colour = 0;
                for (const Picture &alone : r.light_airlight)
                    of_colour += alone.at(x, y)[c];
                all += of_colour / 3;
                found += r.airlight.at(x, y)[c] / 3;
                uncovered =
                    std::max(uncovered, (std::abs(of_colour - r.airlight.at(x, y)[c]) - r.airlight_error.at(x, y)[c]) /
                                            std::max(of_colour, floor));
            }
            const double by = (all - found) / std::max(all, floor);
            moved.at(x, y)[0] = float(by);
            worst = std::max(worst, std::abs(by));
            mean += std::abs(by) / (width * height);
        }
    double at_edges = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double here = moved.at(x, y)[0];
            if (x > 0 && x % 16 == 0)
                at_edges = std::max(at_edges, std::abs(here - moved.at(x - 1, y)[0]));
            if (y > 0 && y % 16 == 0)
                at_edges = std::max(at_edges, std::abs(here - moved.at(x, y - 1)[0]));
        }
    printf("%.2g off in the mean, %.2g at most, steps of %.2g between tiles\n", mean, worst, at_edges);
    EXPECT_LT(worst, 0.1 * 0.01);
    EXPECT_LT(at_edges, 0.1 * 0.01);
    EXPECT_LT(uncovered, 1e-4);
    EXPECT_GT(mean, 1e-5);
}

TEST(LampOrder, IsTheSameOnAnyNumberOfThreadsAndInAnyListing)
{
    const Frame frame = street_frame();
    Json scene = avenue(true);
    Context one(BRUME_BACKEND_CPU, 1), five(BRUME_BACKEND_CPU, 5);
    const Options options{{}, {"airlight"}};
    const Picture found = run(one, scene.dump(), frame.color, frame.depth, options).airlight;
    EXPECT_EQ(found.data, run(five, scene.dump(), frame.color, frame.depth, options).airlight.data);
    std::reverse(scene["lights"].begin(), scene["lights"].end());
    const Worst worst =
        compare(run(one, scene.dump(), frame.color, frame.depth, options).airlight, found, 1e-3 * brightest(found));
    EXPECT_LT(worst.error, 0.01) << worst.describe();
}

#ifdef BRUME_GL
TEST(LampOrder, GpuAgainstCpu)
{
    const Frame frame = lit_frame(40, 30);
    const Options options{{}, {"airlight"}};
    const Json scene = avenue(true);
    const Picture a = run(backend("gl"), scene.dump(), frame.color, frame.depth, options).airlight,
                  b = run(cpu(), scene.dump(), frame.color, frame.depth, options).airlight;
    const Worst worst = compare(a, b, 1e-3 * brightest(b));
    printf("worst %.2g\n", worst.error);
    EXPECT_LT(worst.error, 1e-3) << worst.describe();
}
#endif

}  // namespace
}  // namespace fog
