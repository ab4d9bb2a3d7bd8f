// The effect airlight at every extreme: finite, within range, alike on both backends.
#include <gtest/gtest.h>

#include "lit_scene.h"

using namespace fog;

namespace {

struct Case {
    std::string name;
    Json scene;
    float depth = 10;  // along the ray
    float radiance = 1;
    bool isotropic = true;  // of what every tier knows
};

// A light above the way to a surface, in a thin constant medium with one Gaussian in it.
Json ordinary()
{
    return lit_scene(
        {{"scattering", 0.05}, {"absorption", 0.01}, {"density", {constant(1), gaussian({0.5, 0.2, -4}, 0.8, 2)}}},
        Json::array({point_light({0.3, 1, -5}, 10, 0.05)}));
}

Json with(const char *pointer, const Json &value)
{
    Json scene = ordinary();
    scene[Json::json_pointer(pointer)] = value;
    return scene;
}

Json with_light(const Json &light)
{
    return with("/lights/0", light);
}

Json with_blob(const Json &blob)
{
    return with("/medium/density/1", blob);
}

void add_media(std::vector<Case> &all)
{
    for (float d : {0.0f, 1e-45f, 1e-6f, 1.0f, 1e30f, INFINITY, NAN, -3.0f})
        all.push_back({"distance " + std::to_string(d), ordinary(), d});
    for (double sigma : {0.0, 1e-12, 1e-4, 1.0, 50.0, 1e4})
        for (float d : {1e-6f, 10.0f, INFINITY}) {
            Case c{"sigma " + std::to_string(sigma) + " to " + std::to_string(d),
                   with("/medium/scattering", {sigma, 0, sigma}), d};
            c.scene["medium"]["absorption"] = {0, sigma, 0};
            all.push_back(c);
        }
    for (double g : {-1.0, -0.999, 0.0, 0.999, 1.0})
        for (double z : {-5.0, 5.0}) {
            Case c{"g " + std::to_string(g), with("/medium/g", g), 10, 1, g == 0};
            c.scene["lights"][0]["position"] = {0, 0, z};
            all.push_back(c);
        }
    for (double diameter : {5.0, 50.0})
        all.push_back({"droplets of " + std::to_string(diameter), with("/medium/droplet_diameter", diameter), 10, 1, false});
    for (float l : {0.0f, 65504.0f, 1e10f, 3e38f, NAN, INFINITY, -INFINITY, -5.0f})
        all.push_back({"radiance " + std::to_string(l), ordinary(), 10, l});
    for (double falloff : {0.0, 1e-9, 0.3, 1000.0})
        for (double y : {1.0, -1.0})
            all.push_back(
                {"exponential of falloff " + std::to_string(falloff),
                 with("/medium/density/0", {{"type", "exponential"}, {"falloff", falloff}, {"direction", {0, y, 1e-9}}}),
                 INFINITY, 1, false});
}

void add_gaussians(std::vector<Case> &all)
{
    for (double scale : {1e-30, 1e-6, 0.5, 1e6, 1e30})
        for (double amplitude : {0.0, 1e-12, 1.0, 1e6, 1e30})
            for (double z : {0.0, -4.0})
                all.push_back({"Gaussian of scale " + std::to_string(scale) + ", amplitude " + std::to_string(amplitude) +
                                   " at z " + std::to_string(z),
                               with_blob(gaussian({0, 0, z}, scale, amplitude)), z == 0 ? INFINITY : 4.0f});
    for (double far : {1e6, -1e6, 1e30})
        all.push_back({"Gaussian at z " + std::to_string(far), with_blob(gaussian({0, 0, far}, 1, 1)), INFINITY});
    Json none = ordinary();
    none["medium"]["density"] = {constant(1)};
    all.push_back({"no Gaussian", none});
    none["medium"]["density"] = {gaussian({0, 0, -4}, 1, 1)};
    all.push_back({"nothing but a Gaussian", none});
}

void add_lights(std::vector<Case> &all)
{
    // The rays of the one pixel's row pass close to the optical axis; the angle at the camera is as named.
    const std::pair<const char *, Vector> places[] = {{"at the camera", {0, 0, 0}},
                                                      {"within a denormal of the camera", {0, 0, -1e-42}},
                                                      {"gamma 0", {0, 0, -5}},
                                                      {"gamma 1e-7", {5e-7, 0, -5}},
                                                      {"gamma pi", {0, 0, 5}},
                                                      {"on the surface", {0, 0, -10}},
                                                      {"behind the surface", {0, 0, -11}},
                                                      {"inside the Gaussian", {0.5, 0.2, -4}},
                                                      {"1e6 m ahead", {0, 0, -1e6}},
                                                      {"1e6 m aside", {1e6, 0, 0}},
                                                      {"1e30 m away", {0, 1e30, 0}}};
    for (auto &[name, position] : places)
        for (double radius : {0.0, 0.1, 1e6}) {
            const std::string text = std::string(name) + ", radius " + std::to_string(radius);
            all.push_back({"light " + text, with_light(point_light(position, 10, radius))});
            all.push_back({"light " + text + ", sky", with_light(point_light(position, 10, radius)), INFINITY});
            for (double angle : {0.0, 1e-3, 90.0, 180.0})
                for (double penumbra : {0.0, 1.0}) {
                    Json spot = point_light(position, 10, radius);
                    spot["type"] = "spot";
                    spot["angle"] = angle;
                    spot["penumbra"] = penumbra;
                    for (double z : {-1.0, 0.0, 1.0}) {
                        spot["direction"] = {z == 0 ? 1 : 0, 0, z};
                        all.push_back({"spot " + text + ", angle " + std::to_string(angle), with_light(spot), 10, 1, false});
                    }
                }
        }
    for (double intensity : {0.0, 1e-30, 1e30})
        all.push_back({"intensity " + std::to_string(intensity), with_light(point_light({0, 0, -5}, intensity))});
    for (double distance : {0.0, 10.0, 1e30})
        for (const Vector &direction : {Vector{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1e-7, 0, -1}, {0, 1e-30, 0}})
            all.push_back(
                {"directional, distance " + std::to_string(distance),
                 with_light({{"type", "directional"}, {"direction", direction}, {"intensity", 3}, {"distance", distance}}),
                 INFINITY, 1, false});
}

// Halves as they are stored; none may be infinite or NaN.
bool all_finite(const std::vector<uint16_t> &halves)
{
    return std::all_of(halves.begin(), halves.end(), [](uint16_t h) { return (h & 0x7c00) != 0x7c00; });
}

class AirlightExtremes : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, AirlightExtremes, testing::Values("cpu", "gl"),
                         [](auto &info) { return std::string(info.param); });

}  // namespace

