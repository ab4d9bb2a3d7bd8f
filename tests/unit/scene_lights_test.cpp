#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"
#include "gaussians/gaussian_frames.h"
#include "scene/scene.h"

namespace brume {
namespace {

using Matrix = std::array<double, 16>;

// At (1e7, -2e7, 3e7), right = world y, up = world z, back = world x: it looks along -x.
constexpr Matrix far_pose{0, 0, 1, 1e7, 1, 0, 0, -2e7, 0, 1, 0, 3e7, 0, 0, 0, 1};
constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Number3 numbers(double x, double y, double z)
{
    return {Number(x), Number(y), Number(z)};
}

Number keyed(double first, double second)
{
    return Number({{1.0, first}, {3.0, second}});
}

std::vector<brume_plugin_light> lights_of(const Scene &scene, double frame = 0, const Matrix &pose = identity)
{
    std::vector<brume_plugin_light> out(7);
    evaluate_lights(scene, frame, pose, out);
    return out;
}

std::vector<brume_plugin_gaussian> gaussians_of(const Scene &scene, double frame = 0, const Matrix &pose = identity)
{
    std::vector<brume_plugin_gaussian> out(7);
    evaluate_gaussians(scene, frame, pose, out);
    return out;
}

template <class Function> std::string failure(Function function)
{
    try {
        function();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), BRUME_ERROR_ARGUMENT);
        return error.what();
    }
    return "accepted";
}

void expect_vector(const float (&got)[3], double x, double y, double z)
{
    EXPECT_FLOAT_EQ(got[0], float(x));
    EXPECT_FLOAT_EQ(got[1], float(y));
    EXPECT_FLOAT_EQ(got[2], float(z));
}

TEST(EvaluateLights, AreSeenFromTheCameraInMetres)
{
    Scene scene;
    scene.metres_per_unit = 0.5;
    Light point;
    point.position = numbers(1e7 + 2, -2e7 + 4, 3e7 + 6);
    point.intensity = numbers(1, 2, 3);
    point.radius = 0.25;
    Light spot = point;
    spot.type = BRUME_LIGHT_SPOT;
    spot.direction = numbers(0, -4, 0);
    spot.angle = std::numbers::pi / 2;
    spot.penumbra = 0.5;
    Light sun;
    sun.type = BRUME_LIGHT_DIRECTIONAL;
    sun.direction = numbers(0, 0, -1e-3);
    sun.distance = 200.0;
    scene.lights = {point, spot, sun};

    const auto lights = lights_of(scene, 0, far_pose);
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].type, float(BRUME_LIGHT_POINT));
    expect_vector(lights[0].position, 2, 3, 1);
    expect_vector(lights[0].intensity, 1, 2, 3);
    EXPECT_EQ(lights[0].radius, 0.125f);
    EXPECT_EQ(lights[1].type, float(BRUME_LIGHT_SPOT));
    expect_vector(lights[1].position, 2, 3, 1);
    expect_vector(lights[1].direction, -1, 0, 0);
    EXPECT_FLOAT_EQ(lights[1].cos_outer, float(std::cos(std::numbers::pi / 4)));
    EXPECT_FLOAT_EQ(lights[1].cos_inner, float(std::cos(std::numbers::pi / 8)));
    EXPECT_EQ(lights[2].type, float(BRUME_LIGHT_DIRECTIONAL));
    expect_vector(lights[2].position, 0, 0, 0);
    expect_vector(lights[2].direction, 0, -1, 0);
    EXPECT_EQ(lights[2].radius, 0.0f);
    EXPECT_EQ(lights[2].distance, 100.0f);
}

TEST(EvaluateLights, FollowTheirKeysAndStayWhereDark)
{
    Scene scene;
    scene.lights.resize(2);
    scene.lights[0].intensity = numbers(0, 0, 0);
    EXPECT_FALSE(scene.animated());
    scene.lights[1].position[1] = keyed(0, 10);
    EXPECT_TRUE(scene.animated());
    const auto lights = lights_of(scene, 2);
    ASSERT_EQ(lights.size(), 2u);
    expect_vector(lights[0].intensity, 0, 0, 0);
    expect_vector(lights[1].position, 0, 5, 0);

    scene.lights[1].type = BRUME_LIGHT_DIRECTIONAL;
    scene.lights[1].direction = numbers(0, 0, 0);
    scene.lights[1].direction[0] = keyed(-1, 1);
    EXPECT_EQ(failure([&] { lights_of(scene, 2); }),
              "lights[1].direction: (0, 0, 0) at frame 2; expected a vector that is not zero");
    EXPECT_TRUE(lights_of(Scene()).empty());
}

