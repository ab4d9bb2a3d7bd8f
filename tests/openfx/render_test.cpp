// Frames as hosts give them are fogged as the C ABI fogs them, bit for bit.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "scene.h"

namespace {

using host::Bundle;
using host::Instance;
using host::Picture;
using scene::World;

constexpr ofx::RectI whole{0, 0, 64, 48};

class OpenFXRender : public testing::Test {
protected:
    Bundle bundle;

    // Renders all of the output.
    void render(Instance &instance, Picture &source, Picture *depth, Picture &output, double time = 0)
    {
        instance.connect("Source", source);
        if (depth)
            instance.connect("Depth", *depth);
        instance.connect("Output", output);
        ASSERT_EQ(instance.render(output.bounds, time), ofx::ok) << instance.effect.error;
        EXPECT_EQ(instance.effect.error, "");
        EXPECT_EQ(source.handed_out + output.handed_out + (depth ? depth->handed_out : 0), 0)
            << "images were not given back";
    }
};

TEST_F(OpenFXRender, ComponentsOfSourceAndDepth)
{
    for (int of_source : {4, 3})
        for (int of_depth : {4, 3, 1})
            for (int channel = 0; channel < of_depth; ++channel) {
                SCOPED_TRACE(testing::Message() << of_source << " and " << of_depth << " channels, depth in " << channel);
                Picture source(whole, of_source), depth(whole, of_depth), output(whole, of_source);
                scene::paint(source);
                scene::paint_depth(depth, channel);
                Instance instance(bundle, ofx::context::general);
                instance.set("depthChannel", {of_depth == 1 ? 2. : double(channel)});
                render(instance, source, &depth, output);
                scene::expect_fogged(output, source, depth, channel);
            }
}

TEST_F(OpenFXRender, OutputMayHaveOtherComponents)
{
    for (int of_source : {4, 3}) {
        Picture source(whole, of_source), depth(whole, 1), output(whole, 7 - of_source), same(whole, of_source);
        scene::paint(source);
        scene::paint_depth(depth);
        Instance instance(bundle, ofx::context::general);
        render(instance, source, &depth, same);
        render(instance, source, &depth, output);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x) {
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(output.at(x, y, c), same.at(x, y, c)) << x << ", " << y;
                ASSERT_EQ(output.at(x, y, output.channels - 1), of_source == 3 ? 1 : same.at(x, y, 2)) << "RGB is opaque";
            }
    }
}

TEST_F(OpenFXRender, FilterFindsDepthInAlpha)
{
    Picture source(whole, 4), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(source, 3);
    Instance instance(bundle, ofx::context::filter);
    render(instance, source, nullptr, output);
    scene::expect_fogged(output, source, source, 3);
}

// Height falloff would show a picture that is upside down.
TEST_F(OpenFXRender, RowsRunEitherWay)
{
    World world;
    world.term.falloff = .1;
    for (int layout = 0; layout < 8; ++layout) {
        SCOPED_TRACE(layout);
        Picture source(whole, 4, layout & 1, 5), depth(whole, 3, layout & 2, 2), output(whole, 4, layout & 4, 3);
        scene::paint(source);
        scene::paint_depth(depth);
        Instance instance(bundle, ofx::context::general);
        instance.set("heightFalloff", {.1});
        render(instance, source, &depth, output);
        scene::expect_fogged(output, source, depth, 0, world);
    }
}

TEST_F(OpenFXRender, ScaleAndAspectLeaveTheCameraAsItIs)
{
    World world;
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    for (const auto &[scale_x, scale_y, aspect] : {std::array{.5, .5, 1.}, {1., 1., 2.}, {.5, 1., 1.}, {.25, .5, 2.}}) {
        SCOPED_TRACE(testing::Message() << scale_x << ", " << scale_y << ", " << aspect);
        source.aspect = depth.aspect = output.aspect = aspect;
        Instance instance(bundle, ofx::context::general);
        instance.scale = {scale_x, scale_y};
        instance.project(0, 0, 64 * aspect / scale_x, 48 / scale_y);
        render(instance, source, &depth, output);
        world.camera.pixel_aspect = aspect * scale_y / scale_x;
        scene::expect_fogged(output, source, depth, 0, world);
    }
}

