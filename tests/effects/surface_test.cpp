// Light that surfaces receive through the medium.
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "exr.h"
#include "lit_scene.h"
#include "maths.hpp"
#include "picture_metrics.h"
#include "relit.h"

using namespace fog;
using brume::maths_double::received_share;

TEST(Surface, NothingChangesInNoMedium)
{
    for (double cosine : {-1.0, 0.0, 0.2, 1.0}) {
        EXPECT_EQ(received_share(0, 0, 0.5, cosine), 1);
        EXPECT_NEAR(received_share(1e-7, 1e-7, 0.5, cosine), 1, 1e-5);
        EXPECT_NE(received_share(1e-3, 1e-3, 0.5, cosine), 1);
    }
}

TEST(Surface, AbsorptionDims)
{
    for (double g : {0.0, 0.7, 0.95})
        for (double scattering : {0.01, 0.3, 3.0, 30.0})
            for (double cosine : {0.05, 0.4, 1.0}) {
                double last = received_share(scattering, 0, g, cosine);
                EXPECT_GT(last, 0.98) << "fog that does not absorb takes nothing";
                for (double absorption = 0.01; absorption < 20; absorption *= 2) {
                    const double now = received_share(scattering, absorption, g, cosine);
                    EXPECT_LT(now, last) << "g " << g << ", scattering " << scattering << ", absorption " << absorption
                                         << ", cosine " << cosine;
                    last = now;
                }
            }
    for (double absorption : {0.1, 1.0, 5.0})
        EXPECT_NEAR(received_share(0, absorption, 0, 0.5), std::exp(-absorption), 1e-12);
}

TEST(Surface, FiniteAtExtremesInBothPrecisions)
{
    for (double g : {-1.0, -0.5, 0.0, 0.7, 1.0})
        for (double scattering : {0.0, 1e-12, 1e-3, 0.1, 1.0, 30.0, 1e9, 1e30})
            for (double absorption : {0.0, 0.1, 1.0, 1e20})
                for (double cosine : {-1.0, 0.0, 0.3, 1.0}) {
                    const double exact = received_share(scattering, absorption, g, cosine);
                    const float got =
                        brume::maths_float::received_share(float(scattering), float(absorption), float(g), float(cosine));
                    EXPECT_GE(exact, 0);
                    EXPECT_NEAR(got, exact, 1e-4 * (exact + 0.01)) << "g " << g << ", scattering " << scattering
                                                                   << ", absorption " << absorption << ", cosine " << cosine;
                }
}

TEST(Surface, NormalsOfDepthKeepToTheirSideOfAnEdge)
{
    using namespace brume::maths_double;
    auto ray = [](double x, double y, double depth) {
        const vec3 through(x, y, -1);
        return Ray{glm::normalize(through), depth * glm::length(through), false};
    };
    // A wall at 5 m; on the right it ends.
    const vec3 wall = normal_by_depth(ray(0, 0, 5), ray(-0.01, 0, 5), ray(0.01, 0, 50), ray(0, 0.01, 5), ray(0, -0.01, 5));
    EXPECT_NEAR(wall.z, 1, 1e-9);
    // The sky has none, and a pixel amid sky neither.
    const double far = far_away;
    EXPECT_EQ(glm::length(normal_by_depth(ray(0, 0, far), ray(0, 0, 5), ray(0, 0, 5), ray(0, 0, 5), ray(0, 0, 5))), 0);
    EXPECT_EQ(glm::length(normal_by_depth(ray(0, 0, 5), ray(0, 0, far), ray(0, 0, far), ray(0, 0, far), ray(0, 0, far))), 0);
}

