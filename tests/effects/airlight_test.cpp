// The effect airlight through the C ABI, on each backend: what its outputs are to each other and to those of multiscatter.
#include <gtest/gtest.h>

#include "lit_scene.h"

using namespace fog;

namespace {

// All the effect has: software GL compiles a program anew, for seconds, for each set of images that are bound to it.
const Names shown = {"transmittance", "optical_depth", "airlight", "airlight_error"};

class AirlightOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
    // On the CPU each effect rounds exponentials its own way; on GL all are the same.
    double rounding() const { return std::string(GetParam()) == "cpu" ? 1e-6 : 0; }
    // On GL the one with Gaussians; AirlightGpuAgainstCpu has the others.
    std::vector<NamedScene> scenes() const
    {
        const std::vector<NamedScene> all = lit_scenes();
        return std::string(GetParam()) == "cpu" ? all : std::vector<NamedScene>{all[1]};
    }

    Result fogged(const Json &scene, const Frame &frame, const Names &outputs = shown, uint32_t lights = 0)
    {
        return run(context(), scene.dump(), frame.color, frame.depth, Options{{}, outputs, 0, lights});
    }
};

INSTANTIATE_TEST_SUITE_P(All, AirlightOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

Json in_tier(Json scene, const std::string &tier)
{
    scene["effects"]["airlight"]["tier"] = tier;
    return scene;
}

double sum(const Picture &p)
{
    double total = 0;
    for (float v : p.data)
        total += v;
    return total;
}

double largest(const Picture &p)
{
    return *std::max_element(p.data.begin(), p.data.end());
}

}  // namespace

TEST_P(AirlightOn, AloneIsTheAttenuatedImagePlusAirlight)
{
    const Frame frame = lit_frame(24, 18);
    for (const auto &[name, scene, tiers] : scenes())
        for (const char *tier : tiers) {
            const Result r = fogged(in_tier(scene, tier), frame);
            Picture expected = r.output, beer = r.transmittance;
            for (int y = 0; y < 18; ++y)
                for (int x = 0; x < 24; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const float t = r.transmittance.at(x, y)[c];
                        ASSERT_TRUE(t >= 0 && t <= 1 && r.airlight.at(x, y)[c] >= 0) << name << " " << tier;
                        expected.at(x, y)[c] = frame.color.at(x, y)[c] * t + r.airlight.at(x, y)[c];
                        beer.at(x, y)[c] = std::exp(-r.optical_depth.at(x, y)[c]);
                    }
            const Worst eq29 = compare(r.output, expected, 1e-3), law = compare(r.transmittance, beer, 1e-2);
            EXPECT_LT(eq29.error, 1e-6) << name << " " << tier << " " << eq29.describe();
            EXPECT_LT(law.error, 2e-5) << name << " " << tier << " " << law.describe();
            EXPECT_GT(largest(r.airlight), 1e-3) << name << " " << tier;
            EXPECT_LT(largest(r.transmittance), 1.0) << name << " " << tier;
        }
}

TEST_P(AirlightOn, LightsAddUp)
{
    const Frame frame = lit_frame(24, 18);
    for (const auto &[name, scene, tiers] : scenes())
        for (const char *tier : tiers) {
            const Result r = fogged(in_tier(scene, tier), frame, shown, uint32_t(scene["lights"].size()));
            Picture total(24, 18, 3);
            for (const Picture &light : r.light_airlight) {
                EXPECT_GT(largest(light), 1e-4) << name << " " << tier;
                for (size_t i = 0; i < total.data.size(); ++i)
                    total.data[i] += light.data[i];
            }
            // The environment's part has no output of its own.
            Picture expected = r.airlight;
            if (scene.contains("environment")) {
                Json lamps = scene;
                lamps.erase("environment");
                expected = fogged(in_tier(lamps, tier), frame).airlight;
                EXPECT_GT(sum(r.airlight), 1.01 * sum(expected)) << name << " " << tier;
            }
            // Nodes are chosen for the error asked of the whole (max_error, .01), so that a light alone may get others.
            const Worst worst = compare(total, expected, 1e-3);
            EXPECT_LT(worst.error, std::string(tier) == "nodes" ? 1e-2 : 1e-5)
                << name << " " << tier << " " << worst.describe();
        }
}

