// Frames in the host's textures, against those on the CPU.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>

#include "host_context.h"
#include "host_state.h"
#include "scene.h"

namespace {

using brume::test::HostContext;
using host::Bundle;
using host::Instance;
using host::Picture;

constexpr ofx::RectI whole{0, 0, 64, 48};
constexpr unsigned rectangle = GL_TEXTURE_RECTANGLE;

class OpenFXGl : public testing::Test {
protected:
    OpenFXGl()
    {
        scene::paint(source);
        for (int channel = 0; channel < 4; ++channel)
            scene::paint_depth(depth, channel);
        connect(instance);
    }

    void connect(Instance &with)
    {
        with.connect("Source", source);
        with.connect("Depth", depth);
        with.connect("Output", output);
    }

    ofx::Status attach(Instance &with) { return bundle.act(ofx::action::gl_attached, &with.effect); }
    ofx::Status detach(Instance &with) { return bundle.act(ofx::action::gl_detached, &with.effect); }

    ofx::Status render(Instance &with, bool on_gl)
    {
        with.on_gl = on_gl;
        const ofx::Status status = with.render(output.bounds);
        EXPECT_EQ(source.handed_out + depth.handed_out + output.handed_out, 0) << "images were not given back";
        EXPECT_EQ(with.effect.error, "");
        return status;
    }

    // Rendered on GL, then on the CPU: the same within GL's bound.
    void expect_as_on_the_cpu(Instance &with)
    {
        clear();
        const int before = output.textures;
        ASSERT_EQ(render(with, true), ofx::ok);
        EXPECT_EQ(output.textures, before + 1);
        Picture on_gl = output;
        clear();
        ASSERT_EQ(render(with, false), ofx::ok);
        EXPECT_EQ(output.textures, before + 1) << "the CPU's frame asked for textures";
        const bool software = std::strstr(reinterpret_cast<const char *>(glGetString(GL_RENDERER)), "llvmpipe");
        double worst = 0;
        bool changed = false;
        for (int y = output.bounds.y1; y < output.bounds.y2; ++y)
            for (int x = output.bounds.x1; x < output.bounds.x2; ++x)
                for (int c = 0; c < output.channels; ++c) {
                    const double a = on_gl.at(x, y, c), b = output.at(x, y, c);
                    const double error = std::abs(a - b) / std::max(std::abs(b), .05);
                    worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
                    changed |= std::abs(b - source.at(x, y, c)) > .01;
                }
        EXPECT_LT(worst, software ? 2e-3 : 1e-2);
        EXPECT_TRUE(changed) << "there is no fog in it";
    }

    void expect_left_to_the_cpu()
    {
        EXPECT_EQ(render(instance, true), ofx::gl_render_failed);
        EXPECT_EQ(render(instance, false), ofx::ok);
    }

    void clear()
    {
        for (int y = output.bounds.y1; y < output.bounds.y2; ++y)
            for (int x = output.bounds.x1; x < output.bounds.x2; ++x)
                for (int c = 0; c < output.channels; ++c)
                    output.at(x, y, c) = -9;
    }

    std::optional<HostContext> context{std::in_place};
    Bundle bundle{{.gl = true}};
    Picture source{whole, 4}, depth{whole, 4}, output{whole, 4};
    Instance instance{bundle, ofx::context::general};
};

TEST_F(OpenFXGl, IsDeclaredWhereTheHostHasIt)
{
    const host::Effect described = bundle.describe(ofx::context::general);
    EXPECT_EQ(described.properties.get<std::string>(ofx::property::gl_supported), "true");
    EXPECT_EQ(described.properties.strings(ofx::property::gl_depths), std::vector<std::string>{ofx::pixels::floating});
}

TEST(OpenFXWithoutGlSuite, IsNotDeclaredAndFallsBack)
{
    const Bundle bundle;
    EXPECT_EQ(bundle.describe(ofx::context::general).properties.values.count(ofx::property::gl_supported), 0u);
    Instance instance(bundle, ofx::context::general);
    instance.on_gl = true;
    EXPECT_EQ(instance.render(whole), ofx::gl_render_failed);
}

TEST_F(OpenFXGl, IsAsOnTheCpu)
{
    ASSERT_EQ(attach(instance), ofx::ok);
    for (int channel = 0; channel < 4; ++channel) {
        SCOPED_TRACE(channel);
        for (int other = 0; other < 4; ++other)
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 64; ++x)
                    depth.at(x, y, other) = 1;
        scene::paint_depth(depth, channel);
        instance.set("depthChannel", {double(channel)});
        expect_as_on_the_cpu(instance);
    }
    EXPECT_EQ(detach(instance), ofx::ok);
}

// Height falloff would show a picture that is upside down, and a project that lies elsewhere.
TEST_F(OpenFXGl, ScaleProjectAndHeight)
{
    instance.set("heightFalloff", {.1});
    instance.scale = {.5, .5};
    instance.project(10, 20, 80, 60);
    connect(instance);
    expect_as_on_the_cpu(instance);
    source.aspect = depth.aspect = output.aspect = 2;
    instance.scale = {.25, .5};
    connect(instance);
    expect_as_on_the_cpu(instance);
}

TEST_F(OpenFXGl, DepthOfOneOrThreeChannels)
{
    for (int channels : {1, 3}) {
        SCOPED_TRACE(channels);
        Picture fewer(whole, channels);
        scene::paint_depth(fewer, channels - 1);
        instance.set("depthChannel", {2});
        instance.connect("Depth", fewer);
        expect_as_on_the_cpu(instance);
    }
}