namespace {

class SurfaceOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, SurfaceOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

Json relit_scene(const Json &medium, const Json &lights)
{
    Json scene = lit_scene(medium, lights);
    scene["effects"] = {{"surface", Json::object()}};
    return scene;
}

const Json coloured{{"scattering", {0.03, 0.05, 0.08}}, {"absorption", {0.01, 0, 0.02}}, {"g", 0.6}};
const Json lamps{point_light({-1.5, 2, -6}, 40, 0.1), point_light({3, 1, -14}, 200)};

Picture random_picture(int width, int height, unsigned seed)
{
    Picture p(width, height, 3);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(0, 1);
    for (float &v : p.data)
        v = u(random);
    return p;
}

Picture sum(const Picture &a, const Picture &b)
{
    Picture out = a;
    for (size_t i = 0; i < out.data.size(); ++i)
        out.data[i] += b.data[i];
    return out;
}

}  // namespace

TEST_P(SurfaceOn, DroppedWhereThereIsNothingToDo)
{
    const Frame frame = lit_frame(24, 16);
    Json empty = relit_scene({{"scattering", 0.1}, {"density", Json::array({constant(0)})}}, lamps);
    for (const Json &scene :
         {relit_scene(coloured, Json::array()), relit_scene({{"scattering", 0}, {"emission", 1}}, lamps), empty})
        EXPECT_EQ(run(context(), scene.dump(), frame.color, frame.depth).output.data, frame.color.data) << scene;
    EXPECT_NE(run(context(), relit_scene(coloured, lamps).dump(), frame.color, frame.depth).output.data, frame.color.data);
}

// A cloud about the ways from the lights, and a larger one elsewhere that is nothing to them.
TEST_P(SurfaceOn, AnyNumberOfGaussiansLiesOnTheWayFromLights)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(0, 1);
    Json near = Json::array();
    for (int i = 0; i < 200; ++i)
        near.push_back(gaussian({6 * u(random) - 3, 4 * u(random) - 2, -4 - 8 * u(random)}, 1 + u(random), 0.3 * u(random)));
    Json all = near;
    for (int i = 0; i < 800; ++i)
        all.push_back(gaussian({200 + 6 * u(random), 4 * u(random), -4 - 8 * u(random)}, 1 + u(random), 0.3));
    const Json sun{{"type", "directional"}, {"direction", {0.3, -1, -0.4}}, {"intensity", 3}};
    const Frame frame = lit_frame(24, 16);
    for (const Json &light : {lamps[0], sun})
        for (const bool known : {false, true}) {
            const std::map<std::string, Picture> layers{{"albedo", random_picture(24, 16, 3)}};
            auto with = [&](const Json &gaussians) {
                return relit(context(), relit_scene({{"scattering", 1}, {"density", gaussians}}, Json::array({light})),
                             frame.color, frame.depth, known ? layers : std::map<std::string, Picture>{});
            };
            const Picture few = with(near), many = with(all);
            const Worst worst = compare(many, few, 0.05);
            const double change = compare(few, frame.color, 0.05).error;
            EXPECT_GT(change, 1e-3) << light;
            // Among more Gaussians cells are smaller, and list fewer of those that a ray passes at a distance.
            EXPECT_LT(worst.error, 1e-2 * change) << light << worst.describe();
        }
}

