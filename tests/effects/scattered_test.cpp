// Light that has been scattered before, from a grid over the view, against the same light at each pixel's own points.
#include <gtest/gtest.h>

#include "lit_scene.h"
#include "picture_metrics.h"

namespace {

using namespace fog;

Json of_all_orders(Json scene, double max_error = 0.01, const char *tier = "auto")
{
    scene["effects"]["airlight"]["orders"] = "all";
    scene["effects"]["airlight"]["max_error"] = max_error;
    scene["effects"]["airlight"]["tier"] = tier;
    return scene;
}

// The grid is not for errors so small.
Json at_each_pixel(const Json &scene)
{
    return of_all_orders(scene, 0.002, "nodes");
}

Picture airlight_of(brume_context context, const Json &scene, const Frame &frame)
{
    return run(context, scene.dump(), frame.color, frame.depth, Options{{}, {"airlight"}}).airlight;
}

struct Errors {
    double rel_mse = 0, p95 = 0, energy = 0;
};

// Of pixels, relative to them or to a twentieth of the picture's mean.
Errors errors(const Picture &a, const Picture &exact)
{
    Errors e;
    e.rel_mse = rel_mse(a, exact);
    double mean = 0, sum = 0;
    for (size_t i = 0; i < exact.data.size(); ++i) {
        mean += double(exact.data[i]) / double(exact.data.size());
        sum += double(a.data[i]) / double(exact.data.size());
    }
    e.energy = sum / mean;
    std::vector<double> all;
    for (size_t i = 0; i < exact.data.size(); ++i)
        all.push_back(std::abs(double(a.data[i]) - double(exact.data[i])) / std::max(double(exact.data[i]), 0.05 * mean));
    std::sort(all.begin(), all.end());
    e.p95 = all[size_t(0.95 * double(all.size()))];
    return e;
}

// How far the grid's is off, beside all light.
Errors errors_of(const Json &scene, const Frame &frame, const char *tier = "nodes")
{
    auto beside_single = [&](Json all) {
        Picture p = airlight_of(cpu(), all, frame);
        all["effects"]["airlight"]["orders"] = "single";
        const Picture single = airlight_of(cpu(), all, frame);
        for (size_t i = 0; i < p.data.size(); ++i)
            p.data[i] -= single.data[i];
        return p;
    };
    Picture a = beside_single(of_all_orders(scene, 0.01, tier)), exact = beside_single(at_each_pixel(scene));
    Json single = at_each_pixel(scene);
    single["effects"]["airlight"]["orders"] = "single";
    const Picture rest = airlight_of(cpu(), single, frame);
    for (size_t i = 0; i < a.data.size(); ++i) {
        a.data[i] += rest.data[i];
        exact.data[i] += rest.data[i];
    }
    return errors(a, exact);
}

// Lamps along both sides of a way into haze, where most light is scattered again.
Json avenue(const Json &further = Json::object())
{
    Json lamps = Json::array();
    for (int i = 0; i < 6; ++i) {
        lamps.push_back(point_light({i % 2 ? 3.5 : -3.0, 2, -5.0 - 5 * i}, 1, 0.1));
        lamps.back()["intensity"] = {9 + i, 6, 9 - i};
    }
    Json medium{{"scattering", {0.07, 0.075, 0.08}}, {"absorption", 0.004}, {"g", 0.8}};
    medium.update(further);
    return lit_scene(medium, lamps);
}

Json banks(int count)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<double> u(0, 1);
    Json density{constant(0.3)};
    for (int i = 0; i < count; ++i)
        density.push_back(gaussian({10 * u(random) - 5, 3 * u(random) - 1, -4 - 26 * u(random)}, 1 / (1 + 1.5 * u(random)),
                                   6 * u(random)));
    return density;
}

std::vector<NamedScene> scenes()
{
    std::vector<NamedScene> all = lit_scenes();
    all.push_back({"avenue", avenue(), {}});
    all.push_back({"avenue, banks of fog", avenue({{"density", banks(12)}}), {}});
    Json sunny = avenue();
    sunny["lights"].push_back(
        {{"type", "directional"}, {"direction", {0.3, -1, -0.4}}, {"intensity", 0.2}, {"distance", 20}});
    all.push_back({"avenue under a sun", sunny, {}});
    return all;
}

std::string entry_of(const Json &scene, const std::string &name)
{
    const Plan plan(cpu(), scene.dump(), 320, 180);
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    brume_plan_get_info(plan, &info);
    for (uint32_t e = 0; e < info.entry_count; ++e) {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        brume_plan_get_entry(plan, e, &entry);
        if (entry.runs && entry.name == name)
            return entry.reason;
    }
    return "";
}

TEST(Scattered, PlansSayWhichGridTheyTake)
{
    EXPECT_EQ(entry_of(of_all_orders(avenue()), "scattered"),
              "41 x 24 rays of 65 points, 1.2 MB, have what arrives scattered more than once");
    EXPECT_EQ(entry_of(at_each_pixel(avenue()), "scattered"), "");
    EXPECT_EQ(entry_of(of_all_orders(avenue(), 0.01, "reference"), "scattered"), "");
    EXPECT_NE(entry_of(of_all_orders(avenue({{"density", banks(100)}}), 0.01, "maps"), "scattered"), "");
}

TEST(Scattered, AgreesWithEachPixelsOwn)
{
    const Frame frame = lit_frame(60, 40);
    for (const NamedScene &s : scenes()) {
        const Errors e = errors_of(s.scene, frame);
        printf("%s: relMSE %.1e, 95 %% %.2e, energy %.4f\n", s.name, e.rel_mse, e.p95, e.energy);
        EXPECT_LT(e.rel_mse, 3e-5) << s.name;
        EXPECT_LT(e.p95, 0.02) << s.name;
        EXPECT_NEAR(e.energy, 1, 0.007) << s.name;
    }
}

