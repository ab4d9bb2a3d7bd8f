// Contexts, messages, logging, lifetimes.
#include <thread>

#include "client.h"

using namespace client;

TEST(Version, IsTheHeaders)
{
    EXPECT_EQ(brume_version(), BRUME_VERSION_MAJOR * 10000u + BRUME_VERSION_MINOR * 100u + BRUME_VERSION_PATCH);
}

TEST(Status, NamesAreTheMacros)
{
    EXPECT_STREQ(brume_status_name(BRUME_OK), "BRUME_OK");
    EXPECT_STREQ(brume_status_name(BRUME_ERROR_ARGUMENT), "BRUME_ERROR_ARGUMENT");
    EXPECT_STREQ(brume_status_name(BRUME_ERROR_CAMERA), "BRUME_ERROR_CAMERA");
    EXPECT_STREQ(brume_status_name(BRUME_ERROR_INTERNAL), "BRUME_ERROR_INTERNAL");
    EXPECT_STREQ(brume_status_name(BRUME_ERROR_CANCELLED), "BRUME_ERROR_CANCELLED");
    for (brume_status unknown : {-1, 12, 4711, INT32_MAX, INT32_MIN})
        EXPECT_STREQ(brume_status_name(unknown), "BRUME_ERROR_UNKNOWN");
}

TEST(Context, DefaultsWithoutADescription)
{
    brume_context context = nullptr;
    ASSERT_EQ(brume_context_create(nullptr, &context), BRUME_OK) << message(nullptr);
    Context owned(context);
    brume_context_info info = BRUME_CONTEXT_INFO_INIT;
    ASSERT_EQ(brume_context_get_info(context, &info), BRUME_OK);
    EXPECT_TRUE(info.backend == BRUME_BACKEND_CPU || info.backend == BRUME_BACKEND_GL);
    EXPECT_STRNE(info.device, "");
    EXPECT_GE(info.threads, 1u);
}

#ifndef BRUME_GL
TEST(Context, SaysThatTheBuildHasNoGl)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_GL;
    brume_context context = nullptr;
    expect_status(nullptr, brume_context_create(&desc, &context), BRUME_ERROR_GL, "this build has no OpenGL backend");
    EXPECT_EQ(context, nullptr);
}
#endif

TEST(Context, CpuInfo)
{
    Context context = make_context(BRUME_BACKEND_CPU, 1);
    brume_context_info info = BRUME_CONTEXT_INFO_INIT;
    ASSERT_EQ(brume_context_get_info(context.get(), &info), BRUME_OK);
    EXPECT_EQ(info.backend, BRUME_BACKEND_CPU);
    EXPECT_STREQ(info.device, "CPU");
    EXPECT_EQ(info.threads, 1u);
    EXPECT_EQ(info.device_bytes, 0u);
    EXPECT_EQ(info.struct_size, sizeof info);

    // Not those asked for but those that run.
    Context all = make_context(BRUME_BACKEND_CPU, 0), too_many = make_context(BRUME_BACKEND_CPU, 1000);
    ASSERT_EQ(brume_context_get_info(all.get(), &info), BRUME_OK);
    const uint32_t most = info.threads;
    ASSERT_EQ(brume_context_get_info(too_many.get(), &info), BRUME_OK);
    EXPECT_EQ(info.threads, most);
}

TEST(Context, RefusesNonsense)
{
    struct Case {
        std::function<void(brume_context_desc &)> change;
        const char *named;
    };
    const Case cases[] = {
        {[](auto &d) { d.backend = 3; }, "backend"},
        {[](auto &d) { d.gl_context = 2; }, "gl_context"},
        {[](auto &d) { d.gl_state = 3; }, "gl_state"},
        {[](auto &d) { d.threads = 1025; }, "threads"},
        {[](auto &d) { d.log_level = 0; }, "log_level"},
        {[](auto &d) { d.log_level = 5; }, "log_level"},
        {[](auto &d) { d.plugin_directory = "lib/brume"; }, "plugin_directory"},
        {[](auto &d) { d.plugin_directory = "."; }, "plugin_directory"},
        {[](auto &d) { d.plugin_directory = ""; }, "plugin_directory"},
    };
    for (const Case &c : cases) {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.backend = BRUME_BACKEND_CPU;
        c.change(desc);
        auto context = reinterpret_cast<brume_context>(1);
        expect_status(nullptr, brume_context_create(&desc, &context), BRUME_ERROR_ARGUMENT, c.named);
        EXPECT_EQ(context, nullptr) << c.named;
    }
}

