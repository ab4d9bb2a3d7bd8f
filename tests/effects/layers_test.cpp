// Another renderer's fog, given as a layer, in place of the scene's density.
#include <gtest/gtest.h>

#include "lit_scene.h"

using namespace fog;

namespace {

class LayersOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, LayersOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

Json filtered(const Json &density, const Json &parameters)
{
    Json scene = lit_scene({{"scattering", {0.03, 0.04, 0.06}},
                            {"absorption", {0.01, 0, 0.002}},
                            {"emission", {0.002, 0, 0.001}},
                            {"g", 0.7},
                            {"density", density}},
                           Json::array());
    scene["effects"] = {{"multiscatter", parameters}};
    return scene;
}

void clamp_sky(brume_format &format)
{
    format.sky = BRUME_SKY_CLAMP;
    format.sky_distance = 70;
}

}  // namespace

// The medium's own integrals, asked of a first plan, make the picture that its density makes, whatever the scene's density
// is.
TEST_P(LayersOn, TheScenesOwnFogIsTheScenesPicture)
{
    const Json constant_density = Json::array({constant(0.7)});
    Json varied = random_gaussians(12, 3, 12, 4, 3);
    varied.push_back({{"type", "exponential"}, {"value", 0.8}, {"falloff", 0.15}, {"direction", {0.1, 1, 0}}});
    const Json kernels[] = {
        {{"kernel", "calibrated"}}, {{"kernel", "calibrated"}, {"resolution", "half"}}, {{"kernel", "paper"}}};
    const Frame frame = lit_frame(48, 36);
    for (const Json &density : {constant_density, varied})
        for (const Json &kernel : kernels) {
            SCOPED_TRACE(kernel.dump() + (density == varied ? ", varied" : ", constant"));
            const Options asking{clamp_sky, {"optical_depth", "transmittance"}};
            const Result own = run(context(), filtered(density, kernel).dump(), frame.color, frame.depth, asking);
            for (const char *name : {"optical_depth", "transmittance"}) {
                Options giving{clamp_sky, {"optical_depth", "transmittance"}};
                giving.inputs[name] = std::string(name) == "optical_depth" ? own.optical_depth : own.transmittance;
                const Result given =
                    run(context(), filtered(Json::array({constant(7)}), kernel).dump(), frame.color, frame.depth, giving);
                const Worst picture = compare(given.output, own.output, 0.05),
                            tau = compare(given.optical_depth, own.optical_depth, 0.05),
                            straight = compare(given.transmittance, own.transmittance, 1e-3);
                EXPECT_LT(picture.error, 1e-4) << name << ": output: " << picture.describe();
                EXPECT_LT(tau.error, 1e-4) << name << ": optical depth: " << tau.describe();
                EXPECT_LT(straight.error, 1e-4) << name << ": transmittance: " << straight.describe();
            }
        }
}

// What is no optical depth or transmittance counts as the nearest that is one, and spoils no neighbour.
TEST_P(LayersOn, OddValuesAreTheNearestThatMakeSense)
{
    const Json scene = filtered(Json::array({constant(1)}), {{"kernel", "calibrated"}});
    const Frame frame = lit_frame(16, 12);
    const float nan = NAN, inf = INFINITY;
    const std::pair<float, float> of_depth[] = {{nan, 0}, {-3, 0}, {-inf, 0}, {inf, 1e30f}, {-0.0f, 0}},
                                  of_transmittance[] = {{nan, 1}, {-inf, 1e-30f}, {-1, 1e-30f}, {2, 1}, {inf, 1}};
    for (const char *name : {"optical_depth", "transmittance"}) {
        const bool depth = std::string(name) == "optical_depth";
        Picture odd(16, 12, 3, depth ? 0.5f : 0.6f), plain = odd;
        int x = 1;
        for (auto [given, meant] : depth ? of_depth : of_transmittance) {
            std::fill_n(odd.at(x, 5), 3, given);
            std::fill_n(plain.at(x, 5), 3, meant);
            x += 3;
        }
        Options options{clamp_sky, {"transmittance"}};
        options.inputs[name] = odd;
        const Result got = run(context(), scene.dump(), frame.color, frame.depth, options);
        options.inputs[name] = plain;
        const Result expected = run(context(), scene.dump(), frame.color, frame.depth, options);
        EXPECT_EQ(got.output.data, expected.output.data) << name;
        EXPECT_EQ(got.transmittance.data, expected.transmittance.data) << name;
        for (float v : got.output.data)
            ASSERT_TRUE(std::isfinite(v)) << name;
    }
}

// Pixels that are to be kept free of the medium are, whatever the layer says of them.
TEST_P(LayersOn, SkyThatIsKeptHasNoGivenFog)
{
    const Frame frame = lit_frame(16, 12);
    Options options{[](brume_format &f) { f.sky = BRUME_SKY_KEEP; }, {"transmittance"}};
    options.inputs["optical_depth"] = Picture(16, 12, 3, 2.0f);
    const Result r = run(context(), filtered(Json::array({constant(1)}), {{"kernel", "calibrated"}}).dump(), frame.color,
                         frame.depth, options);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(r.transmittance.at(x, y)[0], std::isinf(frame.depth.at(x, y)[0]) ? 1 : std::exp(-2.0f), 1e-5f)
                << x << ", " << y;
}