TEST_F(OpenFXGl, FilterFindsDepthInAlpha)
{
    scene::paint_depth(source, 3);
    Instance filter(bundle, ofx::context::filter);
    filter.connect("Source", source);
    filter.connect("Output", output);
    expect_as_on_the_cpu(filter);
}

TEST_F(OpenFXGl, WhatItCannotDoIsLeftToTheCpu)
{
    depth.target = rectangle;
    expect_left_to_the_cpu();
    depth.target = GL_TEXTURE_2D;
    output.format = GL_RGBA8;
    expect_left_to_the_cpu();
    output.format = 0;
    const std::string file = testing::TempDir() + "openfx_reference.json";
    std::ofstream(file)
        << R"({"brume": 1, "medium": {"visibility": 150}, "effects": {"multiscatter": {"kernel": "paper_reference"}}})";
    instance.set_text("sceneFile", file);
    expect_left_to_the_cpu();
    std::remove(file.c_str());
    instance.set_text("sceneFile", "");
    expect_as_on_the_cpu(instance);
}

TEST_F(OpenFXGl, RegionsThatDifferAreLeftToTheCpu)
{
    const ofx::RectI elsewhere{2, 0, 66, 48};
    Picture distance(elsewhere, 1), wanted(elsewhere, 4);
    instance.connect("Depth", distance);
    expect_left_to_the_cpu();
    instance.connect("Depth", depth);
    instance.connect("Output", wanted);
    instance.on_gl = true;
    EXPECT_EQ(instance.render(whole), ofx::gl_render_failed);
    instance.connect("Output", output);
    EXPECT_EQ(instance.render({0, 0, 64, 40}), ofx::gl_render_failed);
    expect_as_on_the_cpu(instance);
}

TEST_F(OpenFXGl, DepthNeedsNoMipmaps)
{
    depth.mipmapped = false;
    expect_as_on_the_cpu(instance);
}

TEST_F(OpenFXGl, PixelsOfHalvesAreNotTaken)
{
    source.depth = ofx::pixels::half;
    EXPECT_EQ(render(instance, true), ofx::gl_render_failed);
}

TEST_F(OpenFXGl, AbortIsHeard)
{
    instance.effect.abort_at = 1;
    EXPECT_EQ(render(instance, true), ofx::ok);
    instance.effect.abort_at = 0;
    expect_as_on_the_cpu(instance);
}

TEST_F(OpenFXGl, StateOfTheHostIsPutBack)
{
    brume::test::dirty_state(false);
    const auto before = brume::test::read_state(false);
    ASSERT_EQ(attach(instance), ofx::ok);
    EXPECT_EQ(brume::test::difference(before, brume::test::read_state(false)), "") << "attaching";
    expect_as_on_the_cpu(instance);
    EXPECT_EQ(brume::test::difference(before, brume::test::read_state(false)), "") << "rendering";
    ASSERT_EQ(detach(instance), ofx::ok);
    EXPECT_EQ(brume::test::difference(before, brume::test::read_state(false)), "") << "detaching";
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

TEST_F(OpenFXGl, AnotherContextIsAttached)
{
    ASSERT_EQ(attach(instance), ofx::ok);
    expect_as_on_the_cpu(instance);
    ASSERT_EQ(bundle.act(ofx::action::gl_detached_as_documented, &instance.effect), ofx::ok);
    {
        const HostContext other;
        ASSERT_EQ(attach(instance), ofx::ok);
        expect_as_on_the_cpu(instance);
        context->make_current();
        expect_left_to_the_cpu();
        other.make_current();
        ASSERT_EQ(detach(instance), ofx::ok);
    }
    context->make_current();
    ASSERT_EQ(attach(instance), ofx::ok);
    expect_as_on_the_cpu(instance);
}

TEST_F(OpenFXGl, TwoContextsAtOnce)
{
    Instance second(bundle, ofx::context::general);
    connect(second);
    second.set("visibility", {40});
    ASSERT_EQ(attach(instance), ofx::ok);
    const HostContext other;
    ASSERT_EQ(attach(second), ofx::ok);
    for (int round = 0; round < 2; ++round) {
        other.make_current();
        expect_as_on_the_cpu(second);
        context->make_current();
        expect_as_on_the_cpu(instance);
    }
    other.make_current();
    EXPECT_EQ(detach(second), ofx::ok);
    context->make_current();
    EXPECT_EQ(detach(instance), ofx::ok);
}

TEST_F(OpenFXGl, WithoutAContextItFails)
{
    context->release();
    EXPECT_EQ(attach(instance), ofx::failed);
    context->make_current();
    EXPECT_EQ(attach(instance), ofx::ok);
}

TEST_F(OpenFXGl, ObjectsGoWithTheAttachment)
{
    const auto objects = [] {
        int count = 0;
        for (GLuint name = 1; name < 200; ++name)
            count += glIsTexture(name) + glIsProgram(name) + glIsSampler(name) + glIsProgramPipeline(name);
        return count;
    };
    const int before = objects();
    ASSERT_EQ(attach(instance), ofx::ok);
    expect_as_on_the_cpu(instance);
    EXPECT_GT(objects(), before);
    ASSERT_EQ(detach(instance), ofx::ok);
    EXPECT_EQ(objects(), before);
}

}  // namespace
