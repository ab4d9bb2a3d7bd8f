// The engine of samples/ogre: what it draws, what Brume makes of that, and that it does not notice.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include "engine.h"
#include "host_state.h"

namespace {

constexpr int width = 160, height = 90;

std::vector<float> pixels(const Ogre::TexturePtr &texture, GLenum layout, size_t channels)
{
    const brume_image image = texture_image(texture, 1);
    std::vector<float> all(size_t(image.width) * size_t(image.height) * channels);
    glGetTextureImage(image.gl_texture, 0, layout, GL_FLOAT, GLsizei(all.size() * sizeof(float)), all.data());
    return all;
}

brume_image memory(std::vector<float> &pixels, const Ogre::TexturePtr &texture, uint32_t channels)
{
    return brume::image(pixels.data(), int32_t(texture->getWidth()), int32_t(texture->getHeight()), channels);
}

float red(const std::vector<float> &picture, int x, int y)
{
    return picture[size_t(y * width + x) * 4];
}

// OGRE makes one root in a process.
class OgreSample : public testing::Test {
protected:
    static void SetUpTestSuite() { engine = std::make_unique<Engine>(width, height); }
    static void TearDownTestSuite() { engine.reset(); }

    static std::vector<float> clear_frame(float time)
    {
        engine->move(time);
        engine->draw();
        return pixels(engine->color(), GL_RGBA, 4);
    }
    static std::vector<float> on_cpu(std::vector<float> color)
    {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.backend = BRUME_BACKEND_CPU;
        brume::Plan plan(fog_scene(brume::Context(desc), engine->camera(), engine->lamps()),
                         fog_format(engine->color(), engine->camera()));
        std::vector<float> depth = pixels(engine->depth(), GL_DEPTH_COMPONENT, 1);
        const Ogre::TexturePtr map = engine->lamps()[1].shadow;
        std::vector<float> shadow = pixels(map, GL_DEPTH_COMPONENT, 1), output(color.size());
        const brume_image color_image = memory(color, engine->color(), 4), depth_image = memory(depth, engine->depth(), 1),
                          map_image = memory(shadow, map, 1), output_image = memory(output, engine->color(), 4);
        brume_layer layer = BRUME_LAYER_INIT;
        layer.name = "shadow";
        layer.image = &map_image;
        layer.light = 1;
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &color_image;
        frame.depth = &depth_image;
        frame.output = &output_image;
        frame.inputs = &layer;
        frame.input_count = 1;
        plan.execute(frame);
        return output;
    }

    static std::unique_ptr<Engine> engine;
};
std::unique_ptr<Engine> OgreSample::engine;

TEST_F(OgreSample, FogsFramesThatMoveAsTheCpuDoes)
{
    engine->move(0);
    Fog fog(engine->color(), engine->depth(), engine->camera(), engine->lamps());
    const std::string device = reinterpret_cast<const char *>(glGetString(GL_RENDERER));
    const double bound = device.find("llvmpipe") != std::string::npos ? 2e-3 : 1e-2;
    std::vector<float> first;
    for (float time : {0.0f, 2.0f}) {
        const std::vector<float> clear = clear_frame(time), expected = on_cpu(clear);
        engine->target().addListener(&fog);
        engine->draw();
        engine->target().removeListener(&fog);
        const std::vector<float> fogged = pixels(engine->color(), GL_RGBA, 4);
        EXPECT_NE(fogged, first);
        first = fogged;

        // The sky at night is far away, and brightens; the lantern's globe dims.
        EXPECT_GT(red(fogged, 10, 10), 4 * red(clear, 10, 10));
        EXPECT_LT(*std::max_element(fogged.begin(), fogged.end()), 0.9f * *std::max_element(clear.begin(), clear.end()));

        double mean = 0;
        for (float value : expected)
            mean += value / double(expected.size());
        int apart = 0;
        for (size_t i = 0; i < fogged.size(); ++i)
            apart += std::abs(fogged[i] - expected[i]) > bound * (std::abs(expected[i]) + 0.1 * mean);
        // Shadows end between two pixels, and rounding decides whose a pixel on the border is.
        EXPECT_LE(apart, int(fogged.size() / 1000)) << "of " << fogged.size();
    }
}

TEST_F(OgreSample, EngineDoesNotNotice)
{
    const std::vector<float> clear = clear_frame(1), next = clear_frame(1.5f);
    const brume::test::HostState before = brume::test::read_state(false);
    {
        Fog fog(engine->color(), engine->depth(), engine->camera(), engine->lamps());
        fog.postRenderTargetUpdate({});
        EXPECT_EQ(brume::test::difference(before, brume::test::read_state(false)), "");
        EXPECT_NE(pixels(engine->color(), GL_RGBA, 4), next);
        EXPECT_EQ(clear_frame(1), clear);
        fog.postRenderTargetUpdate({});
        EXPECT_EQ(clear_frame(1.5f), next);
    }
    EXPECT_EQ(clear_frame(1), clear);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

}  // namespace