TEST(Scattered, MapsTakeItToo)
{
    const Frame frame = lit_frame(60, 40);
    const Json scene = avenue({{"density", banks(40)}});
    const Errors e = errors_of(scene, frame, "maps");
    printf("maps: relMSE %.1e, 95 %% %.2e, energy %.4f\n", e.rel_mse, e.p95, e.energy);
    EXPECT_LT(e.rel_mse, 3e-5);
    EXPECT_LT(e.p95, 0.02);
    EXPECT_NEAR(e.energy, 1, 0.005);
}

// The grid is the view's, whatever its pixels.
TEST(Scattered, AnyResolutionIsAsNear)
{
    const Json scene = avenue({{"density", banks(3)}});
    for (int height : {24, 48, 120}) {
        const Frame frame = lit_frame(height * 3 / 2, height);
        const Errors e = errors_of(scene, frame);
        printf("%d x %d: relMSE %.1e, 95 %% %.2e, energy %.4f\n", height * 3 / 2, height, e.rel_mse, e.p95, e.energy);
        EXPECT_LT(e.p95, 0.005) << height;
        // A ray through a lamp misses some of the forward peak around it. In the least picture such a pixel counts.
        EXPECT_LT(e.rel_mse, height < 30 ? 2e-4 : 2e-5) << height;
        EXPECT_NEAR(e.energy, 1, height < 30 ? 0.02 : 0.003) << height;
    }
}

// Light and its error: of fewer pixels, of single lights.
TEST(Scattered, OfEveryLightIsTheSum)
{
    const Frame frame = lit_frame(50, 34);
    for (const char *tier : {"nodes", "maps"}) {
        Json scene = of_all_orders(avenue({{"density", banks(8)}}), 0.01, tier);
        const Picture together = airlight_of(cpu(), scene, frame);
        Picture sum = together;
        std::fill(sum.data.begin(), sum.data.end(), 0.0f);
        const Json lights = scene["lights"];
        for (const Json &light : lights) {
            scene["lights"] = Json::array({light});
            const Picture one = airlight_of(cpu(), scene, frame);
            for (size_t i = 0; i < one.data.size(); ++i)
                sum.data[i] += one.data[i];
        }
        const Errors e = errors(together, sum);
        EXPECT_LT(e.p95, 0.02) << tier;
        EXPECT_NEAR(e.energy, 1, 0.003) << tier;
    }
}

// Its distances are not the grid's.
TEST(Scattered, ALampThatIsOffIsAsNone)
{
    const Frame frame = lit_frame(48, 32);
    Json lit = of_all_orders(avenue()), beside = lit;
    beside["lights"].push_back(point_light({0.5, 1, -12}, 0, 0.1));
    const Picture exact = airlight_of(cpu(), lit, frame), got = airlight_of(cpu(), beside, frame);
    const Worst worst = compare(got, exact, 1e-4);
    EXPECT_LT(worst.error, 1e-5) << worst.describe();
}

TEST(Scattered, AnyNumberOfThreadsBitForBit)
{
    const Frame frame = lit_frame(51, 34);
    Context one(BRUME_BACKEND_CPU, 1), three(BRUME_BACKEND_CPU, 3);
    for (const char *tier : {"nodes", "maps"}) {
        const Json scene = of_all_orders(avenue({{"density", banks(20)}}), 0.01, tier);
        EXPECT_EQ(airlight_of(one, scene, frame).data, airlight_of(three, scene, frame).data) << tier;
    }
}

#ifdef BRUME_GL
TEST(Scattered, GpuAgainstCpu)
{
    const Frame frame = lit_frame(50, 34);
    for (const NamedScene &s : {scenes()[4], scenes().back()}) {
        const Json scene = of_all_orders(s.scene);
        const Errors e = errors(airlight_of(backend("gl"), scene, frame), airlight_of(cpu(), scene, frame));
        printf("%s: relMSE %.1e, 95 %% %.2e, energy %.6f\n", s.name, e.rel_mse, e.p95, e.energy);
        EXPECT_LT(e.p95, 1e-3) << s.name;
        EXPECT_LT(e.rel_mse, 1e-7) << s.name;
    }
}
#endif

// The grid moves with the camera: from frame to frame pictures change as those of each pixel's own light.
TEST(Scattered, DoesNotFlicker)
{
    const Frame frame = lit_frame(72, 48);
    Json scene = avenue();
    auto moved = [&](const Json &of, int step) {
        Json there = of;
        there["camera"]["camera_to_world"] = pose({0.02 * step, 0, -0.05 * step}, 0.003 * step);
        return airlight_of(cpu(), there, frame);
    };
    double most = 0;
    for (int step = 0; step < 3; ++step) {
        const Picture a = moved(of_all_orders(scene), step), b = moved(of_all_orders(scene), step + 1),
                      exact_a = moved(at_each_pixel(scene), step), exact_b = moved(at_each_pixel(scene), step + 1);
        double change = 0, flicker = 0;
        for (size_t i = 0; i < a.data.size(); ++i) {
            const double exact = double(exact_b.data[i]) - double(exact_a.data[i]),
                         error = double(b.data[i]) - double(a.data[i]) - exact;
            change += exact * exact;
            flicker += error * error;
        }
        most = std::max(most, std::sqrt(flicker / change));
    }
    printf("of a frame's change %.2g is the grid's\n", most);
    EXPECT_LT(most, 0.05);
}

}  // namespace
