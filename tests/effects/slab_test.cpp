// Suns and sky above a medium that lies in layers: the model's own balance, paths, and what surfaces and airlight make of
// it.
#include <gtest/gtest.h>

#include "../bench/slab_tracer.h"
#include "maths.hpp"
#include "relit.h"

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;
using namespace fog;
using f64::slab_field;
using f64::SlabField;
using f64::vec2;

namespace {

// At the ground, from optical depths straight down.
SlabField of_sun(double scattering, double absorption, double g, double cosine, double ground)
{
    return slab_field(vec2(scattering), vec2(absorption), g, 1, cosine, ground);
}

SlabField of_sky(double scattering, double absorption, double g, double ground)
{
    return slab_field(vec2(scattering), vec2(absorption), g, 0, 1, ground);
}

// Over clear air.
double onto_ground(double scattering, double absorption, double g, double cosine, double ground)
{
    const SlabField f = of_sun(scattering, absorption, g, cosine, ground);
    return f.straight + f.down / cosine;
}

}  // namespace

TEST(SlabField, AnEvenSkyOverWhiteGroundIsAsInClearAir)
{
    for (double g : {-0.5, 0.0, 0.5, 0.9})
        for (double depth : {0.0, 1e-6, 0.01, 1.0, 30.0, 1e4})
            for (double at : {0.0, 0.3, 1.0}) {
                const SlabField f = slab_field(vec2(at * depth, depth), vec2(0), g, 0, 1, 1);
                EXPECT_NEAR(f.down, 1, 1e-6) << "g " << g << " depth " << depth << " at " << at;
                EXPECT_NEAR(f.up, 1, 1e-6);
            }
}

// A sun of one height is no sky: fog turns its light from or toward the ground. Suns of all heights are.
TEST(SlabField, SunsOfAllHeightsOverWhiteGroundGiveWhatTheyDoInClearAir)
{
    for (double g : {0.0, 0.5, 0.9})
        for (double reduced : {0.01, 0.1, 1.0, 10.0, 100.0}) {
            double sum = 0;
            for (int i = 0; i < 400; ++i) {
                const double cosine = (i + 0.5) / 400;
                sum += 2 * cosine * onto_ground(reduced / (1 - g), 0, g, cosine, 1) / 400;
            }
            EXPECT_NEAR(sum, 1, 0.03) << "g " << g << " depth " << reduced;
        }
}

TEST(SlabField, LosesNoEnergyWhereNothingIsAbsorbed)
{
    for (double g : {0.0, 0.6, 0.9})
        for (double depth : {0.1, 2.0, 50.0})
            for (double cosine : {0.1, 0.5, 1.0})
                for (double ground : {0.0, 0.3}) {
                    const auto net = [&](double at) {
                        const SlabField f = slab_field(vec2(at * depth, depth), vec2(0), g, 1, cosine, ground);
                        return f.down - f.up + cosine * f.straight;
                    };
                    for (double at : {0.2, 0.7, 1.0})
                        EXPECT_NEAR(net(at), net(0), 2e-3) << g << " " << depth << " " << cosine;
                    EXPECT_GT(net(1), 0);
                }
}

// What surfaces need of it by itself.
TEST(SlabField, WhatTheGroundReceivesIsTheFieldsThere)
{
    for (double g : {-0.9, 0.0, 0.6, 0.95})
        for (double albedo : {0.0, 0.7, 1.0})
            for (double depth : {0.0, 1e-5, 0.9e-3, 0.01, 1.0, 40.0, 1e5})
                for (double sun : {0.0, 1.0})
                    for (double cosine : {0.1, 1.0})
                        for (double ground : {0.0, 0.5, 1.0}) {
                            const double s = albedo * depth / (1 - g), a = (1 - albedo) * depth;
                            const SlabField f = slab_field(vec2(s), vec2(a), g, sun, cosine, ground);
                            const f64::SlabStreams streams = f64::slab_streams(s, a, g, 0, sun, cosine, ground);
                            EXPECT_NEAR(f64::slab_ground(streams, sun, ground), f.down, 1e-8)
                                << g << " " << albedo << " " << depth << " " << sun << " " << cosine << " " << ground;
                            EXPECT_NEAR(streams.straight, f.straight, 1e-12);
                        }
}