TEST(Null, DestroyIsNothing)
{
    brume_context_destroy(nullptr);
    brume_scene_destroy(nullptr);
    brume_plan_destroy(nullptr);
}

TEST(Null, HandlesAreNamed)
{
    brume_scene scene = nullptr;
    brume_plan plan = nullptr;
    brume_context_info context_info = BRUME_CONTEXT_INFO_INIT;
    brume_effect_info effect_info = BRUME_EFFECT_INFO_INIT;
    brume_parameter_info parameter_info = BRUME_PARAMETER_INFO_INIT;
    brume_medium medium = BRUME_MEDIUM_INIT;
    brume_camera camera = BRUME_CAMERA_INIT;
    brume_format format = ray_format(4, 4);
    brume_plan_info plan_info = BRUME_PLAN_INFO_INIT;
    brume_plan_entry plan_entry = BRUME_PLAN_ENTRY_INIT;
    brume_frame frame = BRUME_FRAME_INIT;
    const double weights[3] = {0.2, 0.7, 0.1};
    uint32_t given = 0;
    const auto refused = [](brume_status status, const char *named) {
        expect_status(nullptr, status, BRUME_ERROR_ARGUMENT, named);
    };
    refused(brume_context_create(nullptr, nullptr), "out");
    refused(brume_context_get_info(nullptr, &context_info), "context");
    refused(brume_effect_get_info(nullptr, 0, &effect_info), "context");
    refused(brume_parameter_get_info(nullptr, "multiscatter", 0, &parameter_info), "context");
    refused(brume_scene_create(nullptr, &scene), "context");
    refused(brume_scene_create_from_text(nullptr, "{}", 2, nullptr, &scene), "context");
    refused(brume_scene_set_medium(nullptr, &medium), "scene");
    refused(brume_scene_set_camera(nullptr, &camera), "scene");
    refused(brume_scene_get_camera_given(nullptr, &given), "scene");
    refused(brume_scene_set_metres_per_unit(nullptr, 1), "scene");
    refused(brume_scene_set_luminance_weights(nullptr, weights), "scene");
    refused(brume_scene_set_text(nullptr, "multiscatter", "kernel", "paper"), "scene");
    refused(brume_scene_set_number(nullptr, "multiscatter", "levels", 1), "scene");
    refused(brume_plan_create(nullptr, &format, &plan), "scene");
    refused(brume_plan_get_info(nullptr, &plan_info), "plan");
    refused(brume_plan_get_entry(nullptr, 0, &plan_entry), "plan");
    refused(brume_plan_execute(nullptr, &frame), "plan");
    EXPECT_EQ(brume_effect_count(nullptr), 0u);
    char text[8] = "x";
    EXPECT_EQ(brume_scene_schema(nullptr, text, sizeof text), 1u);
    EXPECT_STREQ(text, "");
}