TEST_P(AirlightOn, LightsAreLinear)
{
    // Powers of two: nothing rounds differently.
    const Frame frame = lit_frame(20, 15);
    for (const auto &[name, scene, tiers] : scenes())
        for (const char *tier : tiers) {
            if (scene.contains("environment"))
                continue;
            Json brighter = scene;
            for (Json &light : brighter["lights"]) {
                Json &intensity = light["intensity"];
                if (!intensity.is_array())
                    intensity = std::vector<double>(3, intensity);
                for (Json &v : intensity)
                    v = 4 * v.get<double>();
            }
            Result one = fogged(in_tier(scene, tier), frame), four = fogged(in_tier(brighter, tier), frame);
            for (float &v : one.airlight.data)
                v *= 4;
            EXPECT_EQ(one.airlight.data, four.airlight.data) << name << " " << tier;
            EXPECT_EQ(one.transmittance.data, four.transmittance.data) << name << " " << tier;
        }
}

TEST_P(AirlightOn, TransmittanceIsThatOfMultiscatter)
{
    const Frame frame = lit_frame(24, 18);
    for (const auto &[name, scene, tiers] : scenes()) {
        Json other = scene;
        other["effects"] = {{"multiscatter", Json::object()}};
        const Result a = fogged(scene, frame), b = fogged(other, frame, {"transmittance", "optical_depth"});
        const Worst transmittance = compare(a.transmittance, b.transmittance, 1e-3),
                    optical_depth = compare(a.optical_depth, b.optical_depth, 1e-3);
        EXPECT_LE(transmittance.error, rounding()) << name << " " << transmittance.describe();
        EXPECT_LE(optical_depth.error, rounding()) << name << " " << optical_depth.describe();
    }
}

TEST_P(AirlightOn, AfterMultiscatterItOnlyAdds)
{
    const Frame frame = lit_frame(24, 18);
    for (const auto &[name, scene, tiers] : scenes()) {
        Json both = scene, alone = scene;
        for (Json *s : {&both, &alone})
            for (Json &light : (*s)["lights"])
                light.erase("radius");  // seen by nobody
        both["effects"]["multiscatter"] = Json::object();
        alone["effects"] = {{"multiscatter", Json::object()}};
        const Result added = fogged(both, frame), plain = fogged(alone, frame, {"transmittance"});
        Picture expected = plain.output;
        for (int y = 0; y < 18; ++y)
            for (int x = 0; x < 24; ++x)
                for (int c = 0; c < 3; ++c)
                    expected.at(x, y)[c] += added.airlight.at(x, y)[c];
        const Worst worst = compare(added.output, expected, 1e-3);
        EXPECT_LT(worst.error, 1e-6) << name << " " << worst.describe();
        const Worst transmittance = compare(added.transmittance, plain.transmittance, 1e-3);
        EXPECT_LE(transmittance.error, rounding()) << name << " " << transmittance.describe();
    }
}

// A visible lamp's light that is scattered once is airlight, and what multiscatter then spreads of its pixels is the rest.
// In a forward-scattering medium of depth tau both together are 1 - e^-tau of it, as multiscatter says alone; the airlight
// is tau e^-tau of it. Counted twice they would be more by as much.
TEST_P(AirlightOn, AVisibleLampIsCountedOnce)
{
    const int size = 128;
    const double distance = 40, radius = 0.6, radiance = 1000;
    // The airlight's endless medium scatters more to the camera than kernel calibrated lets arrive.
    const struct {
        double tau;
        const char *kernel;
        double bound;
    } cases[] = {{0.3, "paper", 0.1},      {1.0, "paper", 0.1},      {2.0, "paper", 0.1},
                 {0.3, "calibrated", 0.2}, {1.0, "calibrated", 0.2}, {2.0, "calibrated", 0.2}};
    for (auto &[tau, kernel, bound] : cases) {
        Frame frame{Picture(size, size, 4), Picture(size, size, 1, INFINITY)};
        Json scene =
            lit_scene({{"scattering", tau / distance}, {"g", 0.9}},
                      Json::array({point_light({0, 0, -distance}, radiance * 3.14159265 * radius * radius, radius)}));
        scene["camera"]["vertical_fov"] = 80;
        scene["effects"]["multiscatter"] = {{"kernel", kernel}, {"masking", false}};
        scene["effects"]["airlight"]["orders"] = "single";
        const Exhaustive exact(scene, size, size);
        double lamp = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const auto ray = exact.ray(x, y, 1);
                frame.depth.at(x, y)[0] = float(distance + 20);
                if (std::hypot(ray.direction.x, ray.direction.y) * distance > radius)
                    continue;
                frame.depth.at(x, y)[0] = float(distance);
                std::fill_n(frame.color.at(x, y), 3, float(radiance));
                lamp += radiance;
            }
        const double lit = lamp * (1 - std::exp(-tau));
        Json alone = scene;
        alone["effects"].erase("airlight");
        const Result both = fogged(scene, frame, joined(shown, {"scattered"})), one = fogged(alone, frame, {"scattered"});
        double airlight = sum(both.airlight) / 3, rest = sum(both.scattered) / 3, all = sum(one.scattered) / 3;
        printf(
            "tau %.1f: of what is scattered (%.0f) multiscatter alone brings %.3f; beside the airlight's %.3f (tau e^-tau: "
            "%.3f) it brings %.3f\n",
            tau, lit, all / lit, airlight / lit, tau * std::exp(-tau) * lamp / lit, rest / lit);
        EXPECT_NEAR(rest / all, 1 - tau * std::exp(-tau) / (1 - std::exp(-tau)), 0.02) << tau;
        EXPECT_NEAR((airlight + rest) / all, 1, bound) << tau << " " << kernel;
    }
}