TEST(EvaluateLights, ExtremesHaveFiniteSquares)
{
    Scene scene;
    scene.metres_per_unit = 1e12;
    scene.lights.resize(1);
    scene.lights[0].position = numbers(1e30, -1e30, 0);
    scene.lights[0].radius = 1e30;
    const auto light = lights_of(scene)[0];
    EXPECT_TRUE(std::isfinite(light.radius * light.radius));
    EXPECT_TRUE(std::isfinite(light.position[0] * light.position[0] + light.position[1] * light.position[1]));
}

Scene with_gaussians(std::vector<GaussianTerm> terms)
{
    Scene scene;
    scene.medium.emplace();
    scene.medium->gaussians = std::move(terms);
    return scene;
}

GaussianSet fixed_set(std::vector<Gaussian> gaussians)
{
    GaussianSet set;
    set.file = "puffs.csv";
    set.fixed = std::make_shared<const std::vector<Gaussian>>(std::move(gaussians));
    return set;
}

TEST(EvaluateGaussians, AreSeenFromTheCameraInMetres)
{
    GaussianTerm term;
    term.center = numbers(1e7 + 2, -2e7 + 4, 3e7 + 6);
    term.scale = 3.0;
    term.amplitude = 0.25;
    term.color = numbers(0.5, 1, 0);
    Scene scene = with_gaussians({term});
    scene.metres_per_unit = 0.5;
    scene.medium->gaussian_sets.push_back(fixed_set({{{1e7, -2e7, 3e7 + 2}, 1.0, 2.0}, {{0, 0, 0}, 1.0, 0.0}}));
    scene.medium->gaussian_sets[0].amplitude = 1.5;

    const auto gaussians = gaussians_of(scene, 0, far_pose);
    ASSERT_EQ(gaussians.size(), 2u) << "the one without density is left out";
    expect_vector(gaussians[0].center, 2, 3, 1);
    EXPECT_EQ(gaussians[0].scale, 6.0f);
    EXPECT_EQ(gaussians[0].amplitude, 0.25f);
    expect_vector(gaussians[0].color, 0.5, 1, 0);
    expect_vector(gaussians[1].center, 0, 1, 0);
    EXPECT_EQ(gaussians[1].scale, 2.0f);
    EXPECT_EQ(gaussians[1].amplitude, 3.0f);
}

TEST(EvaluateGaussians, TakeThePlaceOfTheConstantDensity)
{
    brume_plugin_medium medium;
    Scene scene = with_gaussians({});
    evaluate_medium(scene, 0, identity, medium);
    EXPECT_EQ(medium.constant, 1.0f);
    scene.medium->gaussians.resize(1);
    evaluate_medium(scene, 0, identity, medium);
    EXPECT_EQ(medium.constant, 0.0f);
    scene.medium->gaussians.clear();
    scene.medium->gaussian_sets.push_back(fixed_set({}));
    evaluate_medium(scene, 0, identity, medium);
    EXPECT_EQ(medium.constant, 0.0f);
    scene.medium->density.resize(1);
    evaluate_medium(scene, 0, identity, medium);
    EXPECT_EQ(medium.constant, 1.0f);
}

TEST(EvaluateGaussians, AnimationPoseAndPeak)
{
    Scene scene = with_gaussians(std::vector<GaussianTerm>(1));
    EXPECT_FALSE(scene.animated());
    EXPECT_TRUE(pose_matters(scene));
    scene.medium->gaussians[0].amplitude = 0.0;
    EXPECT_FALSE(pose_matters(scene));
    EXPECT_TRUE(gaussians_of(scene).empty());
    scene.medium->gaussians[0].amplitude = keyed(0, 3);
    EXPECT_TRUE(scene.animated());
    EXPECT_TRUE(pose_matters(scene));
    EXPECT_TRUE(gaussians_of(scene, 1).empty());
    ASSERT_EQ(gaussians_of(with_peak_medium(scene), 1).size(), 1u);
    EXPECT_EQ(gaussians_of(with_peak_medium(scene), 1)[0].amplitude, 3.0f);

    scene = with_gaussians({});
    scene.medium->gaussian_sets.push_back(fixed_set({{}}));
    EXPECT_FALSE(scene.animated());
    EXPECT_TRUE(pose_matters(scene));
    scene.medium->gaussian_sets[0].amplitude = keyed(4, 0);
    EXPECT_TRUE(scene.animated());
    EXPECT_TRUE(gaussians_of(scene, 3).empty());
    EXPECT_EQ(gaussians_of(with_peak_medium(scene), 3)[0].amplitude, 4.0f);
}

