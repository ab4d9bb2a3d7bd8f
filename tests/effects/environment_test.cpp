// A scene's environment: the light of all around, which fog turns toward the camera once.
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "../bench/slab_tracer.h"
#include "lit_scene.h"

using namespace fog;

namespace {

namespace f64 = brume::maths_double;

// Of this radiance everywhere.
Json even(double radiance)
{
    return Json::array({Json::array({radiance * 3.5449077, radiance * 3.5449077, radiance * 3.5449077})});
}

Json surrounded(const Json &environment, const Json &medium, const Json &effects)
{
    Json scene{{"brume", 1}, {"medium", medium}, {"effects", effects}};
    scene["camera"] = {{"vertical_fov", 60}, {"camera_to_world", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
    scene["environment"]["sh"] = environment;
    return scene;
}

const Json media[] = {{{"scattering", 0.02}},
                      {{"scattering", {0.1, 0.05, 0.02}}, {"g", 0.8}},
                      {{"scattering", 0.3}, {"g", -0.4}},
                      {{"scattering", 0.05}, {"g", 0.5}, {"density", {{{"type", "exponential"}, {"falloff", 0.2}}}}}};

class EnvironmentOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
    Picture fogged(const Json &scene, const Picture &color, const Picture &depth)
    {
        return run(context(), scene.dump(), color, depth).output;
    }
};

// Of light that leaves a ball of fog about the eye on its way back to where it came from, scattered at least once: the mean
// of the degrees' Legendre polynomials of the angle that it was turned by.
std::array<double, 4> turned_by_ball(double depth, double g, int paths)
{
    using namespace lamp_tracer;
    Random random(7);
    std::array<double, 4> sum{};
    for (int i = 0; i < paths; ++i) {
        f64::vec3 at(0), d(0, 0, 1);
        bool scattered = false;
        for (;;) {
            const double flight = -std::log(random()), b = glm::dot(at, d),
                         out = -b + std::sqrt(std::max(b * b - glm::dot(at, at) + depth * depth, 0.0));
            if (flight >= out)
                break;
            at += flight * d;
            d = turned(d, sampled_cosine(g, random), 2 * pi * random());
            scattered = true;
        }
        for (unsigned l = 0; l < 4 && scattered; ++l)
            sum[l] += std::legendre(l, d.z);
    }
    for (unsigned l = 1; l < 4; ++l)
        sum[l] /= sum[0];
    return sum;
}

}  // namespace

// What surrounds a picture of one radiance with the same loses and wins nothing, whoever adds it.
TEST_P(EnvironmentOn, WhiteFurnace)
{
    Picture depth(48, 32, 1, 20);
    for (int i = 0; i < 48 * 32; ++i)
        depth.data[size_t(i)] = 0.5f * float(1 + i % 97);
    const Picture white(48, 32, 4, 2);
    const Json half{{"resolution", "half"}}, all{{"orders", "all"}}, none = Json::object();
    for (const Json &medium : media)
        for (const Json &effects : {Json{{"multiscatter", none}}, Json{{"multiscatter", half}, {"airlight", none}},
                                    Json{{"multiscatter", none}, {"airlight", all}}, Json{{"airlight", all}}}) {
            const Worst worst = compare(fogged(surrounded(even(2), medium, effects), white, depth), white, 0);
            EXPECT_LT(worst.error, 1e-4) << medium << effects << worst.describe();
        }
}

// The picture is black, so that all that it shows is the environment's.
TEST_P(EnvironmentOn, ShinesFromWhereItIs)
{
    const Picture black(48, 32, 4, 0), depth(48, 32, 1, 20);
    const Json medium{{"scattering", 0.05}, {"g", 0.6}};
    // Degree 1: y, z, x of the world.
    const Json above = Json::parse("[[1, 1, 1], [0.8, 0.8, 0.8], [0, 0, 0], [0, 0, 0]]"),
               right = Json::parse("[[1, 1, 1], [0, 0, 0], [0, 0, 0], [0.8, 0.8, 0.8]]");
    for (const Json &effects : {Json{{"multiscatter", Json::object()}}, Json{{"airlight", {{"orders", "all"}}}}}) {
        const Picture high = fogged(surrounded(above, medium, effects), black, depth),
                      wide = fogged(surrounded(right, medium, effects), black, depth);
        EXPECT_GT(high.at(24, 4)[1], 1.2 * high.at(24, 27)[1]) << effects;
        EXPECT_GT(wide.at(43, 16)[1], 1.2 * wide.at(4, 16)[1]) << effects;
        // To both sides of its own axis alike.
        EXPECT_NEAR(high.at(4, 4)[1], high.at(43, 4)[1], 1e-3 * high.at(4, 4)[1]) << effects;
    }
}

// Only what the picture does not show comes from it: between nothing and what there is around.
TEST_P(EnvironmentOn, IsWhatThePictureDoesNotShow)
{
    const Picture grey(48, 32, 4, 1), depth(48, 32, 1, 30);
    const Json effects{{"multiscatter", Json::object()}}, medium{{"scattering", 0.05}, {"g", 0.3}};
    const double dark = fogged(surrounded(even(0), medium, effects), grey, depth).at(24, 16)[1],
                 same = fogged(surrounded(even(1), medium, effects), grey, depth).at(24, 16)[1],
                 bright = fogged(surrounded(even(3), medium, effects), grey, depth).at(24, 16)[1];
    EXPECT_NEAR(same, 1, 1e-5);
    EXPECT_LT(dark, 0.9);
    EXPECT_NEAR(bright - same, 2 * (same - dark), 1e-4);
}

TEST_P(EnvironmentOn, NeedsThePose)
{
    Json scene = surrounded(even(1), media[0], {{"multiscatter", Json::object()}});
    scene["camera"].erase("camera_to_world");
    const Picture white(8, 8, 4, 1), depth(8, 8, 1, 5);
    try {
        fogged(scene, white, depth);
        FAIL();
    } catch (const Failure &failure) {
        EXPECT_NE(std::string(failure.what()).find("the environment is placed in the world"), std::string::npos)
            << failure.what();
    }
}

INSTANTIATE_TEST_SUITE_P(All, EnvironmentOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

// The ball is where the degrees stay apart: whatever it does to one direction it does to all.
TEST(AirlightEnvironment, BallsOfFog)
{
    for (double g : {-0.4, 0.0, 0.5, 0.85})
        for (double x : {0.1, 0.5, 1.0, 2.0, 6.0}) {
            const auto traced = turned_by_ball(x / (1 - g), g, 20000);
            for (int l = 1; l < 4; ++l)
                EXPECT_NEAR(f64::environment_kept(g, x / (1 - g), l), traced[size_t(l)], g < 0 ? 0.08 : 0.05)
                    << "g " << g << ", (1 - g) tau " << x << ", degree " << l;
        }
}

// Before a dark environment what is scattered is the picture's own: the share that it covers of all that is scattered, by
// the reference's angles between pixels and by the kernel's levels, which know its edges less well.
TEST(CalibratedReference, CoversAsMuchOfWhatIsAround)
{
    const Picture white(64, 48, 4, 1), depth(64, 48, 1, 25);
    for (double g : {0.0, 0.6, 0.85}) {
        auto covered = [&](const char *kernel) {
            const Json medium{{"scattering", 0.04 / (1 - g)}, {"g", g}};
            Picture p = run(cpu(), surrounded(even(0), medium, {{"multiscatter", {{"kernel", kernel}}}}).dump(), white,
                            depth, {{}, {"scattered"}, 0})
                            .scattered;
            double mean = 0;
            for (float &v : p.data) {
                v /= float(-std::expm1(-1 / (1 - g)));
                mean += v / double(p.data.size());
            }
            return std::pair(p, mean);
        };
        const auto [got, mean] = covered("calibrated");
        const auto [exact, exact_mean] = covered("reference");
        EXPECT_NEAR(mean, exact_mean, 0.05) << g;
        for (size_t i = 0; i < got.data.size(); ++i)
            ASSERT_NEAR(got.data[i], exact.data[i], 0.2) << g << " at " << i;
    }
}

#ifdef BRUME_GL
TEST(EnvironmentGpuAgainstCpu, SurroundsThePictureAlike)
{
    const Picture depth(40, 30, 1, 25);
    Picture color(40, 30, 4, 0.2f);
    color.at(9, 7)[0] = color.at(20, 12)[1] = 40;
    const Json sky = Json::parse("[[2, 1, 1], [0.5, 0.2, 0.8], [0, 0.3, 0], [0.3, 0, 0.3]]");
    for (const Json &medium : media)
        for (const Json &effects : {Json{{"multiscatter", Json::object()}}, Json{{"airlight", {{"orders", "all"}}}}}) {
            const std::string text = surrounded(sky, medium, effects).dump();
            const Worst worst =
                compare(run(backend("gl"), text, color, depth).output, run(cpu(), text, color, depth).output, 0.05);
            EXPECT_LT(worst.error, 2e-3) << text << worst.describe();
        }
}
#endif