TEST_P(AirlightOn, MoreMediumNeverBrightensWhatIsBehind)
{
    const Frame frame = lit_frame(20, 15);
    for (const auto &[name, scene, tiers] : scenes()) {
        Json thin = scene, absorbing = scene;
        for (Json &light : thin["lights"])
            light["intensity"] = 0;
        thin.erase("environment");
        Result before = fogged(thin, frame);
        for (int i = 0; i < 4; ++i) {
            thin["medium"]["density"] = thin["medium"].value("density", Json::array({constant(1)}));
            thin["medium"]["density"].push_back(i % 2 ? constant(0.3) : gaussian({0.5 * i, 0, -4.0 - i}, 0.4, 3));
            const Result after = fogged(thin, frame);
            for (size_t k = 0; k < after.output.data.size(); ++k)
                ASSERT_LE(after.output.data[k], before.output.data[k] * (1 + 2e-6f)) << name << " step " << i;
            EXPECT_LT(sum(after.output), sum(before.output)) << name << " step " << i;
            before = after;
        }
        // And absorption darkens all there is.
        absorbing["medium"]["absorption"] = {0.05, 0.06, 0.07};
        const Result lit = fogged(scene, frame), dimmed = fogged(absorbing, frame);
        for (size_t k = 0; k < lit.output.data.size(); ++k)
            ASSERT_LE(dimmed.output.data[k], lit.output.data[k] * (1 + 1e-5f)) << name;
        EXPECT_LT(sum(dimmed.airlight), sum(lit.airlight)) << name;
    }
}

TEST_P(AirlightOn, SameBitsInPlaceAndAgain)
{
    Frame frame = lit_frame(21, 13);
    for (const auto &[name, scene, tiers] : scenes()) {
        const Plan plan(context(), scene.dump(), 21, 13);
        const Picture expected = plan.execute(frame.color, frame.depth).output;
        EXPECT_EQ(plan.execute(frame.color, frame.depth).output.data, expected.data) << name;
        EXPECT_EQ(fogged(scene, frame).output.data, expected.data) << name;
        Picture both = frame.color;
        brume_image image = describe(both), depth = describe(frame.depth);
        brume_frame in_place = BRUME_FRAME_INIT;
        in_place.color = in_place.output = &image;
        in_place.depth = &depth;
        Context::check(brume_plan_execute(plan, &in_place), context());
        EXPECT_EQ(both.data, expected.data) << name;
    }
}

TEST_P(AirlightOn, BottomLeftOriginIsTheFlippedPicture)
{
    const Frame frame = lit_frame(21, 13);
    for (const auto &[name, scene, tiers] : scenes()) {
        const Options upside_down{{}, shown, 0, 0, nullptr, BRUME_ORIGIN_BOTTOM_LEFT};
        const Result expected = fogged(scene, frame),
                     got = run(context(), scene.dump(), flipped(frame.color), flipped(frame.depth), upside_down);
        const Worst worst = compare(flipped(got.airlight), expected.airlight, 1e-3),
                    tau = compare(flipped(got.transmittance), expected.transmittance, 1e-2);
        EXPECT_LT(worst.error, 2e-4) << name << " " << worst.describe();
        EXPECT_LT(tau.error, 2e-4) << name << " " << tau.describe();
    }
}