TEST_P(AirlightExtremes, MediaLightsAndGaussians)
{
    std::vector<Case> all;
    add_media(all);
    add_gaussians(all);
    add_lights(all);
    const bool on_gl = std::string(GetParam()) == "gl";
    const Options options{[](brume_format &f) {
                              f.depth_kind = BRUME_DEPTH_RAY;
                              f.nonpositive = BRUME_NONPOSITIVE_NEAR;
                          },
                          BRUME_OUTPUT_TRANSMITTANCE | BRUME_OUTPUT_OPTICAL_DEPTH | BRUME_OUTPUT_AIRLIGHT |
                              BRUME_OUTPUT_AIRLIGHT_ERROR};
    for (const Case &c : all)
        for (const char *tier : {"nodes", "fogshop"}) {
            if (std::string(tier) == "fogshop" && !c.isotropic)
                continue;
            // The extreme in the left half beside an ordinary right half; an odd width, so that one ray is the optical axis.
            Frame frame{Picture(5, 3, 4, 1), Picture(5, 3, 1, 8)};
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 3; ++x) {
                    frame.depth.at(x, y)[0] = c.depth;
                    std::fill_n(frame.color.at(x, y), 3, c.radiance);
                }
            Json scene = c.scene;
            scene["effects"]["airlight"]["tier"] = tier;
            const std::string where = c.name + ", " + tier;
            const Result r = run(context(), scene.dump(), frame.color, frame.depth, options);
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 5; ++x)
                    for (int k = 0; k < 3; ++k) {
                        const float in = frame.color.at(x, y)[k], out = r.output.at(x, y)[k];
                        if (std::isfinite(in))
                            ASSERT_TRUE(std::isfinite(out)) << where << ": " << out;
                        else
                            ASSERT_TRUE(std::isnan(in) ? std::isnan(out) : in == out) << where << ": not returned unchanged";
                        const float l = r.airlight.at(x, y)[k], e = r.airlight_error.at(x, y)[k],
                                    t = r.transmittance.at(x, y)[k], tau = r.optical_depth.at(x, y)[k];
                        ASSERT_TRUE(l >= 0 && std::isfinite(l)) << where << ": airlight " << l;
                        ASSERT_TRUE(e >= 0 && std::isfinite(e)) << where << ": error " << e;
                        ASSERT_TRUE(t >= 0 && t <= 1) << where << ": transmittance " << t;
                        ASSERT_TRUE(tau >= 0 && std::isfinite(tau)) << where << ": optical depth " << tau;
                    }
            if (!on_gl)
                continue;
            const Result expected = run(cpu(), scene.dump(), frame.color, frame.depth, options);
            double brightest = 1e-30;
            for (float v : expected.airlight.data)
                brightest = std::max(brightest, double(v));
            const Worst airlight = compare(r.airlight, expected.airlight, 0.01 * brightest),
                        t = compare(r.transmittance, expected.transmittance, 1e-2);
            // A phase function's peak of a thousandth of a radian is as bright as single precision happens to land on it; the
            // published formula scales a difference of two table values by e^(+T).
            const bool peaked = c.name.starts_with("g 0.999") || c.name.starts_with("g 1.0") || c.name.starts_with("g -1.0");
            if (!peaked && std::string(tier) != "fogshop")
                EXPECT_LT(airlight.error, 1e-2) << where << " " << airlight.describe();
            EXPECT_LT(t.error, 1e-4) << where << " " << t.describe();
        }
    printf("%zu extremes\n", all.size());
}