TEST(SlabField, NothingChangesInNoMediumAndLittleInAThinOne)
{
    for (double cosine : {0.1, 0.5, 1.0}) {
        EXPECT_EQ(onto_ground(0, 0, 0.5, cosine, 0.3), 1);
        for (double depth : {1e-3, 1e-5})
            EXPECT_NEAR(onto_ground(depth, depth, 0.5, cosine, 0), 1, 2.5 * depth / cosine);
        EXPECT_LT(onto_ground(1e-3, 1e-3, 0.5, cosine, 0), 1 - 1e-3);
    }
    EXPECT_EQ(of_sky(0, 0, 0.5, 0.3).down, 1);
    EXPECT_NEAR(of_sky(1e-5, 1e-5, 0.5, 0).down, 1, 5e-5);
    for (double absorption : {0.1, 1.0, 5.0})
        EXPECT_NEAR(onto_ground(0, absorption, 0, 0.4, 0.5), std::exp(-absorption / 0.4), 1e-9) << "what absorbs alone";
}

TEST(SlabField, AbsorptionDims)
{
    for (double g : {0.0, 0.7, 0.95})
        for (double scattering : {0.01, 0.3, 3.0, 30.0})
            for (double cosine : {0.1, 0.4, 1.0})
                for (double ground : {0.0, 0.5, 1.0}) {
                    double sun = onto_ground(scattering, 0, g, cosine, ground), sky = of_sky(scattering, 0, g, ground).down;
                    for (double absorption = 0.01; absorption < 5; absorption *= 2) {
                        const double sun_now = onto_ground(scattering, absorption, g, cosine, ground),
                                     sky_now = of_sky(scattering, absorption, g, ground).down;
                        EXPECT_LT(sun_now, sun) << g << " " << scattering << " " << absorption << " " << cosine;
                        EXPECT_LT(sky_now, sky) << g << " " << scattering << " " << absorption;
                        sun = sun_now;
                        sky = sky_now;
                    }
                }
}

// Of what the sun gives the ground in clear air, but for suns so low that fog of forward peaks knows their way
// (slab_calibration).
TEST(SlabField, IsNearPaths)
{
    double square = 0;
    int count = 0;
    for (double g : {0.0, 0.6})
        for (double albedo : {1.0, 0.9})
            for (double cosine : {1.0, 0.5})
                for (double ground : {0.0, 0.6})
                    for (double reduced : {0.2, 1.0, 4.0}) {
                        const double depth = reduced / (1 - g);
                        const lamp_tracer::Slab slab{albedo, g, depth, cosine, ground};
                        const double paths =
                            lamp_tracer::trace_slab_irradiance(slab, depth, {0, 0, 1}, 4000, 3).mean / cosine +
                            std::exp(-depth / cosine);
                        const double mine = onto_ground(albedo * depth, (1 - albedo) * depth, g, cosine, ground);
                        EXPECT_NEAR(mine, paths, 0.05) << "g " << g << " albedo " << albedo << " sun " << cosine
                                                       << " ground " << ground << " " << depth;
                        square += (mine - paths) * (mine - paths);
                        ++count;
                    }
    EXPECT_LT(std::sqrt(square / count), 0.02);
}

// What surfaces of any slope receive, over the sun's irradiance across its rays: low suns and forward peaks, too.
TEST(SlabField, WallsAreNearPaths)
{
    double square = 0;
    int count = 0;
    for (double g : {0.0, 0.5, 0.85})
        for (double cosine : {0.7, 0.3})
            for (double reduced : {0.1, 0.3, 1.0, 3.0}) {
                const double slant = std::sqrt(1 - cosine * cosine);
                const lamp_tracer::Slab slab{1, g, reduced / (1 - g), cosine, 0};
                const lamp_tracer::vec3 to_sun(slant, 0, cosine),
                    normals[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, to_sun, -to_sun};
                const f64::SlabStreams streams = f64::slab_streams(slab.depth, 0, g, f64::low_sun(cosine), 1, cosine, 0);
                for (const lamp_tracer::vec3 &n : normals) {
                    const double to = glm::dot(n, to_sun), faced = std::max(to, 0.0);
                    const double mine = faced * streams.straight +
                                        f64::onto_surface(f64::slab_ground(streams, 1, 0), f64::slab_side(streams),
                                                          f64::below_sun(n.z, to, {f64::vec3(0, 0, 1), cosine}));
                    const double paths = faced * std::exp(-slab.depth / cosine) +
                                         lamp_tracer::trace_slab_irradiance(slab, slab.depth, n, 6000, 3).mean;
                    EXPECT_NEAR(mine, paths, 0.05)
                        << "g " << g << " sun " << cosine << " normal " << n.x << " " << n.y << " " << n.z << " " << reduced;
                    square += (mine - paths) * (mine - paths);
                    ++count;
                }
            }
    EXPECT_LT(std::sqrt(square / count), 0.015);
}

