// brume.hpp, compiled as C++17.
#include <vector>

#include <gtest/gtest.h>

#include <brume/brume.hpp>
#include <brume/brume_media.hpp>

namespace {

brume::Context cpu()
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    return brume::Context(desc);
}

const char *const text = R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"absorption": 0.1}})";

}  // namespace

TEST(Hpp, FogsAnImage)
{
    brume::Context context = cpu();
    EXPECT_EQ(context.info().backend, BRUME_BACKEND_CPU);
    brume_format format = brume::format(2, 2);
    format.depth_kind = BRUME_DEPTH_RAY;
    brume::Plan plan(brume::Scene(context, text, "fog.json"), format);
    EXPECT_EQ(plan.info().does_nothing, 0u);
    const auto entries = plan.entries();
    ASSERT_EQ(entries.size(), plan.info().entry_count);
    EXPECT_STREQ(entries.back().name, "compose");
    const std::vector<float> color(16, 1), depth(4, 10);
    std::vector<float> output(16);
    plan.execute(brume::image(color.data(), 2, 2, 4), brume::image(depth.data(), 2, 2, 1),
                 brume::image(output.data(), 2, 2, 4));
    EXPECT_NEAR(output[0], 0.36787944, 1e-6);
    EXPECT_EQ(output[3], 1.0f);
    EXPECT_GE(plan.entries().back().measured_ms, 0);

    const std::vector<std::uint16_t> half(16, 0x3c00);
    std::vector<std::uint16_t> half_output(16);
    plan.execute(brume::half_image(half.data(), 2, 2, 4), brume::image(depth.data(), 2, 2, 1),
                 brume::half_image(half_output.data(), 2, 2, 4));
    EXPECT_EQ(half_output[0], 0x35e3);
}

TEST(Hpp, FailuresAreExceptions)
{
    brume::Context context = cpu();
    try {
        brume::Scene scene(context, "{", "broken.json");
        FAIL();
    } catch (const brume::Error &error) {
        EXPECT_EQ(error.status(), BRUME_ERROR_SCENE);
        EXPECT_NE(std::string(error.what()).find("broken.json:1"), std::string::npos) << error.what();
    }
    try {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.threads = 5000;
        brume::Context none(desc);
        FAIL();
    } catch (const brume::Error &error) {
        EXPECT_EQ(error.status(), BRUME_ERROR_ARGUMENT);
        EXPECT_NE(std::string(error.what()).find("threads"), std::string::npos) << error.what();
    }
    brume::Scene scene(context);
    EXPECT_THROW(scene.set("multiscatter", "levels", "many"), brume::Error);
    EXPECT_THROW(scene.set("multiscatter", "nothing", 1), brume::Error);
    EXPECT_THROW(scene.add_effect("nothing"), brume::Error);
    EXPECT_THROW(brume::Plan(scene, brume::format(0, 0)), brume::Error);
    EXPECT_THROW(context.parameters("nothing"), brume::Error);
}

TEST(Hpp, SetsAScene)
{
    brume::Context context = cpu();
    brume::Scene scene(context);
    EXPECT_EQ(scene.camera_given(), 0u);
    brume_camera camera = BRUME_CAMERA_INIT;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW;
    scene.set_camera(camera);
    EXPECT_EQ(scene.camera_given(), BRUME_CAMERA_FIELD_OF_VIEW);
    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.scattering[0] = 0.1;
    scene.set_medium(medium);
    scene.set_metres_per_unit(0.01);
    scene.set_luminance_weights(0.3, 0.6, 0.1);
    scene.set("multiscatter", "kernel_size", "6x6");
    scene.set("multiscatter", "masking", false);
    EXPECT_FALSE(brume::Plan(scene, brume::format(32, 32)).info().does_nothing);
    scene.set_medium(medium, std::vector<brume_gaussian>(3, brume_gaussian BRUME_GAUSSIAN_INIT));
    EXPECT_THROW(scene.set_medium(medium, std::vector<brume_gaussian>(3)), brume::Error);
    scene.set_lights(std::vector<brume_light>(2, brume_light BRUME_LIGHT_INIT));
    scene.set_lights({});
    scene.set_environment({{1, 1, 1}});
    scene.set_environment({});
    EXPECT_THROW(scene.set_environment({{1, 1, 1}, {1, 1, 1}}), brume::Error);
    EXPECT_EQ(scene.environment_file(), "");
    EXPECT_EQ(scene.info().gaussian_count, 3u);
    scene.remove_medium();
    EXPECT_TRUE(brume::Plan(scene, brume::format(32, 32)).info().does_nothing);
}