// A lamp behind the camera, whose map looks the same way and has something before the left half of the wall. Where nothing
// but the lamp is known to light the picture, nothing is known of what is in its shadow.
TEST_P(SurfaceOn, WhatIsInALightsShadowHasNoShareOfIt)
{
    const int width = 8, height = 6;
    const Picture color(width, height, 3, 1), depth(width, height, 1, 5);
    Picture map(64, 64, 1, std::numeric_limits<float>::infinity());
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 32; ++x)
            *map.at(x, y) = 1.5f;
    const Json medium{{"scattering", 0.02}, {"absorption", 0.1}};
    Json lights = Json::array({point_light({0, 0, 1}, 50), point_light({0, 1, 2}, 50)});
    const Json shadow{{"file", "lamp.exr"},
                      {"vertical_fov", 90},
                      {"camera_to_world", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 1}, {0, 0, 0, 1}}}};
    auto becomes = [&](const char *method) {
        Json scene = relit_scene(medium, lights);
        scene["effects"]["surface"]["method"] = method;
        return relit(context(), scene, color, depth,
                     lights[0].contains("shadow") ? std::map<std::string, Picture>{{"shadow", map}}
                                                  : std::map<std::string, Picture>{});
    };
    for (const char *method : {"calibrated", "sun", "reference"}) {
        if (method == std::string("reference") && GetParam() != std::string("cpu"))
            continue;
        lights = Json::array({point_light({0, 0, 1}, 50), point_light({0, 1, 2}, 50)});
        const Picture both = becomes(method);
        lights.erase(0);
        const Picture second = becomes(method);
        lights = Json::array({point_light({0, 0, 1}, 50), point_light({0, 1, 2}, 50)});
        lights[0]["shadow"] = shadow;
        const Picture shadowed = becomes(method);
        lights.erase(1);
        const Picture alone = becomes(method);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto where = ::testing::Message() << method << " at " << x << ", " << y;
                EXPECT_FLOAT_EQ(*shadowed.at(x, y), *(x < width / 2 ? second : both).at(x, y)) << where;
                if (x < width / 2)
                    EXPECT_EQ(*alone.at(x, y), 1) << where;
                else
                    EXPECT_LT(*alone.at(x, y), 0.9f) << where;
            }
    }
}

// A floor that a lamp grazes, in the lamp's map of nothing but the floor.
TEST_P(SurfaceOn, WhatALampGrazesIsNotInItsOwnShadow)
{
    const int w = 64, h = 48, side = 128;
    const double tangent = std::tan(M_PI / 6);
    Picture color(w, h, 3, 1), depth(w, h, 1, std::numeric_limits<float>::infinity()),
        map(side, side, 1, std::numeric_limits<float>::infinity());
    Json lights = Json::array({point_light({0, -0.6, -20}, 50), point_light({0, 5, 2}, 50)});
    Json scene = relit_scene({{"scattering", 0.02}, {"absorption", 0.05}}, lights);
    scene["camera"]["vertical_fov"] = 60;
    for (int y = h / 2 + 3; y < h; ++y)
        for (int x = 0; x < w; ++x)
            *depth.at(x, y) = float(1 / (tangent * (2 * (y + 0.5) / h - 1)));
    for (int y = side / 2; y < side; ++y)
        for (int x = 0; x < side; ++x)
            *map.at(x, y) = float(0.4 / (tangent * (2 * (y + 0.5) / side - 1)));
    const Picture lit = relit(context(), scene, color, depth);
    scene["lights"][0]["shadow"] = {{"file", "lamp.exr"},
                                    {"vertical_fov", 60},
                                    {"camera_to_world", {{-1, 0, 0, 0}, {0, 1, 0, -0.6}, {0, 0, -1, -20}, {0, 0, 0, 1}}}};
    const Picture mapped = relit(context(), scene, color, depth, {{"shadow", map}});
    int dark = 0, all = 0;
    for (int y = h / 2 + 4; y < h; ++y)
        for (int x = 0; x < w; ++x, ++all)
            dark += std::abs(*mapped.at(x, y) - *lit.at(x, y)) > 1e-5f;
    EXPECT_EQ(dark, 0) << "of " << all;
}

// What stands in a light's way tells nothing of whether surfaces are lit or shine.
TEST_P(SurfaceOn, AShadowMapAloneWakesNothing)
{
    const Picture color(16, 12, 3, 1), depth(16, 12, 1, 5), map(8, 8, 1, 3);
    Json scene = lit_scene(coloured, Json::array({lamps[0]}));
    scene["lights"][0]["shadow"] = {{"file", "lamp.exr"},
                                    {"vertical_fov", 90},
                                    {"camera_to_world", {{1, 0, 0, -1.5}, {0, 1, 0, 2}, {0, 0, 1, -6}, {0, 0, 0, 1}}}};
    scene.erase("effects");
    const Picture awake = relit(context(), scene, color, depth, {{"shadow", map}});
    scene["effects"] = {{"airlight", Json::object()}, {"multiscatter", Json::object()}};
    EXPECT_EQ(awake.data, relit(context(), scene, color, depth, {{"shadow", map}}).data);
}