TEST(Null, ArgumentsAreNamed)
{
    Context context = make_context();
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(4, 4));
    brume_format format = ray_format(4, 4);
    brume_plan made = nullptr;
    const auto refused = [&](brume_status status, const char *named) {
        expect_status(context.get(), status, BRUME_ERROR_ARGUMENT, named);
    };
    refused(brume_context_get_info(context.get(), nullptr), "brume_context_info");
    refused(brume_effect_get_info(context.get(), 0, nullptr), "brume_effect_info");
    refused(brume_parameter_get_info(context.get(), nullptr, 0, nullptr), "effect");
    refused(brume_parameter_get_info(context.get(), "multiscatter", 0, nullptr), "brume_parameter_info");
    refused(brume_scene_create(context.get(), nullptr), "out");
    refused(brume_scene_create_from_text(context.get(), "{}", 2, nullptr, nullptr), "out");
    brume_scene unmade = nullptr;
    refused(brume_scene_create_from_text(context.get(), nullptr, 2, nullptr, &unmade), "text");
    refused(brume_scene_set_camera(scene.get(), nullptr), "brume_camera");
    refused(brume_scene_get_camera_given(scene.get(), nullptr), "given");
    refused(brume_scene_set_luminance_weights(scene.get(), nullptr), "weights");
    refused(brume_scene_set_text(scene.get(), nullptr, "kernel", "paper"), "effect");
    refused(brume_scene_set_text(scene.get(), "multiscatter", "kernel", nullptr), "value");
    refused(brume_scene_set_number(scene.get(), nullptr, "levels", 1), "effect");
    refused(brume_scene_set_number(scene.get(), "multiscatter", nullptr, 1), "parameter");
    refused(brume_plan_create(scene.get(), nullptr, &made), "brume_format");
    refused(brume_plan_create(scene.get(), &format, nullptr), "out");
    refused(brume_plan_get_info(plan.get(), nullptr), "brume_plan_info");
    refused(brume_plan_get_entry(plan.get(), 0, nullptr), "brume_plan_entry");
    refused(brume_plan_execute(plan.get(), nullptr), "brume_frame");

    Picture color(4, 4), depth(4, 4, {.channels = 1}), output(4, 4);
    const brume_image images[] = {color.image(), depth.image(), output.image()};
    const char *const names[] = {"color", "depth", "output"};
    for (int missing = 0; missing < 3; ++missing) {
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = missing == 0 ? nullptr : &images[0];
        frame.depth = missing == 1 ? nullptr : &images[1];
        frame.output = missing == 2 ? nullptr : &images[2];
        refused(brume_plan_execute(plan.get(), &frame), names[missing]);
    }
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &images[0];
    frame.depth = &images[1];
    frame.output = &images[2];
    frame.output_count = 1;
    refused(brume_plan_execute(plan.get(), &frame), "outputs: NULL");
    frame.output_count = 0;
    frame.input_count = 1;
    refused(brume_plan_execute(plan.get(), &frame), "inputs: NULL");
    frame.input_count = 0;
    frame.frame = NAN;
    refused(brume_plan_execute(plan.get(), &frame), "frame");
}

TEST(Message, IsCutToCapacity)
{
    EXPECT_NE(brume_context_create(nullptr, nullptr), BRUME_OK);
    const std::string whole = message(nullptr);
    ASSERT_GT(whole.size(), 4u);
    EXPECT_EQ(brume_message(nullptr, nullptr, 0), whole.size() + 1);
    EXPECT_EQ(brume_message(nullptr, nullptr, 100), whole.size() + 1);
    char text[6] = {'#', '#', '#', '#', '#', '#'};
    EXPECT_EQ(brume_message(nullptr, text, 0), whole.size() + 1);
    EXPECT_EQ(text[0], '#');
    EXPECT_EQ(brume_message(nullptr, text, 1), whole.size() + 1);
    EXPECT_EQ(text[0], '\0');
    EXPECT_EQ(brume_message(nullptr, text, 5), whole.size() + 1);
    EXPECT_EQ(std::string(text), whole.substr(0, 4));
    EXPECT_EQ(text[5], '#');
}

TEST(Message, IsPerContextAndPerThread)
{
    Context a = make_context(), b = make_context();
    EXPECT_EQ(message(a.get()), "");
    EXPECT_NE(brume_scene_create(a.get(), nullptr), BRUME_OK);
    brume_scene scene = nullptr;
    EXPECT_NE(brume_scene_create_from_text(b.get(), "{", 1, "b.json", &scene), BRUME_OK);
    EXPECT_NE(message(a.get()).find("out"), std::string::npos);
    EXPECT_NE(message(b.get()).find("b.json"), std::string::npos);
    std::thread([&] {
        EXPECT_EQ(message(a.get()), "");
        EXPECT_NE(brume_effect_get_info(a.get(), 1000, nullptr), BRUME_OK);
        EXPECT_NE(message(a.get()).find("index"), std::string::npos);
    }).join();
    EXPECT_NE(message(a.get()).find("out"), std::string::npos);
}