TEST_P(AirlightExtremes, CamerasFarFromTheOrigin)
{
    const Frame frame = lit_frame(20, 16);
    std::vector<NamedScene> scenes = lit_scenes();
    if (std::string(GetParam()) == "gl")
        scenes = {scenes[1]};
    const Options options{{}, BRUME_OUTPUT_AIRLIGHT_ERROR};
    for (const auto &[name, scene, tiers] : scenes) {
        Json far = scene;
        const Vector shift{1e6, -1e6, 1e6};
        auto move = [&](Json &point) {
            for (size_t i = 0; i < 3; ++i)
                point[i] = point[i].get<double>() + shift[i];
        };
        far["camera"]["camera_to_world"] = pose(shift);
        for (Json &light : far["lights"])
            if (light.contains("position"))
                move(light["position"]);
        if (far["medium"].contains("density"))
            for (Json &term : far["medium"]["density"])
                if (term["type"] == "gaussian")
                    move(term["center"]);
                else if (term["type"] == "exponential")
                    term["origin"] = shift;
        const Picture near_one = run(context(), scene.dump(), frame.color, frame.depth, options).output,
                      far_one = run(context(), far.dump(), frame.color, frame.depth, options).output;
        const Worst worst = compare(far_one, near_one, 1e-2);
        EXPECT_LT(worst.error, 1e-5) << name << " " << worst.describe();
    }
}