// A picture that is the sum of two lamps' layers becomes the sum of what each becomes alone.
TEST_P(SurfaceOn, GroupsAreEachLampsOwn)
{
    const Frame frame = lit_frame(24, 16);
    const std::vector<Picture> groups{random_picture(24, 16, 1), random_picture(24, 16, 2)};
    const Picture both = relit(context(), relit_scene(coloured, lamps), sum(groups[0], groups[1]), frame.depth, {}, groups);
    Picture apart(24, 16, 3);
    for (size_t l = 0; l < 2; ++l) {
        const Json alone = relit_scene(coloured, Json::array({lamps[l]}));
        const Picture one = relit(context(), alone, groups[l], frame.depth, {}, {groups[l]});
        EXPECT_GT(compare(one, groups[l], 0.05).error, 0.01);
        apart = sum(apart, one);
    }
    const Worst worst = compare(both, apart, 0.05);
    EXPECT_LT(worst.error, 1e-5) << worst.describe();
}

// A lamp that lights no surface has no part in what they show.
TEST_P(SurfaceOn, LampsThatLightNoSurfaces)
{
    const Frame frame = lit_frame(24, 16);
    const Picture color = random_picture(24, 16, 3);
    Json one = relit_scene(coloured, Json::array({lamps[0]})), unlit = relit_scene(coloured, lamps);
    const Picture both = relit(context(), unlit, color, frame.depth);
    unlit["lights"][1]["surfaces"] = false;
    const Picture alone = relit(context(), one, color, frame.depth);
    EXPECT_EQ(relit(context(), unlit, color, frame.depth).data, alone.data);
    EXPECT_NE(both.data, alone.data);
    const Picture group = random_picture(24, 16, 2);
    EXPECT_EQ(relit(context(), unlit, color, frame.depth, {}, {group, group}).data,
              relit(context(), one, color, frame.depth, {}, {group}).data);
}

// Without names of effects, layers of lit surfaces ask for it.
TEST_P(SurfaceOn, RunsWhereLayersSayThatSurfacesAreLit)
{
    const Frame frame = lit_frame(24, 16);
    const Picture color = random_picture(24, 16, 3), group = random_picture(24, 16, 2);
    Json scene = relit_scene(coloured, Json::array({lamps[0]}));
    scene.erase("effects");
    Json named = scene;
    named["effects"] = {{"surface", Json::object()}, {"multiscatter", Json::object()}, {"airlight", Json::object()}};
    EXPECT_EQ(relit(context(), scene, color, frame.depth, {}, {group}).data,
              relit(context(), named, color, frame.depth, {}, {group}).data);
    named["effects"].erase("surface");
    EXPECT_EQ(relit(context(), scene, color, frame.depth).data, relit(context(), named, color, frame.depth).data);
}

// One lamp's light is all there is, whether a layer says so or not.
TEST_P(SurfaceOn, OneLampHasAllOfThePicture)
{
    const Frame frame = lit_frame(24, 16);
    const Picture color = random_picture(24, 16, 3);
    // Behind the camera, so that all that is seen is turned to it.
    const Json scene = relit_scene(coloured, Json::array({point_light({0.2, 0.3, 4}, 40)}));
    const Worst worst =
        compare(relit(context(), scene, color, frame.depth), relit(context(), scene, color, frame.depth, {}, {color}), 0.05);
    EXPECT_LT(worst.error, 1e-5) << worst.describe();
}