TEST(Hpp, Describes)
{
    brume::Context context = cpu();
    ASSERT_FALSE(context.effects().empty());
    EXPECT_FALSE(context.parameters("multiscatter").empty());
    EXPECT_EQ(context.scene_schema().front(), '{');
}

// Handles move, and the last one that needs it keeps the context.
TEST(Hpp, HandlesOwn)
{
    std::vector<brume::Plan> plans;
    {
        brume::Context context = cpu();
        brume::Scene scene(context, text);
        brume::Scene moved = std::move(scene);
        plans.emplace_back(moved, brume::format(4, 4));
        plans.emplace_back(moved, brume::format(8, 8));
    }
    EXPECT_GE(plans[1].info().entry_count, 1u);
    plans.erase(plans.begin());
    EXPECT_THROW(plans[0].execute(brume_frame BRUME_FRAME_INIT), brume::Error);
}

TEST(Hpp, UpdatesAPlan)
{
    brume::Context context = cpu();
    brume_format format = brume::format(2, 2);
    format.depth_kind = BRUME_DEPTH_RAY;
    brume::Plan plan(brume::Scene(context, text), format);
    const brume::Scene thin(context, R"({"brume": 1, "camera": {"vertical_fov": 50}, "medium": {"absorption": 0.05}})");
    const std::vector<float> color(16, 1), depth(4, 10);
    std::vector<float> output(16);
    plan.update(thin);
    plan.execute(brume::image(color.data(), 2, 2, 4), brume::image(depth.data(), 2, 2, 1),
                 brume::image(output.data(), 2, 2, 4));
    EXPECT_NEAR(output[0], 0.60653066, 1e-6);
    format.far_distance = 5;
    plan.update(thin, format);
    plan.execute(brume::image(color.data(), 2, 2, 4), brume::image(depth.data(), 2, 2, 1),
                 brume::image(output.data(), 2, 2, 4));
    EXPECT_EQ(output[0], 0);
    EXPECT_THROW(plan.update(brume::Scene(context, R"({"brume": 1})")), brume::Error);
    context.trim();
}

TEST(Hpp, ListsLayers)
{
    brume::Context context = cpu();
    EXPECT_FALSE(context.layers("multiscatter").empty());
    EXPECT_FALSE(context.library_layers().empty());
    EXPECT_TRUE(context.layers("nothing").empty());
    const brume_layer light = brume::layer("light_airlight", nullptr, 3);
    EXPECT_STREQ(light.name, "light_airlight");
    EXPECT_EQ(light.light, 3u);
}

TEST(Hpp, MakesMedia)
{
    brume::Context context = cpu();
    brume::Media media(context);
    EXPECT_TRUE(media.gaussians().empty());
    EXPECT_TRUE(media.selection().empty());
    media.put(std::vector<brume_gaussian>(2, brume_gaussian BRUME_GAUSSIAN_INIT));
    media.select_all();
    EXPECT_EQ(media.selection(), std::vector<std::uint8_t>(2, 1));
    media.copy();
    media.paste({1, 2, 3});
    ASSERT_EQ(media.gaussians().size(), 4u);
    EXPECT_EQ(media.gaussians()[3].center[2], 3);
    brume::Media again(context);
    again.replay(media.journal());
    EXPECT_EQ(again.gaussians().size(), 4u);
    media.remove();
    EXPECT_EQ(media.info().gaussian_count, 2u);
    media.undo();
    EXPECT_EQ(media.info().gaussian_count, 4u);
    media.redo();
    EXPECT_THROW(media.redo(), brume::Error);
    EXPECT_THROW(media.load("/nowhere/media.csv"), brume::Error);
}
