// What the bundle says of itself, and how it is loaded.
#include <atomic>
#include <thread>

#include "scene.h"

namespace {

using host::Bundle;
using host::Instance;
using host::Picture;
using Strings = std::vector<std::string>;

TEST(OpenFX, SaysWhatItIs)
{
    const Bundle bundle;
    ASSERT_EQ(bundle.loaded, ofx::ok);
    EXPECT_STREQ(bundle.plugin->api, ofx::api);
    EXPECT_EQ(bundle.plugin->api_version, 1);
    EXPECT_STREQ(bundle.plugin->identifier, "org.brume.fog");
    const host::Effect general = bundle.describe(ofx::context::general);
    EXPECT_EQ(general.properties.strings(ofx::property::supported_contexts),
              (Strings{ofx::context::general, ofx::context::filter}));
    EXPECT_EQ(general.properties.strings(ofx::property::supported_depths), Strings{ofx::pixels::floating});
    EXPECT_EQ(general.properties.strings(ofx::property::thread_safety), Strings{ofx::property::instance_safe});
    EXPECT_EQ(general.properties.get<int>(ofx::property::tiles), 0);
    EXPECT_EQ(general.order, (Strings{"Source", "Depth", "Output"}));
    EXPECT_EQ(general.clips.at("Depth").properties.strings(ofx::property::supported_components),
              (Strings{ofx::pixels::rgba, ofx::pixels::rgb, ofx::pixels::alpha}));
    EXPECT_EQ(bundle.describe(ofx::context::filter).order, (Strings{"Source", "Output"}));
}

TEST(OpenFX, ParametersHaveLabelsHintsAndDefaults)
{
    const Bundle bundle;
    const host::Effect general = bundle.describe(ofx::context::general), filter = bundle.describe(ofx::context::filter);
    Strings names;
    for (const auto &[name, parameter] : general.parameters)
        if (parameter.type != ofx::type::group) {
            names.push_back(name);
            EXPECT_FALSE(parameter.properties.get<std::string>(ofx::property::label).empty()) << name;
            EXPECT_FALSE(parameter.properties.get<std::string>(ofx::property::hint).empty()) << name;
            EXPECT_EQ(general.parameters.at(parameter.properties.get<std::string>(ofx::property::parent)).type,
                      ofx::type::group)
                << name;
        }
    EXPECT_EQ(names, (Strings{"absorption", "anisotropy", "cameraHeight", "cameraTilt", "depthChannel", "depthKind",
                              "depthScale", "far", "heightFalloff", "near", "quality", "scattering", "sceneFile", "sky",
                              "skyDistance", "verticalFov", "visibility"}));
    EXPECT_EQ(general.parameters.at("visibility").properties.get<double>(ofx::property::initial), 150);
    EXPECT_EQ(general.parameters.at("depthKind").properties.strings(ofx::property::option).at(BRUME_DEPTH_DEVICE), "Device");
    EXPECT_EQ(general.parameters.at("depthChannel").properties.get<int>(ofx::property::initial), 0);
    EXPECT_EQ(filter.parameters.at("depthChannel").properties.get<int>(ofx::property::initial), 3);
}

TEST(OpenFX, HostWithoutParametersIsRefused)
{
    EXPECT_EQ(Bundle({.parameters = false}).loaded, ofx::missing_host_feature);
}

TEST(OpenFX, ActionsUnknownToItAreLeftToTheHost)
{
    const Bundle bundle;
    const Instance instance(bundle, ofx::context::general);
    EXPECT_EQ(bundle.act("OfxActionOfAnotherYear", &instance.effect), ofx::reply_default);
    EXPECT_EQ(bundle.act(ofx::action::begin_sequence, &instance.effect), ofx::reply_default);
    EXPECT_EQ(bundle.act(ofx::action::purge_caches, &instance.effect), ofx::ok);
}

// glibc keeps a library for as long as a thread lives that it has variables in, and looks again when something is closed.
TEST(OpenFX, IsUnloadedAndGivesTheSameAgain)
{
    const ofx::RectI bounds{0, 0, 48, 36};
    Picture source(bounds, 4), depth(bounds, 1), output(bounds, 4);
    scene::paint(source);
    scene::paint_depth(depth);
    for (int round = 0; round < 3; ++round) {
        std::thread([&] {
            const Bundle bundle;
            Instance instance(bundle, ofx::context::general);
            instance.connect("Source", source);
            instance.connect("Depth", depth);
            instance.connect("Output", output);
            output.at(3, 3, 0) = -1;
            EXPECT_EQ(instance.render(bounds), ofx::ok) << instance.effect.error;
        }).join();
        scene::expect_fogged(output, source, depth, 0);
        {
            const Bundle other;
        }
        EXPECT_FALSE(Bundle::is_mapped());
    }
}

TEST(OpenFX, InstancesRenderAtOnce)
{
    const Bundle bundle;
    const auto render = [&](double visibility) {
        const ofx::RectI bounds{0, 0, 96, 72};
        Picture source(bounds, 4), depth(bounds, 1), output(bounds, 4);
        scene::paint(source);
        scene::paint_depth(depth);
        Instance instance(bundle, ofx::context::general);
        instance.set("visibility", {visibility});
        instance.connect("Source", source);
        instance.connect("Depth", depth);
        instance.connect("Output", output);
        scene::World world;
        for (double &sigma : world.medium.scattering)
            sigma = 3.912 / visibility;
        for (int frame = 0; frame < 4; ++frame) {
            EXPECT_EQ(instance.render(bounds, frame), ofx::ok) << instance.effect.error;
            scene::expect_fogged(output, source, depth, 0, world);
        }
    };
    std::thread other(render, 40.);
    render(300);
    other.join();
}

}  // namespace