TEST_P(SurfaceOn, NormalsOfTheWorldAndOfDepthAgreeOnAWall)
{
    Json scene = relit_scene(coloured, lamps);
    scene["camera"]["camera_to_world"] = pose({1, 0, 2}, 0.4);
    const Picture color = random_picture(24, 16, 4), depth(24, 16, 1, 9);
    Picture normal(24, 16, 3);
    for (int i = 0; i < 24 * 16; ++i) {
        normal.data[size_t(3 * i)] = float(std::sin(0.4));
        normal.data[size_t(3 * i + 2)] = float(std::cos(0.4));
    }
    const Picture by_depth = relit(context(), scene, color, depth);
    const Worst worst = compare(relit(context(), scene, color, depth, {{"normal", normal}}), by_depth, 0.05);
    EXPECT_LT(worst.error, 1e-3) << worst.describe();
    for (int i = 0; i < 24 * 16; ++i)
        normal.data[size_t(3 * i + 1)] = 3;
    EXPECT_GT(compare(relit(context(), scene, color, depth, {{"normal", normal}}), by_depth, 0.05).error, 0.01);
}

TEST_P(SurfaceOn, WhatIsNotFiniteStaysAsItIs)
{
    Frame frame = lit_frame(8, 8);
    frame.color.at(3, 5)[1] = NAN;
    frame.color.at(4, 6)[0] = INFINITY;
    const Picture got = run(context(), relit_scene(coloured, lamps).dump(), frame.color, frame.depth).output;
    EXPECT_TRUE(std::isnan(got.at(3, 5)[1]));
    EXPECT_EQ(got.at(4, 6)[0], INFINITY);
    int finite = 0;
    for (float v : got.data)
        finite += std::isfinite(v);
    EXPECT_EQ(finite, 8 * 8 * 4 - 2);
}

namespace {

namespace f64 = brume::maths_double;

// A plane 5 m before the camera that faces it, and a lamp.
struct Lit {
    f64::Medium medium{};
    f64::Surface surface{true, f64::vec3(0, 0, -5), f64::vec3(0, 0, 1)};
    f64::Light lamp{};
    f64::SurfaceSettings settings{};
    f64::Material material{true, f64::vec3(0.6, 0.3, 0.1), f64::vec3(0), false, 1};

    Lit(double scattering, double g, const f64::vec3 &at)
    {
        medium.scattering = f64::vec3(scattering);
        medium.asymmetry = g;
        medium.phase = f64::vec4(g, 0, 0, 0);
        medium.constant = 1;
        lamp.position = at;
        lamp.intensity = f64::vec3(10);
    }
    f64::vec3 diffuse() const { return material.albedo / f64::pi * f64::clear_irradiance(surface, lamp); }
    f64::vec3 becomes(const f64::vec3 &own) const
    {
        f64::SurfaceSettings around = settings;
        around.material = 2;
        return f64::becomes(f64::change_by_light(medium, f64::lamp_colours(medium), around, surface, lamp, material,
                                                 f64::shine_of(surface, material),
                                                 f64::terms_to_light(medium, lamp, surface.point), {}),
                            own);
    }
};

}  // namespace

TEST(SurfaceMaterial, OfLitLambertSurfacesSaysWhatTheFactorSays)
{
    for (double scattering : {1e-4, 0.05, 0.5})
        for (const f64::vec3 &at : {f64::vec3(0, 0, -2), f64::vec3(3, 1, -3), f64::vec3(-6, 0, -4)}) {
            Lit lit(scattering, 0.5, at);
            const f64::vec3 known = lit.becomes(lit.diffuse());
            lit.material.known = false;
            const f64::vec3 factor = lit.becomes(lit.diffuse());
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(known[c], factor[c], 1e-9 * factor[c]) << scattering;
        }
}

TEST(SurfaceMaterial, FogLightsShadowsAndSidesTurnedAway)
{
    double last = 0;
    for (double scattering : {1e-9, 0.01, 0.05, 0.2}) {
        const double shadow = Lit(scattering, 0, {1, 1, -3}).becomes(f64::vec3(0)).x,
                     behind = Lit(scattering, 0, {1, 1, -7}).becomes(f64::vec3(0)).x;
        EXPECT_GT(shadow, last);
        EXPECT_GT(behind, 0);
        last = shadow;
    }
    EXPECT_LT(Lit(1e-9, 0, {1, 1, -3}).becomes(f64::vec3(0)).x, 1e-8) << "in clear air they stay as they are";
    // Turning away dims without a jump.
    const double before = Lit(0.05, 0.3, {3, 0, -5 + 1e-7}).becomes(f64::vec3(0)).x,
                 after = Lit(0.05, 0.3, {3, 0, -5 - 1e-7}).becomes(f64::vec3(0)).x,
                 far = Lit(0.05, 0.3, {1, 0, -8}).becomes(f64::vec3(0)).x;
    EXPECT_NEAR(after, before, 1e-5 * before);
    EXPECT_LT(far, before);
}

