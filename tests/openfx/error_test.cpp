// What cannot be rendered fails, and says which parameter or clip, its value and what was expected; then works again.
#include <cmath>
#include <cstdio>
#include <fstream>

#include "scene.h"

namespace {

using host::Bundle;
using host::Instance;
using host::Picture;

constexpr ofx::RectI whole{0, 0, 32, 24};

class OpenFXErrors : public testing::Test {
protected:
    OpenFXErrors()
    {
        scene::paint(source);
        scene::paint_depth(depth);
        instance.connect("Source", source);
        instance.connect("Depth", depth);
        instance.connect("Output", output);
    }

    void expect_error(const std::string &part)
    {
        EXPECT_EQ(instance.render(whole), ofx::failed);
        EXPECT_NE(instance.effect.error.find(part), std::string::npos) << instance.effect.error;
        EXPECT_EQ(source.handed_out + depth.handed_out + output.handed_out, 0) << "images were not given back";
        EXPECT_EQ(instance.identity(), "");
    }

    Bundle bundle;
    Picture source{whole, 4}, depth{whole, 3}, output{whole, 4};
    Instance instance{bundle, ofx::context::general};
};

TEST_F(OpenFXErrors, DepthIsNotConnected)
{
    instance.effect.clips.at("Depth").properties.put<int>(ofx::property::connected, {0});
    expect_error("Depth: not connected; expected");
    instance.connect("Depth", depth);
    EXPECT_EQ(instance.render(whole), ofx::ok);
    EXPECT_EQ(instance.effect.error, "") << "the error is still shown";
    scene::expect_fogged(output, source, depth, 0);
}

// What hosts ask of a node before it is whole must not fail: some give it up then.
TEST_F(OpenFXErrors, QuestionsBeforeItIsWhole)
{
    const Instance fresh(bundle, ofx::context::general);
    host::Set in, out;
    in.put<double>(ofx::property::time, {0});
    EXPECT_EQ(bundle.act(ofx::action::region_of_definition, &fresh.effect, &in, &out), ofx::reply_default);
    EXPECT_EQ(bundle.act(ofx::action::regions_of_interest, &fresh.effect, &in, &out), ofx::ok);
    EXPECT_EQ(bundle.act(ofx::action::clip_preferences, &fresh.effect, nullptr, &out), ofx::ok);
    EXPECT_EQ(out.get<int>(ofx::property::frame_varying), 0);
    EXPECT_EQ(fresh.identity(), "");
    fresh.effect.parameters.at("sceneFile").text = "/nowhere.json";
    EXPECT_EQ(bundle.act(ofx::action::clip_preferences, &fresh.effect, nullptr, &out), ofx::ok);
    EXPECT_EQ(out.get<int>(ofx::property::frame_varying), 1);
    EXPECT_EQ(fresh.effect.error, "");
}

TEST_F(OpenFXErrors, IdentityWithdrawsAnError)
{
    instance.set("visibility", {0});
    expect_error("Visibility");
    instance.set("visibility", {100});
    instance.set("scattering", {0, 0, 0});
    EXPECT_EQ(instance.identity(), "Source");
    EXPECT_EQ(instance.effect.error, "");
}

TEST_F(OpenFXErrors, NoImage)
{
    instance.effect.clips.at("Depth").picture = nullptr;
    expect_error("Depth: the host has no image");
}

TEST_F(OpenFXErrors, ParametersOutOfRange)
{
    instance.set("anisotropy", {1.5});
    expect_error("Anisotropy: 1.5; expected -1 to 1");
    instance.set("anisotropy", {0});
    instance.set("visibility", {0});
    expect_error("Visibility: 0; expected 0.001 to");
    instance.set("visibility", {std::nan("")});
    expect_error("Visibility: nan; expected");
    instance.set("visibility", {100});
    instance.set("absorption", {0, -1, 0});
    expect_error("Absorbs: -1; expected 0 to");
    instance.set("absorption", {0, 0, 0});
    instance.set("depthChannel", {3});
    expect_error("Depth channel: Alpha; Depth has 3 channels");
}

TEST_F(OpenFXErrors, FilterWithoutAlpha)
{
    Picture rgb(whole, 3);
    Instance filter(bundle, ofx::context::filter);
    filter.connect("Source", rgb);
    filter.connect("Output", rgb);
    EXPECT_EQ(filter.render(whole), ofx::failed);
    EXPECT_EQ(filter.effect.error, "Depth channel: Alpha; Source has 3 channels");
}

TEST_F(OpenFXErrors, PixelsOfOtherTypes)
{
    source.depth = ofx::pixels::byte;
    expect_error("Source: pixels of OfxBitDepthByte; expected OfxBitDepthFloat");
    source.depth = ofx::pixels::floating;
    Picture alpha(whole, 1);
    instance.connect("Output", alpha);
    expect_error("Output: components Alpha; expected RGBA or RGB");
}

TEST_F(OpenFXErrors, SceneFiles)
{
    EXPECT_EQ(instance.created, ofx::ok);
    instance.set_text("sceneFile", std::string("/nowhere/100%s%n.json"));
    expect_error("Scene file: \"/nowhere/100%s%n.json\": No such file");
    const std::string path = testing::TempDir() + "openfx_broken.json";
    std::ofstream(path) << "{\n  \"brume\": 1, \"medium\": { \"visibilty\": 3 } }";
    instance.set_text("sceneFile", path);
    expect_error("openfx_broken.json:2:");
    expect_error("visibility");
    std::ofstream(path)
        << R"({"brume": 1, "medium": {"visibility": 30}, "camera": {"camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}})";
    expect_error("a pose and no field of view");
    std::remove(path.c_str());
    instance.set_text("sceneFile", std::string());
    EXPECT_EQ(instance.render(whole), ofx::ok);
}

TEST(OpenFXHosts, WithoutMessagesAndThreads)
{
    const Bundle bare({.messages = false, .threads = false});
    Picture source(whole, 4), depth(whole, 1), output(whole, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    Instance instance(bare, ofx::context::general);
    EXPECT_EQ(instance.created, ofx::ok);
    EXPECT_EQ(instance.render(whole), ofx::failed) << "nothing is connected";
    instance.connect("Source", source);
    instance.connect("Depth", depth);
    instance.connect("Output", output);
    EXPECT_EQ(instance.render(whole), ofx::ok);
    scene::expect_fogged(output, source, depth, 0);
}

}  // namespace