// Surfaces with a transfer of nothing around them get the same.
TEST(SlabField, HarmonicsOfASunsLightAreThoseOfItsCosines)
{
    for (double g : {0.0, 0.85})
        for (double cosine : {0.2, 0.8})
            for (double up : {-0.3, 0.0, 0.6, 1.0})
                for (double to_sun : {-0.4, 0.1, 0.7}) {
                    const f64::SlabStreams streams = f64::slab_streams(1, 0.1, g, f64::low_sun(cosine), 1, cosine, 0.3);
                    const double down = f64::slab_ground(streams, 1, 0.3);
                    const f64::SlabSide side = f64::slab_side(streams);
                    EXPECT_NEAR(
                        f64::sent_below_sun(down, side, f64::sent_by_cosine(up), f64::sent_by_cosine(to_sun).of[1], cosine),
                        f64::onto_surface(down, side, f64::below_sun(up, to_sun, {f64::vec3(0, 0, 1), cosine})) / f64::pi,
                        1e-9);
                }
}

TEST(SlabField, FloatIsDouble)
{
    for (double g : {-0.999, 0.0, 0.7, 1.0})
        for (double scattering : {0.0, 1e-12, 1e-3, 0.1, 1.0, 30.0, 1e9, 1e30})
            for (double absorption : {0.0, 1e-6, 0.1, 1.0, 1e20})
                for (double at : {0.0, 1e-6, 0.5, 1.0})
                    for (double sun : {0.0, 1.0})
                        for (double cosine : {0.0, 0.02, 0.3, 1.0})
                            for (double ground : {0.0, 1.0}) {
                                const SlabField exact =
                                    slab_field(vec2(at * scattering, scattering), vec2(at * absorption, absorption), g, sun,
                                               cosine, ground);
                                const f32::SlabField got =
                                    f32::slab_field(f32::vec2(float(at * scattering), float(scattering)),
                                                    f32::vec2(float(at * absorption), float(absorption)), float(g),
                                                    float(sun), float(cosine), float(ground));
                                const auto where = [&] {
                                    return testing::Message()
                                           << "g " << g << " s " << scattering << " a " << absorption << " at " << at
                                           << " sun " << sun << " " << cosine << " ground " << ground;
                                };
                                EXPECT_NEAR(got.down, exact.down, 2e-3) << where();
                                EXPECT_NEAR(got.up, exact.up, 2e-3) << where();
                                EXPECT_NEAR(got.straight, exact.straight, 1e-4) << where();
                                const double low = f64::low_sun(cosine);
                                const f64::SlabStreams streams =
                                    f64::slab_streams(scattering, absorption, g, low, sun, cosine, ground);
                                const f32::SlabStreams narrow =
                                    f32::slab_streams(float(scattering), float(absorption), float(g), float(low), float(sun),
                                                      float(cosine), float(ground));
                                EXPECT_NEAR(f32::slab_ground(narrow, float(sun), float(ground)),
                                            f64::slab_ground(streams, sun, ground), 2e-3)
                                    << where();
                                EXPECT_NEAR(f32::slab_side(narrow).walls, f64::slab_side(streams).walls, 1e-4) << where();
                                EXPECT_NEAR(f32::slab_side(narrow).toward, f64::slab_side(streams).toward, 2e-3) << where();
                            }
}