TEST(EvaluateGaussians, ExtremesHaveNormalSquares)
{
    Gaussian wide, narrow;
    wide.scale = 1e-30;
    wide.center = {1e30, 0, 0};
    narrow.scale = 1e30;
    narrow.amplitude = 1e30;
    Scene scene = with_gaussians({});
    scene.medium->gaussian_sets.push_back(fixed_set({wide, narrow}));
    for (double metres : {1e-12, 1e12}) {
        scene.metres_per_unit = metres;
        for (const brume_plugin_gaussian &g : gaussians_of(scene)) {
            EXPECT_TRUE(std::isnormal(g.scale * g.scale));
            EXPECT_TRUE(std::isfinite(g.center[0] * g.center[0]));
            EXPECT_TRUE(std::isfinite(g.amplitude));
        }
    }
}

TEST(EvaluateGaussians, AreBounded)
{
    Scene scene = with_gaussians({});
    scene.medium->gaussian_sets = {fixed_set(std::vector<Gaussian>(BRUME_MAX_GAUSSIANS)), fixed_set({{}})};
    EXPECT_EQ(failure([&] { gaussians_of(scene); }), "medium: more Gaussians than 1000000");
}

class GaussianFramesTest : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(const std::string &name, double amplitude)
    {
        std::ofstream(folder_ / name) << "x,y,z,scale,amplitude\n0,0,0,1," << amplitude << "\n";
    }
    double amplitude(const GaussianFrames &frames, double frame) { return frames.at(frame)->at(0).amplitude; }
    std::string path(const std::string &name) { return (folder_ / name).string(); }

private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "brume_gaussian_frames";
};

TEST_F(GaussianFramesTest, AreReadByFrame)
{
    write("a.0001.csv", 0.5);
    write("a.0002.csv", 0.25);
    write("a.-003.csv", 2);
    for (const char *name : {"a.%04d.csv", "a.####.csv", "a.#.csv"}) {
        const GaussianFrames frames(path(name));
        EXPECT_EQ(amplitude(frames, 1), 0.5);
        EXPECT_EQ(amplitude(frames, 2), 0.25);
        EXPECT_EQ(amplitude(frames, 1.75), 0.5);
        EXPECT_EQ(amplitude(frames, -2.5), 2);
        EXPECT_EQ(failure([&] { frames.at(3); }).rfind("Gaussians of frame 3: " + path("a.0003.csv"), 0), 0u)
            << failure([&] { frames.at(3); });
    }
    EXPECT_EQ(failure([&] { GaussianFrames(path("#.csv")).at(1e300); }),
              "frame: 1e+300; expected a number from -1000000000 to 1000000000");
}

TEST_F(GaussianFramesTest, KeepTheLastFile)
{
    write("a.7.csv", 0.5);
    const GaussianFrames frames(path("a.%d.csv"));
    const auto first = frames.at(7);
    write("a.7.csv", 0.25);
    EXPECT_EQ(frames.at(7), first);
    write("a.8.csv", 1);
    frames.at(8);
    EXPECT_EQ(amplitude(frames, 7), 0.25);
}

TEST_F(GaussianFramesTest, KnowFrameNumbers)
{
    for (const char *name : {"a.%04d.csv", "a%d", "#", "100%/a.###.csv", "%5/%2d.ply"})
        EXPECT_TRUE(GaussianFrames::has_frame_number(name)) << name;
    for (const char *name : {"a.csv", "%", "a%", "50%.csv", "%04", "%0004d"})
        EXPECT_FALSE(GaussianFrames::has_frame_number(name)) << name;
    EXPECT_EQ(failure([] { GaussianFrames::has_frame_number("%04d/a.####.csv"); }),
              "%04d/a.####.csv: more than one frame number in the name; expected one");
}

}  // namespace
}  // namespace brume