// A new context may lie where a destroyed one lay; what went wrong there is not its business.
TEST(Message, OfADestroyedContextIsForgotten)
{
    for (int i = 0; i < 20; ++i) {
        Context context = make_context();
        ASSERT_EQ(message(context.get()), "");
        Scene scene = make_scene(context, foggy);
        brume_context handle = context.get();
        ASSERT_NE(brume_scene_create(handle, nullptr), BRUME_OK);
        context.reset();
        ASSERT_NE(brume_scene_set_metres_per_unit(scene.get(), -1), BRUME_OK);
    }
}

TEST(Message, NothingIsSticky)
{
    Context context = make_context();
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(8, 8));
    Picture color(8, 8), depth(8, 8, {.channels = 1}), output(8, 8), small(4, 8);
    paint(color);
    paint_depth(depth);
    EXPECT_EQ(execute(plan.get(), small, depth, output), BRUME_ERROR_FORMAT);
    EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK);
    brume_scene broken = nullptr;
    EXPECT_EQ(brume_scene_create_from_text(context.get(), "[", 1, nullptr, &broken), BRUME_ERROR_SCENE);
    EXPECT_EQ(broken, nullptr);
    EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK);
}

namespace {

struct Logged {
    std::vector<std::pair<uint32_t, std::string>> messages;
    static void log(void *user, uint32_t level, const char *message)
    {
        static_cast<Logged *>(user)->messages.emplace_back(level, message);
    }
};

}  // namespace

TEST(Log, LevelsAreACeiling)
{
    size_t fewer = 0;
    for (uint32_t level = BRUME_LOG_ERROR; level <= BRUME_LOG_DEBUG; ++level) {
        Logged logged;
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        desc.backend = BRUME_BACKEND_CPU;
        desc.log = Logged::log;
        desc.log_user = &logged;
        desc.log_level = level;
        Context context = make_context(desc);
        EXPECT_NE(brume_scene_create(context.get(), nullptr), BRUME_OK);
        for (auto &[message_level, text] : logged.messages) {
            EXPECT_GE(message_level, BRUME_LOG_ERROR);
            EXPECT_LE(message_level, level) << text;
        }
        ASSERT_FALSE(logged.messages.empty());
        EXPECT_EQ(logged.messages.back().first, BRUME_LOG_ERROR);
        EXPECT_EQ(logged.messages.back().second, message(context.get()));
        EXPECT_GE(logged.messages.size(), fewer);
        fewer = logged.messages.size();
    }
    EXPECT_GT(fewer, 1u);
}

TEST(Lifetime, ChildrenKeepTheirContext)
{
    Context context = make_context();
    Scene scene = make_scene(context, foggy);
    context.reset();
    brume_format format = ray_format(9, 7);
    brume_plan made = nullptr;
    ASSERT_EQ(brume_plan_create(scene.get(), &format, &made), BRUME_OK);
    Plan plan(made);
    scene.reset();
    Picture color(9, 7), depth(9, 7, {.channels = 1}), output(9, 7);
    paint(color);
    paint_depth(depth);
    EXPECT_EQ(execute(plan.get(), color, depth, output), BRUME_OK);
    EXPECT_EQ(execute(plan.get(), depth, depth, output), BRUME_ERROR_ARGUMENT);
}

TEST(Threads, ContextsAreIndependent)
{
    Picture results[4] = {{61, 40}, {61, 40}, {61, 40}, {61, 40}};
    std::vector<std::thread> threads;
    for (Picture &result : results)
        threads.emplace_back([&result] {
            for (int i = 0; i < 3; ++i) {
                Context context = make_context();
                Scene scene = make_scene(context, foggy);
                Plan plan = make_plan(context, scene, ray_format(61, 40));
                Picture color(61, 40), depth(61, 40, {.channels = 1});
                paint(color);
                paint_depth(depth);
                for (int frame = 0; frame < 5; ++frame)
                    EXPECT_EQ(execute(plan.get(), color, depth, result), BRUME_OK);
            }
        });
    for (std::thread &thread : threads)
        thread.join();
    for (const Picture &result : results)
        expect_same_bits(results[0], result);
}
