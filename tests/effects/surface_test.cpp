// Light that surfaces receive through the medium.
#include <filesystem>
#include <fstream>

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

#ifdef BRUME_GL
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
        EXPECT_LT(grouped, 1.2 * without) << medium;
    }
}