TEST_P(AirlightExtremes, Sizes)
{
    const Json scene = lit_scenes()[1].scene;
    for (auto [w, h] : {std::pair(1, 1), {3, 5}, {1, 4096}, {4096, 1}}) {
        const Frame frame = lit_frame(w, h);
        const Result r = run(context(), scene.dump(), frame.color, frame.depth,
                             Options{{}, BRUME_OUTPUT_AIRLIGHT | BRUME_OUTPUT_AIRLIGHT_ERROR});
        for (float v : r.output.data)
            ASSERT_TRUE(std::isfinite(v) && v >= 0) << w << "x" << h;
        for (float v : r.airlight.data)
            ASSERT_GT(v, 0) << w << "x" << h;
    }
}

TEST_P(AirlightExtremes, HalvesSaturate)
{
    Json scene = ordinary();
    scene["lights"][0]["intensity"] = 1e9;
    const Frame frame = lit_frame(16, 12);
    const Plan plan(context(), scene.dump(), 16, 12, Options{{}, BRUME_OUTPUT_AIRLIGHT | BRUME_OUTPUT_AIRLIGHT_ERROR});
    std::vector<uint16_t> out(16 * 12 * 4), airlight(16 * 12 * 4);
    brume_image c = describe(frame.color), d = describe(frame.depth), o = describe(frame.color), a = o;
    o.pixel = a.pixel = BRUME_PIXEL_F16;
    o.data = out.data();
    a.data = airlight.data();
    brume_extra_output extra = BRUME_EXTRA_OUTPUT_INIT;
    extra.output = BRUME_OUTPUT_AIRLIGHT;
    extra.image = &a;
    brume_frame f = BRUME_FRAME_INIT;
    f.color = &c;
    f.depth = &d;
    f.output = &o;
    f.extra = &extra;
    f.extra_count = 1;
    Context::check(brume_plan_execute(plan, &f), context());
    EXPECT_TRUE(all_finite(out));
    EXPECT_TRUE(all_finite(airlight));
    EXPECT_NE(std::count(out.begin(), out.end(), 0x7bff), 0) << "65504 is not reached";
}

// As many as the documentation promises, through the C ABI.
TEST_P(AirlightExtremes, ManyGaussians)
{
    const Frame frame = lit_frame(12, 8);
    for (uint32_t count : {0u, 1u, 1000u, 100000u}) {
        std::mt19937 random(count);
        std::uniform_real_distribution<double> u(-1, 1);
        std::vector<brume_gaussian> gaussians(count, brume_gaussian BRUME_GAUSSIAN_INIT);
        for (brume_gaussian &g : gaussians) {
            for (double &x : g.center)
                x = 30 * u(random);
            g.center[2] -= 20;
            g.scale = 0.05 * std::cbrt(double(count)) * std::exp(u(random));
            g.amplitude = 1;
        }
        const Plan plan(context(), ordinary().dump(), 12, 8,
                        Options{{}, BRUME_OUTPUT_AIRLIGHT | BRUME_OUTPUT_AIRLIGHT_ERROR}, [&](brume_scene scene) {
                            brume_density_term term = BRUME_DENSITY_TERM_INIT;
                            term.value = 0.1;
                            brume_medium medium = BRUME_MEDIUM_INIT;
                            std::fill_n(medium.scattering, 3, 0.05);
                            medium.terms = &term;
                            medium.term_count = 1;
                            medium.gaussians = gaussians.data();
                            medium.gaussian_count = count;
                            Context::check(brume_scene_set_medium(scene, &medium), context());
                        });
        const Result r =
            plan.execute(frame.color, frame.depth, Options{{}, BRUME_OUTPUT_AIRLIGHT | BRUME_OUTPUT_AIRLIGHT_ERROR});
        for (float v : r.airlight.data)
            ASSERT_TRUE(std::isfinite(v) && v > 0) << count;
        for (float v : r.output.data)
            ASSERT_TRUE(std::isfinite(v) && v >= 0) << count;
    }
}