TEST(AirlightPlan, DropsGaussiansWithoutAmplitude)
{
    for (double amplitude : {0.0, 1.0}) {
        const Json medium{{"scattering", 1}, {"density", {gaussian({0, 0, -5}, 1, amplitude)}}};
        const Plan plan(cpu(), lit_scene(medium, Json::array({point_light({1, 0, -5}, 1)})).dump(), 8, 8);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan, &info);
        bool runs = false;
        for (uint32_t i = 0; i < info.entry_count; ++i) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, i, &entry);
            runs = runs || entry.runs;
        }
        EXPECT_EQ(runs, amplitude > 0);
    }
}

// What comes from infinitely far through endless fog does not arrive.
TEST_P(AirlightOn, EndlessFogHidesTheEnvironmentFromASkyAtInfinity)
{
    Json scene = lit_scene({{"scattering", 0.01}}, Json::array());
    scene["environment"]["sh"] = {{1, 1, 1}};
    const Picture color(2, 1, 4, 1);
    Picture depth(2, 1, 1, INFINITY);
    depth.at(1, 0)[0] = 100;
    const Result r = run(backend(GetParam()), scene.dump(), color, depth);
    EXPECT_EQ(r.output.at(0, 0)[0], 0);
    EXPECT_GT(r.output.at(1, 0)[0], 0.3f);
}

TEST(AirlightThreads, AnyNumberGivesTheSameBits)
{
    const Frame frame = lit_frame(61, 47);
    const Context one(BRUME_BACKEND_CPU, 1), many(BRUME_BACKEND_CPU, 5);
    for (const auto &[name, scene, tiers] : lit_scenes()) {
        const Options options{{}, shown};
        const Result a = run(one, scene.dump(), frame.color, frame.depth, options),
                     b = run(many, scene.dump(), frame.color, frame.depth, options);
        EXPECT_EQ(a.output.data, b.output.data) << name;
        EXPECT_EQ(a.optical_depth.data, b.optical_depth.data) << name;
        EXPECT_EQ(a.airlight_error.data, b.airlight_error.data) << name;
    }
}

// By the same functions, not only by the same formulas.
TEST(AirlightDefaultTier, IsNodesBitForBitWhereItComesToThem)
{
    const NamedScene scene = lit_scenes()[0];
    const Frame frame = lit_frame(48, 32);
    auto airlight = [&](const Json &of) {
        return run(cpu(), of.dump(), frame.color, frame.depth, Options{{}, {"airlight"}}).airlight.data;
    };
    EXPECT_EQ(airlight(scene.scene), airlight(in_tier(scene.scene, "nodes")));
}

#ifdef BRUME_GL
TEST(AirlightGpuAgainstCpu, EveryTier)
{
    // Floor: a thousandth of the brightest.
    const Frame frame = lit_frame(33, 25);
    auto hold = [&](const std::string &name, const Json &scene, double bound = 1e-3) {
        const Options options{{}, shown};
        const Result a = run(backend("gl"), scene.dump(), frame.color, frame.depth, options),
                     b = run(cpu(), scene.dump(), frame.color, frame.depth, options);
        const Worst airlight = compare(a.airlight, b.airlight, 1e-3 * largest(b.airlight)),
                    t = compare(a.transmittance, b.transmittance, 1e-2);
        printf("%s: worst %.2g airlight, %.2g transmittance\n", name.c_str(), airlight.error, t.error);
        EXPECT_LT(airlight.error, bound) << name << " " << airlight.describe();
        EXPECT_LT(t.error, 2e-5) << name << " " << t.describe();
    };
    // Each plan compiles for seconds on software GL, so not every scene is held in every tier.
    const auto scenes = lit_scenes();
    for (size_t i : {size_t(0), size_t(1)})
        hold(scenes[i].name, scenes[i].scene);
    hold("homogeneous, sun", in_tier(scenes[0].scene, "sun"));
    hold("gaussians, fogshop", in_tier(scenes[1].scene, "fogshop"));
    // So many that they are integrated as one, where rounding decides how finely: both stay within the error asked, .01.
    Json dense = scenes[1].scene;
    dense["medium"]["density"] = random_gaussians(400, 4, 16, 4, 0.6);
    hold("many gaussians", dense, 5e-3);
}
#endif