// The project is 40 x 30 pixels at half scale; the image hangs over it by 10 on the left, 14 on the right, 6 below, 12
// above.
TEST_F(OpenFXRender, FieldOfViewIsThatOfTheProject)
{
    const ofx::RectI bounds{-5, 4, 59, 52};
    Picture source(bounds, 4), depth(bounds, 1), output(bounds, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    instance.scale = {.5, .5};
    instance.project(10, 20, 80, 60);
    render(instance, source, &depth, output);
    World world;
    world.format.display_x = 10;
    world.format.display_y = 12;
    world.format.display_width = 40;
    world.format.display_height = 30;
    scene::expect_fogged(output, source, depth, 0, world);
}

TEST_F(OpenFXRender, OnlyTheWindowIsWritten)
{
    Picture source(whole, 4), depth(whole, 1), output({-4, -4, 70, 50}, 4), all(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    render(instance, source, &depth, all);
    scene::expect_fogged(all, source, depth, 0);
    for (int y = -4; y < 50; ++y)
        for (int x = -4; x < 70; ++x)
            output.at(x, y, 0) = -5;
    instance.connect("Output", output);
    const ofx::RectI window{-2, 10, 31, 20};
    ASSERT_EQ(instance.render(window), ofx::ok);
    for (int y = -4; y < 50; ++y)
        for (int x = -4; x < 70; ++x) {
            const bool inside = x >= window.x1 && x < window.x2 && y >= window.y1 && y < window.y2;
            ASSERT_EQ(output.at(x, y, 0), !inside ? -5 : x < 0 ? 0 : all.at(x, y, 0)) << x << ", " << y;
        }
}

TEST_F(OpenFXRender, CroppedDepthIsSkyBeyond)
{
    Picture source(whole, 4), depth({6, 3, 70, 40}, 4), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    render(instance, source, &depth, output);
    scene::expect_fogged(output, source, depth, 0);
}

TEST_F(OpenFXRender, ParametersAreTheLibrarys)
{
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    instance.set("visibility", {39.12});
    instance.set("scattering", {.5, .6, .7});
    instance.set("absorption", {.3, .2, .1});
    instance.set("anisotropy", {.3});
    instance.set("heightFalloff", {.05});
    instance.set("cameraHeight", {20});
    instance.set("cameraTilt", {-30});
    instance.set("verticalFov", {70});
    instance.set("depthScale", {.5});
    instance.set("depthKind", {BRUME_DEPTH_RAY});
    instance.set("sky", {BRUME_SKY_CLAMP});
    instance.set("skyDistance", {120});
    instance.set("quality", {BRUME_PRESET_DRAFT});
    World world;
    for (int i = 0; i < 3; ++i) {
        world.medium.scattering[i] = 3.912 / 39.12 * (.5 + .1 * i);
        world.medium.absorption[i] = 3.912 / 39.12 * std::array{.3, .2, .1}[size_t(i)];
        world.medium.scattering[i] = 3.912 / 39.12 * std::array{.5, .6, .7}[size_t(i)];
    }
    world.medium.g = .3;
    world.term.falloff = .05;
    world.term.origin[1] = -40;
    world.camera.vertical_fov = 70 * 3.14159265358979323846 / 180;
    const double c = std::cos(30 * 3.14159265358979323846 / 180), s = -std::sin(30 * 3.14159265358979323846 / 180);
    const double tilted[] = {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1};
    std::copy(std::begin(tilted), std::end(tilted), world.camera.camera_to_world);
    world.metres = .5;
    world.format.depth_kind = BRUME_DEPTH_RAY;
    world.format.sky = BRUME_SKY_CLAMP;
    world.format.sky_distance = 120;
    world.preset = BRUME_PRESET_DRAFT;
    render(instance, source, &depth, output);
    scene::expect_fogged(output, source, depth, 0, world);
}

TEST_F(OpenFXRender, DepthKindsHaveRanges)
{
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            depth.at(x, y, 0) = float(1 + (x + y) % 90) / 100;
    for (uint32_t kind : {BRUME_DEPTH_INVERSE, BRUME_DEPTH_NORMALIZED, BRUME_DEPTH_DEVICE}) {
        SCOPED_TRACE(kind);
        Instance instance(bundle, ofx::context::general);
        instance.set("depthKind", {double(kind)});
        instance.set("near", {80});
        instance.set("far", {2});
        World world;
        world.format.depth_kind = kind;
        world.format.depth_range[0] = 80;
        world.format.depth_range[1] = 2;
        render(instance, source, &depth, output);
        scene::expect_fogged(output, source, depth, 0, world);
    }
}

TEST_F(OpenFXRender, AnimationIsFollowed)
{
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    instance.effect.parameters.at("visibility").animated = [](double time) { return 50 + 10 * time; };
    instance.effect.parameters.at("heightFalloff").animated = [](double time) { return time < 5 ? 0 : .02 * time; };
    for (double time : {1., 2., 7., 8.}) {
        World world;
        world.term.falloff = time < 5 ? 0 : .02 * time;
        for (double &sigma : world.medium.scattering)
            sigma = 3.912 / (50 + 10 * time);
        render(instance, source, &depth, output, time);
        scene::expect_fogged(output, source, depth, 0, world);
    }
}

class SceneFile {
public:
    explicit SceneFile(const std::string &text, const std::string &name = "fog.json")
        : path(testing::TempDir() + "openfx_" + name)
    {
        std::ofstream(path) << text;
    }
    ~SceneFile() { std::remove(path.c_str()); }
    const std::string path;
};

TEST_F(OpenFXRender, SceneFileReplacesTheFog)
{
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    World world;
    world.text = R"({"brume": 1, "medium": {"visibility": {"keys": [[1, 20], [9, 100]]}, "g": 0.5}})";
    const SceneFile file(world.text);
    Instance instance(bundle, ofx::context::general);
    instance.set_text("sceneFile", file.path);
    for (double frame : {1., 9.}) {
        world.frame = frame;
        render(instance, source, &depth, output, frame);
        scene::expect_fogged(output, source, depth, 0, world);
    }
    // Written anew while the host has it open, and with a camera.
    world.text = R"({"brume": 1, "medium": {"visibility": 30}, "camera": {"vertical_fov": 90}})";
    std::ofstream(file.path) << world.text;
    render(instance, source, &depth, output, 9);
    scene::expect_fogged(output, source, depth, 0, world);
    // Each effect is in the bundle.
    world.text =
        R"({"brume": 1, "medium": {"visibility": 30}, "lights": [{"type": "point", "position": [0, 1, -9], "intensity": [9, 5, 2]}]})";
    std::ofstream(file.path) << world.text;
    render(instance, source, &depth, output, 9);
    scene::expect_fogged(output, source, depth, 0, world);
}

TEST_F(OpenFXRender, NothingToDoIsIdentity)
{
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    instance.connect("Source", source);
    EXPECT_EQ(instance.identity(), "");
    instance.set("scattering", {0, 0, 0});
    EXPECT_EQ(instance.identity(), "Source");
    render(instance, source, &depth, output);
    EXPECT_EQ(output.at(9, 9, 1), source.at(9, 9, 1));
    instance.effect.parameters.at("scattering").animated = [](double time) { return time < 5 ? 0 : 1; };
    EXPECT_EQ(instance.identity(4), "Source");
    EXPECT_EQ(instance.identity(6), "");
    render(instance, source, &depth, output, 6);
    scene::expect_fogged(output, source, depth, 0);
    EXPECT_EQ(instance.identity(4), "Source");
}

TEST_F(OpenFXRender, AbortIsAskedAndHeard)
{
    const ofx::RectI large{0, 0, 1920, 1080};
    Picture source(large, 4), depth(large, 1), output(large, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bundle, ofx::context::general);
    instance.set("visibility", {30});
    render(instance, source, &depth, output);
    const int polls = instance.effect.polls;
    EXPECT_GT(polls, 2) << "it is not asked while passes run";
    output.at(5, 5, 0) = -3;
    for (int at = 1; at <= 3; ++at) {
        instance.effect.polls = 0;
        instance.effect.abort_at = at;
        EXPECT_EQ(instance.render(large), ofx::ok);
        EXPECT_EQ(instance.effect.polls, at);
        EXPECT_EQ(instance.effect.error, "");
        EXPECT_EQ(output.at(5, 5, 0), -3) << "an aborted frame was written";
    }
    instance.effect.abort_at = 0;
    EXPECT_EQ(instance.render(large), ofx::ok);
    EXPECT_NE(output.at(5, 5, 0), -3);
}

TEST_F(OpenFXRender, RegionsAreWhole)
{
    Picture source({-3, 2, 61, 50}, 4), depth(whole, 1);
    Instance instance(bundle, ofx::context::general);
    instance.connect("Source", source);
    instance.connect("Depth", depth);
    host::Set in, out;
    in.put<double>(ofx::property::time, {0});
    ASSERT_EQ(bundle.act(ofx::action::region_of_definition, &instance.effect, &in, &out), ofx::ok);
    ASSERT_EQ(bundle.act(ofx::action::regions_of_interest, &instance.effect, &in, &out), ofx::ok);
    for (const char *name : {ofx::property::region_of_definition, "OfxImageClipPropRoI_Source"}) {
        EXPECT_EQ(out.get<double>(name, 0), -3) << name;
        EXPECT_EQ(out.get<double>(name, 3), 50) << name;
    }
    EXPECT_EQ(out.get<double>("OfxImageClipPropRoI_Depth", 2), 64);
}

}  // namespace