TEST(SurfaceMaterial, HighlightsDimAndWiden)
{
    for (double g : {0.0, 0.7}) {
        auto shown = [&](double scattering, double aside) {
            Lit lit(scattering, g, {aside, 0, 0});
            lit.material.albedo = f64::vec3(0);
            lit.material.specular = f64::vec3(0.5);
            lit.material.exponent = 50;
            const double cosine = 5 / std::sqrt(25 + aside * aside);
            const double own = 0.5 * 51 / (2 * f64::pi) * std::pow(cosine, 50) * 10 / (25 + aside * aside);
            return std::pair(own, lit.becomes(f64::vec3(own)).x);
        };
        const auto [peak, peak_fogged] = shown(0.05, 0);
        EXPECT_LT(peak_fogged, peak);
        EXPECT_GT(peak_fogged, 0.5 * peak * std::exp(-0.25));
        const auto [edge, edge_fogged] = shown(0.05, 4);
        EXPECT_GT(edge_fogged, edge);
        const auto [same, clear] = shown(0, 2);
        EXPECT_NEAR(clear, same, 1e-12);
    }
}

TEST(SurfaceMaterial, FiniteAtTheExtremes)
{
    for (double scattering : {0.0, 1e-12, 1.0, 1e4})
        for (double g : {-0.999, 0.0, 1.0})
            for (const f64::vec3 &at : {f64::vec3(0, 0, -5), f64::vec3(0), f64::vec3(0, 0, -1e6), f64::vec3(1e6, 0, 0)})
                for (double roughness : {0.0, 1e-6, 0.5, 1.0, double(NAN)})
                    for (double own : {0.0, 1e10, -1.0}) {
                        Lit lit(scattering, g, at);
                        lit.material = f64::material_of(2, f64::vec3(1), f64::vec3(1, 0, NAN), roughness);
                        const f64::vec3 got = lit.becomes(f64::vec3(own));
                        ASSERT_TRUE(std::isfinite(got.x) && std::isfinite(got.y) && std::isfinite(got.z))
                            << scattering << " " << g << " " << roughness << " " << own;
                    }
}

#ifdef BRUME_GL
TEST(SurfaceMaterial, BackendsAgree)
{
    const Frame frame = lit_frame(40, 32);
    const Picture group = random_picture(40, 32, 2);
    std::map<std::string, Picture> material{{"albedo", random_picture(40, 32, 5)}, {"specular", random_picture(40, 32, 6)}};
    material["roughness"] = Picture(40, 32, 1, 0.4f);
    const Json scene = relit_scene(coloured, lamps);
    const Worst worst = compare(relit(backend("gl"), scene, frame.color, frame.depth, material, {group, group}),
                                relit(cpu(), scene, frame.color, frame.depth, material, {group, group}), 0.05);
    EXPECT_LT(worst.error, 1e-3) << worst.describe();
}

TEST(Surface, BackendsAgree)
{
    const Frame frame = lit_frame(40, 32);
    for (const NamedScene &named : lit_scenes()) {
        Json scene = named.scene;
        scene["effects"] = {{"surface", Json::object()}};
        const Worst worst = compare(run(backend("gl"), scene.dump(), frame.color, frame.depth).output,
                                    run(cpu(), scene.dump(), frame.color, frame.depth).output, 0.01);
        EXPECT_LT(worst.error, 1e-4) << named.name << ": " << worst.describe();
    }
}
#endif

