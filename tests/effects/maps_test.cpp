// Tier `maps`: attenuation maps and a grid, against tier `nodes`, which integrates the same media along each ray.
#include <ctime>
#include <limits>

#include <gtest/gtest.h>

#include "clouds.h"

namespace {

using namespace fog;

// Of all lights together against the sum of each alone.
Errors against_each(const Json &density, const Json &lights, const Frame &frame)
{
    auto lit_by = [&](const Json &some) { return airlight_of(cpu(), with(scene_of(density, some), "tier", "maps"), frame); };
    const Picture together = lit_by(lights);
    Picture sum = together;
    std::fill(sum.data.begin(), sum.data.end(), 0.0f);
    for (const Json &one : lights) {
        const Picture p = lit_by(Json::array({one}));
        for (size_t i = 0; i < p.data.size(); ++i)
            sum.data[i] += p.data[i];
    }
    return errors(together, sum);
}

// A cloud before the camera and a wide one behind it, a lamp between the two.
Json on_both_sides()
{
    Json all = cloud(200, 13);
    for (Json g : cloud(200, 14)) {
        const Vector c = g["center"];
        g["center"] = {10 * c[0], 10 * c[1], 20 - 3 * c[2]};
        all.push_back(g);
    }
    return scene_of(all, Json::array({point_light({20, 10, 20}, 20000)}));
}

Json sun()
{
    return {{"type", "directional"}, {"direction", {0.3, -1, 0.2}}, {"intensity", 3}, {"distance", 5}};
}

std::vector<NamedScene> clouds()
{
    std::vector<NamedScene> all;
    all.push_back({"a cloud, three lamps, one in it", scene_of(cloud(300, 1), lamps(3)), {}});
    all.push_back(
        {"absorbing, coloured, forward",
         scene_of(cloud(300, 2), lamps(2), {{"scattering", {0.8, 0.6, 0.4}}, {"absorption", {0.1, 0.2, 0.4}}, {"g", 0.7}}),
         {}});
    all.push_back({"tinted puffs", scene_of(cloud(200, 3, 0.6), lamps(2)), {}});
    Json hazy = cloud(200, 4);
    hazy.push_back(constant(0.02));
    hazy.push_back(
        {{"type", "exponential"}, {"value", 0.05}, {"falloff", 0.5}, {"direction", {0, 1, 0}}, {"origin", {0, -2, 0}}});
    all.push_back({"puffs in haze", scene_of(hazy, lamps(2)), {}});
    all.push_back({"sun", scene_of(cloud(300, 5), Json::array({sun()})), {}});
    const Json spot{{"type", "spot"}, {"position", {-3, 4, -7}}, {"direction", {0.5, -0.8, -0.2}},
                    {"angle", 40},    {"penumbra", 0.4},         {"intensity", 60}};
    all.push_back({"spot", scene_of(cloud(300, 6), Json::array({spot})), {}});
    const Json beam{{"type", "spot"},  {"position", {-25, 40, -20}}, {"direction", {0.5, -0.85, 0.24}}, {"angle", 7},
                    {"penumbra", 0.3}, {"intensity", 20000}};
    all.push_back({"a lamp and a spot, far away",
                   scene_of(cloud(200, 12), Json::array({point_light({40, 20, 10}, 20000), beam})),
                   {}});
    all.push_back({"clouds before and behind the camera", on_both_sides(), {}});
    Json inside = cloud(200, 7);
    for (Json &g : inside)
        g["center"][2] = g["center"][2].get<double>() + 8.5;
    all.push_back({"the camera in the cloud", scene_of(inside, lamps(2)), {}});
    return all;
}

// One test, since what is exact takes most of its time.
TEST(AirlightMaps, AgreeWithNodesAndBoundTheirError)
{
    const Frame frame = lit_frame(96, 64);
    int bounded = 0, all = 0;
    std::vector<double> excess;
    for (const NamedScene &s : clouds()) {
        const Picture exact = airlight_of(cpu(), with(with(s.scene, "tier", "nodes"), "max_error", 0.0005), frame);
        const Result r = run(cpu(), with(s.scene, "tier", "maps").dump(), frame.color, frame.depth,
                             Options{{}, {"airlight", "airlight_error"}});
        const Errors e = errors(r.airlight, exact),
                     fine =
                         errors(airlight_of(cpu(), with(with(s.scene, "tier", "maps"), "max_error", 0.001), frame), exact);
        report(s.name, e);
        report("  max_error .001", fine);
        // These Gaussians are a few pixels wide, so that their cells are pixels: the rims of the cloud are what is left.
        EXPECT_LT(e.median, 0.004) << s.name;
        EXPECT_LT(e.p95, 0.02) << s.name;
        EXPECT_LT(fine.median, 0.002) << s.name;
        EXPECT_LT(fine.p95, 0.015) << s.name;
        int here = 0, of = 0;
        for (size_t i = 0; i < exact.data.size(); ++i) {
            const double error = std::abs(double(r.airlight.data[i]) - double(exact.data[i]));
            here += error <= double(r.airlight_error.data[i]) + 1e-5 * double(exact.data[i]);
            ++of;
            if (error > 1e-6 * double(exact.data[i]))
                excess.push_back(double(r.airlight_error.data[i]) / error);
        }
        printf("%s: bounded in %.1f %%\n", s.name, 100.0 * here / of);
        bounded += here;
        all += of;
    }
    std::sort(excess.begin(), excess.end());
    printf("median of estimate / error %.2g\n", excess[excess.size() / 2]);
    EXPECT_GE(double(bounded) / all, 0.95);
    EXPECT_LE(excess[excess.size() / 2], 10);
}

// Where the grid has sums of lights, which an error layer does without.
// A cloud far aside makes the box about all Gaussians thirty times as wide, which is nothing to the light on those in view.
TEST(AirlightMaps, OfSunsAreFittedToWhatIsSeen)
{
    Json both = cloud(200, 15);
    for (Json g : cloud(50, 16)) {
        const Vector c = g["center"];
        g["center"] = {c[0] + 200, c[1], c[2]};
        both.push_back(g);
    }
    const Frame frame = lit_frame(96, 64);
    Context context(BRUME_BACKEND_CPU);
    const Errors e =
        errors(airlight_of(context, with(scene_of(both, Json::array({sun()})), "tier", "maps"), frame),
               airlight_of(context, with(scene_of(cloud(200, 15), Json::array({sun()})), "tier", "maps"), frame));
    report("a cloud out of view", e);
    EXPECT_LT(e.median, 1e-3);
    EXPECT_LT(e.p95, 2e-2);
}

// A side of a map that far away is narrower than doubles tell apart.
TEST(AirlightMaps, OfAGaussianOfNoWidthIsFinite)
{
    const Frame frame = lit_frame(16, 12);
    const Json sideways{{"type", "directional"}, {"direction", {1, 0, 0}}, {"intensity", 3}},
        density = Json::array({gaussian({0, 0, -1000}, 1e18, 1), constant(0.05)});
    const Errors e = errors(airlight_of(cpu(), with(scene_of(density, Json::array({sideways})), "tier", "maps"), frame),
                            airlight_of(cpu(), with(scene_of(density, Json::array({sideways})), "tier", "nodes"), frame));
    report("no width", e);
    EXPECT_LT(e.worst, 1e-2);
}

TEST(AirlightMaps, SumsAgreeWithEachLight)
{
    const Frame frame = lit_frame(320, 200);
    const Json scene = with(scene_of(cloud(300, 21), lamps(3)), "tier", "maps");
    const Picture sums = airlight_of(cpu(), scene, frame),
                  each = run(cpu(), scene.dump(), frame.color, frame.depth, Options{{}, {"airlight", "airlight_error"}})
                             .airlight;
    const Errors e = errors(sums, each);
    report("sums", e);
    EXPECT_GT(e.worst, 0) << "the grid has no sums";
    EXPECT_LT(e.median, 1e-3);
    EXPECT_LT(e.p95, 3e-3);
}

// Forward scattering bends across cells, of some lights at some steps: these are looked up by themselves, the rest is
// summed.
Json forward(const Json &lights)
{
    Json density = cloud(400, 31);
    density.push_back(
        {{"type", "exponential"}, {"value", 0.02}, {"falloff", 0.3}, {"direction", {0, 1, 0}}, {"origin", {0, -2, 0}}});
    return with(scene_of(density, lights, {{"g", 0.8}}), "tier", "maps");
}

TEST(AirlightMaps, SumsOfForwardScatteringAgreeWithEachLight)
{
    const Frame frame = lit_frame(240, 400);
    const Json scene = forward(lamps(3));
    const Picture sums = airlight_of(cpu(), scene, frame),
                  each = run(cpu(), scene.dump(), frame.color, frame.depth, Options{{}, {"airlight", "airlight_error"}})
                             .airlight;
    const Errors e = errors(sums, each);
    report("sums", e);
    EXPECT_GT(e.worst, 1e-5) << "the grid has no sums";
    EXPECT_LT(e.median, 1e-3);
    EXPECT_LT(e.p95, 3e-3);
}

// A few wide puffs.
Json wide_puffs(int count, double depth)
{
    std::mt19937 random(41);
    std::uniform_real_distribution<double> u(0, 1);
    Json all = Json::array();
    for (int i = 0; i < count; ++i)
        all.push_back(gaussian({8 * u(random) - 4, 6 * u(random) - 2, depth - 4 * u(random)}, 0.5, 0.8));
    return all;
}

// A beam is narrower than the grid's steps are long, and ends as sharply as it is told.
TEST(AirlightMaps, NarrowSpotsAreWholeBeams)
{
    const Frame frame{Picture(120, 80, 4), Picture(120, 80, 1, 25)};
    struct Spot {
        const char *name;
        double angle, penumbra;
    };
    for (const Spot &s :
         {Spot{"10 degrees", 10, 0.3}, Spot{"20 degrees", 20, 0.1}, Spot{"60 degrees, no penumbra", 60, 0}}) {
        const Json spot{{"type", "spot"},   {"position", {-5, 2, -9}}, {"direction", {1, -0.1, 0}},
                        {"angle", s.angle}, {"penumbra", s.penumbra},  {"intensity", 900}};
        const Json scene = scene_of(wide_puffs(20, -7), Json::array({spot}), {{"scattering", 0.15}, {"g", 0.3}});
        const Picture exact = airlight_of(cpu(), with(with(scene, "tier", "nodes"), "max_error", 0.0001), frame),
                      maps = airlight_of(cpu(), with(scene, "tier", "maps"), frame);
        const Errors e = errors(maps, exact);
        report(s.name, e);
        EXPECT_LT(e.p95, 0.01) << s.name;
        double all = 0, of = 0;
        for (size_t i = 0; i < maps.data.size(); ++i) {
            all += maps.data[i];
            of += exact.data[i];
        }
        EXPECT_NEAR(all / of, 1, 0.005) << s.name;
    }
}

// A wall that recedes through a bank: what lies before it of the step that it ends grows with the density there, not with
// its length.
TEST(AirlightMaps, SurfacesCutClouds)
{
    Frame frame{Picture(192, 64, 4), Picture(192, 64, 1)};
    for (int y = 0; y < frame.depth.height; ++y)
        for (int x = 0; x < frame.depth.width; ++x)
            frame.depth.at(x, y)[0] = 6 + 5 * float(x) / float(frame.depth.width);
    Json bank = Json::array();
    for (int i = 0; i < 11; ++i)
        bank.push_back(gaussian({1.2 * i - 6, 0.6 * (i % 3 - 1), -10 - 0.3 * (i % 2)}, 0.55, 0.8));
    for (int lights : {1, 6}) {
        Json scene = scene_of(bank, lamps(lights), {{"scattering", 0.3}, {"g", 0.2}});
        scene["camera"]["vertical_fov"] = 25;
        const Picture exact = airlight_of(cpu(), with(with(scene, "tier", "nodes"), "max_error", 0.0001), frame);
        const Errors e = errors(airlight_of(cpu(), with(scene, "tier", "maps"), frame), exact);
        report("a wall in a bank", e);
        EXPECT_LT(e.p95, 0.006);
    }
}

// Cells are as fine as the wider side of pixels asks, and Gaussians are narrowed by both.
TEST(AirlightMaps, PixelsThatAreNoSquares)
{
    for (double aspect : {0.5, 1.0, 2.0}) {
        Json scene = scene_of(cloud(60, 19), lamps(3));
        scene["camera"]["pixel_aspect"] = aspect;
        const Frame frame = lit_frame(aspect == 2 ? 72 : 144, aspect == 0.5 ? 48 : 96);
        const Picture exact = airlight_of(cpu(), with(with(scene, "tier", "nodes"), "max_error", 0.002), frame);
        const Errors e = errors(airlight_of(cpu(), with(scene, "tier", "maps"), frame), exact);
        report(("pixels " + std::to_string(aspect) + " times as wide as high").c_str(), e);
        EXPECT_LT(e.median, 0.003);
        EXPECT_LT(e.p95, 0.015);
    }
}

// Nothing but what the picture shows moves: sums that end there go on, and then stay.
TEST(AirlightMaps, FollowWhatThePictureShows)
{
    const Json scene = with(scene_of(cloud(60, 42), lamps(6)), "tier", "maps");
    const Options options{{}, {"airlight"}};
    const Picture color(400, 240, 4), near(400, 240, 1, 5), far(400, 240, 1, 30);
    const Plan plan(cpu(), scene.dump(), 400, 240, options);
    const Picture first = plan.execute(color, near, options).airlight;
    const Picture after = plan.execute(color, far, options).airlight,
                  alone = Plan(cpu(), scene.dump(), 400, 240, options).execute(color, far, options).airlight;
    EXPECT_EQ(after.data, alone.data);
    EXPECT_EQ(plan.execute(color, near, options).airlight.data, first.data);
}

// Cells are as fine as the frame's Gaussians ask, not those that the plan was made with.
TEST(AirlightMaps, FollowGaussiansThatShrink)
{
    const auto scene = [](const Json &scale) {
        Json all = Json::array();
        for (Json g : wide_puffs(20, -8)) {
            g["scale"] = scale;
            all.push_back(g);
        }
        return with(scene_of(all, lamps(2)), "tier", "maps").dump();
    };
    Options options{{}, {"airlight"}};
    const Picture color(480, 270, 4), depth(480, 270, 1, 30);
    const Plan plan(cpu(), scene(Json{{"keys", {{1, 0.5}, {2, 1}}}}), color.width, color.height, options);
    options.frame = 1;
    plan.execute(color, depth, options);
    options.frame = 2;
    const Picture shrunken = plan.execute(color, depth, options).airlight,
                  planned =
                      Plan(cpu(), scene(1), color.width, color.height, options).execute(color, depth, options).airlight;
    EXPECT_EQ(shrunken.data, planned.data);
}

// More than the grid can tell apart.
TEST(AirlightMaps, SumsOfManyLightsAreTheSumOfEach)
{
    const Frame frame = lit_frame(320, 200);
    std::mt19937 random(32);
    std::uniform_real_distribution<double> u(0, 1);
    Json all = Json::array();
    for (int i = 0; i < 26; ++i)
        all.push_back(point_light({8 * u(random) - 4, 6 * u(random) - 3, -5 - 8 * u(random)}, 5 + 10 * u(random), 0.05));
    const Errors e = against_each(cloud(300, 33), all, frame);
    report("26 lamps", e);
    EXPECT_LT(e.median, 1e-3);
    EXPECT_LT(e.worst, 0.02) << e.x << ", " << e.y;
}

#ifdef BRUME_GL
TEST(AirlightMaps, GpuAgainstCpu)
{
    auto compare = [](const char *name, const Json &scene, const Frame &frame) {
        const Errors e = errors(airlight_of(backend("gl"), scene, frame), airlight_of(cpu(), scene, frame));
        report(name, e);
        // GPUs give the fraction of a bilinear fetch 8 bits, and around a lamp that decides whether a step is halved.
        EXPECT_LT(e.p95, 1e-3) << name;
        EXPECT_LT(e.worst, 0.1) << name << " at " << e.x << ", " << e.y;
    };
    for (const NamedScene &s : clouds())
        compare(s.name, with(s.scene, "tier", "maps"), lit_frame(64, 40));
    compare("sums of forward scattering", forward(lamps(3)), lit_frame(240, 400));
}
#endif

// What several lights send is summed before it is looked up, so that another costs little where nothing moves.
TEST(AirlightMaps, EightLampsCostLittleMoreThanOne)
{
    const Frame frame = lit_frame(640, 400);
    const Json density = cloud(1000, 15), all = lamps(8);
    const Options options{{}, {"airlight"}};
    Context one(BRUME_BACKEND_CPU, 1);
    const Plan few(one, with(scene_of(density, Json::array({all[0]})), "tier", "maps").dump(), 640, 400, options),
        many(one, with(scene_of(density, all), "tier", "maps").dump(), 640, 400, options);
    auto least = [&](const Plan &plan) {
        plan.execute(frame.color, frame.depth, options);
        std::clock_t least = std::numeric_limits<std::clock_t>::max();
        for (int i = 0; i < 3; ++i) {
            const std::clock_t start = std::clock();
            plan.execute(frame.color, frame.depth, options);
            least = std::min(least, std::clock() - start);
        }
        return double(least);
    };
    const double alone = least(few), together = least(many);
    printf("eight lamps: %.2f times one\n", together / alone);
    EXPECT_LT(together, 2.5 * alone);
}

// Light adds up, over rounds of four and beyond the maps that are kept.
TEST(AirlightMaps, ManyLightsAreTheSumOfEach)
{
    const Errors e = against_each(cloud(100, 9), lamps(9), lit_frame(48, 32));
    EXPECT_LT(e.worst, 1e-5) << e.x << ", " << e.y;
}

TEST(AirlightMaps, AnyNumberOfThreadsBitForBit)
{
    const Frame frame = lit_frame(50, 34);
    const Json scene = with(scene_of(cloud(120, 10, 0.3), lamps(5)), "tier", "maps");
    Context one(BRUME_BACKEND_CPU, 1), three(BRUME_BACKEND_CPU, 3);
    EXPECT_EQ(airlight_of(one, scene, frame).data, airlight_of(three, scene, frame).data);
}

// Maps are kept while the camera alone moves, but not those of what comes into view.
TEST(AirlightMaps, FollowTheCamera)
{
    const Frame frame = lit_frame(48, 32);
    struct Turn {
        Json scene;
        double yaw;
    };
    for (const Turn &turn : {Turn{scene_of(cloud(150, 11), lamps(3)), 0.1}, Turn{on_both_sides(), 2.9}}) {
        const Json scene = with(turn.scene, "tier", "maps");
        const brume_camera moved = camera(pose({0.4, 0.2, -0.3}, turn.yaw, -0.05), 50);
        Options options{{}, {"airlight"}};
        const Plan plan(cpu(), scene.dump(), frame.color.width, frame.color.height, options);
        plan.execute(frame.color, frame.depth, options);
        options.camera = &moved;
        const Picture kept = plan.execute(frame.color, frame.depth, options).airlight;
        const Plan fresh(cpu(), scene.dump(), frame.color.width, frame.color.height, options);
        const Picture anew = fresh.execute(frame.color, frame.depth, options).airlight;
        EXPECT_GT(*std::max_element(anew.data.begin(), anew.data.end()), 0.01f);
        const Errors e = errors(kept, anew);
        EXPECT_LT(e.worst, 1e-4) << e.x << ", " << e.y;
    }
}

TEST(AirlightMaps, LessMemoryIsACoarserGrid)
{
    const Frame frame = lit_frame(256, 160);
    const Json scene = with(scene_of(cloud(300, 1), lamps(1)), "tier", "maps");
    auto bytes = [&](double megabytes) {
        const Plan plan(cpu(), with(scene, "memory", megabytes).dump(), frame.color.width, frame.color.height);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        EXPECT_EQ(brume_plan_get_info(plan, &info), BRUME_OK);
        return info.image_bytes;
    };
    const auto much = bytes(256), little = bytes(8);
    EXPECT_LT(little, much);
    const Picture exact = airlight_of(cpu(), with(with(scene, "tier", "nodes"), "max_error", 0.001), frame);
    const Errors coarse = errors(airlight_of(cpu(), with(scene, "memory", 8), frame), exact);
    report("8 MB", coarse);
    EXPECT_LT(coarse.median, 0.01);
    EXPECT_LT(coarse.p95, 0.1);
}

// Where one Gaussian would do, nothing changes; where there are many, maps are taken and the plan says so.
TEST(AirlightMaps, AreTakenWhereTheyPay)
{
    auto mapped = [](const Json &scene) {
        const Plan plan(cpu(), scene.dump(), 320, 180);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan, &info);
        for (uint32_t e = 0; e < info.entry_count; ++e) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, e, &entry);
            if (std::string(entry.name) == "maps")
                return true;
        }
        return false;
    };
    EXPECT_FALSE(mapped(scene_of(Json::array({constant(0.1)}), lamps(1))));
    EXPECT_TRUE(mapped(scene_of(cloud(300, 1), lamps(3))));
    EXPECT_FALSE(mapped(with(scene_of(cloud(300, 1), lamps(3)), "tier", "nodes")));
    // Cells somewhat wider than the Gaussians want them still pay; much wider ones do not serve.
    EXPECT_TRUE(mapped(with(scene_of(cloud(150, 1), lamps(3)), "memory", 20)));
    EXPECT_FALSE(mapped(with(scene_of(cloud(1500, 1), lamps(3)), "memory", 8)));
    EXPECT_TRUE(mapped(with(scene_of(cloud(3, 1), lamps(1)), "tier", "maps")));
    // A dozen will do where many lamps shine, and where cameras come with the frames nobody knows how many there are.
    EXPECT_TRUE(mapped(scene_of(cloud(12, 1), lamps(9))));
    Json unplaced = scene_of(cloud(300, 1), lamps(3));
    unplaced.erase("camera");
    EXPECT_TRUE(mapped(unplaced));
}

}  // namespace