namespace {

class SunOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, SunOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

Json ground_fog(double scattering, double absorption)
{
    return {{"scattering", scattering},
            {"absorption", absorption},
            {"density", {{{"type", "exponential"}, {"value", 1}, {"falloff", 0.1}, {"direction", {0, 0, 1}}}}}};
}

Json sun_from(const Vector &direction)
{
    return {{"type", "directional"}, {"direction", direction}, {"intensity", 3}};
}

// A wall 5 m before the camera across -z, which lies as the ground of fog that thins out along z.
Json relit_by(const Json &medium, const Json &lights, double ground_albedo)
{
    Json scene = lit_scene(medium, lights);
    scene["effects"] = {{"surface", {{"ground_albedo", ground_albedo}}}};
    return scene;
}

// Of 1.
double shown(brume_context context, const Json &scene)
{
    const Picture color(8, 8, 3, 1), depth(8, 8, 1, 5);
    return relit(context, scene, color, depth).at(4, 4)[1];
}

// Optical depths are e^(.5) / .1 times these: the wall is below the camera, where the density is 1.
const double depth_of_wall = std::exp(0.5) / 0.1;

}  // namespace

TEST_P(SunOn, SurfacesGetWhatTheModelSays)
{
    for (double sine : {0.0, 0.6}) {
        const double cosine = std::sqrt(1 - sine * sine);
        const Json sun = Json::array({sun_from({sine, 0, -cosine})});
        for (double scattering : {0.01, 0.1})
            for (double absorption : {0.0, 0.02})
                EXPECT_NEAR(shown(context(), relit_by(ground_fog(scattering, absorption), sun, 0.4)),
                            onto_ground(scattering * depth_of_wall, absorption * depth_of_wall, 0, cosine, 0.4), 2e-4)
                    << scattering << " " << absorption << " " << sine;
    }
    EXPECT_LT(shown(context(), relit_by(ground_fog(0.1, 0), Json::array({sun_from({0, 0, -1})}), 0)), 0.8);
}

// Beneath it lies fog without an end.
TEST_P(SunOn, OfASunBelowTheHorizonNothingIsLeft)
{
    Json scene = relit_by(ground_fog(0.1, 0), Json::array({sun_from({0, 0.6, -0.8})}), 0);
    scene["medium"]["density"][0]["direction"] = {0, 0, -1};
    EXPECT_LT(shown(context(), scene), 1e-6);
}

// Constant terms have none, and airlight lets a sun's light through so much of them as its distance says.
TEST_P(SunOn, ConstantFogTakesAsMuchAsTheLightsDistanceSays)
{
    Json sun = sun_from({0, 0, -1});
    const Json fog{{"scattering", 0}, {"absorption", 0.1}};
    EXPECT_EQ(shown(context(), relit_by(fog, Json::array({sun}), 0)), 1);
    sun["distance"] = 7;
    EXPECT_NEAR(shown(context(), relit_by(fog, Json::array({sun}), 0)), std::exp(-0.7), 1e-5);
}

TEST_P(SunOn, AnEvenSkyOverWhiteGroundLeavesThePicture)
{
    Json scene = relit_by(ground_fog(0.3, 0), Json::array(), 1);
    scene["environment"]["sh"] = {{2, 2, 2}};
    EXPECT_NEAR(shown(context(), scene), 1, 1e-4);
    scene["effects"]["surface"]["ground_albedo"] = 0;
    EXPECT_NEAR(shown(context(), scene), of_sky(0.3 * depth_of_wall, 0, 0, 0).down, 1e-4);
    scene["medium"]["absorption"] = 10;
    EXPECT_LT(shown(context(), scene), 1e-6);
    // No end, no loss.
    scene["medium"]["density"].push_back(constant(1));
    EXPECT_EQ(shown(context(), scene), 1);
}

TEST_P(SunOn, FogBringsASunsLightIntoItsShadowsWhereMaterialsAreKnown)
{
    const Json scene = relit_by(ground_fog(0.1, 0), Json::array({sun_from({0, 0, -1})}), 0);
    const Picture black(8, 8, 3), depth(8, 8, 1, 5), albedo(8, 8, 3, 0.5f);
    const double got = relit(context(), scene, black, depth, {{"albedo", albedo}}).at(4, 4)[1];
    const double aside = of_sun(0.1 * depth_of_wall, 0, 0, 1, 0).down;
    EXPECT_NEAR(got, 0.5 / f64::pi * 3 * aside, 1e-4);
}