// The model's constants come from paths (surface_calibration), none from these pictures.
TEST(Surface, LampsThatLightWhatIsSeen)
{
    const std::filesystem::path folder = std::filesystem::path(BRUME_SHARED_DIR) / "truth";
    if (std::string(BRUME_SHARED_DIR).empty() || !std::filesystem::exists(folder))
        GTEST_SKIP() << "no path-traced scenes here";
    const std::filesystem::path clear = folder / "yard_clear.exr";
    const Picture color = read_exr(clear, {"R", "G", "B", "A"}), depth = read_exr(clear, {"Z"}),
                  normal = read_exr(clear, {"normal.X", "normal.Y", "normal.Z"});
    std::vector<Picture> groups;
    for (const char *group : {"L0", "L1", "L2"})
        groups.push_back(read_exr(clear, {std::string(group) + ".R", std::string(group) + ".G", std::string(group) + ".B"}));
    for (const char *medium : {"m1", "m2"}) {
        const std::string file = folder / (std::string("yard_") + medium);
        const Json description = Json::parse(std::ifstream(file + ".json"));
        Json scene{{"brume", 1},
                   {"camera",
                    {{"horizontal_fov", description["camera"]["horizontal_fov_degrees"]},
                     {"camera_to_world", description["camera"]["camera_to_world"]}}},
                   {"medium", description["medium"]},
                   {"effects", {{"multiscatter", Json::object()}, {"airlight", {{"orders", "all"}, {"ground", "z"}}}}}};
        scene["medium"].erase("orders");
        for (Json light : description["lights"]) {
            light.erase("group");
            scene["lights"].push_back(light);
        }
        const Picture truth = read_exr(file + ".exr", {"R", "G", "B"});
        auto error = [&](const char *what, const Picture &got) {
            double ours = 0, theirs = 0;
            for (int i = 0; i < truth.width * truth.height; ++i)
                for (int c = 0; c < 3; ++c) {
                    const double weight[] = {0.2126, 0.7152, 0.0722};
                    ours += weight[c] * got.data[size_t(i * got.channels + c)];
                    theirs += weight[c] * truth.data[size_t(i * 3 + c)];
                }
            const double e = rel_mse(got, truth);
            printf("yard %s, %s: relMSE %.4f, energy %.3f\n", medium, what, e, ours / theirs);
            return e;
        };
        const double without = error("surfaces as they are", run(cpu(), scene.dump(), color, depth).output);
        scene["effects"]["surface"] = Json::object();
        const double grouped =
            error("light groups, normals", relit(cpu(), scene, color, depth, {{"normal", normal}}, groups));
        error("normals", relit(cpu(), scene, color, depth, {{"normal", normal}}));
        error("depth alone", run(cpu(), scene.dump(), color, depth).output);
        std::map<std::string, Picture> material{{"normal", normal}};
        for (const char *name : {"albedo", "specular"})
            material[name] = read_exr(clear, {std::string(name) + ".R", std::string(name) + ".G", std::string(name) + ".B"});
        material["roughness"] = read_exr(clear, {"roughness.Y"});
        const double all = error("light groups, normals, materials", relit(cpu(), scene, color, depth, material, groups));
        for (const char *method : {"sun", "psf"}) {
            scene["effects"]["surface"]["method"] = method;
            const std::string what = std::string("the same by method ") + method;
            EXPECT_GT(error(what.c_str(), relit(cpu(), scene, color, depth, material, groups)), all)
                << medium << ": scattered once is not enough";
        }
        scene.erase("effects");
        const double by_default = error("the same, no effects named", relit(cpu(), scene, color, depth, material, groups));
        const double ungrouped = error("no effects named, no layers", run(cpu(), scene.dump(), color, depth).output);
        EXPECT_LT(grouped, 1.2 * without) << medium;
        EXPECT_LT(all, 1.2 * without) << medium;
        EXPECT_LT(by_default, 0.008) << medium;
        EXPECT_LT(ungrouped, 0.0265) << medium << ": half of what single scattering has";
    }
}
