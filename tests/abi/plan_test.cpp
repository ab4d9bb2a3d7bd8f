// What plans say, what they need, and what they are checked against.
#include <chrono>

#include "client.h"

using namespace client;

namespace {

class Plans : public EachBackend {
protected:
    brume_plan_info info(const Plan &plan)
    {
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        EXPECT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK) << message(context.get());
        return info;
    }
    brume_plan_entry entry(const Plan &plan, uint32_t index)
    {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        EXPECT_EQ(brume_plan_get_entry(plan.get(), index, &entry), BRUME_OK) << message(context.get());
        return entry;
    }
    void refused(const Scene &scene, const brume_format &format, brume_status status, const std::string &named)
    {
        auto plan = reinterpret_cast<brume_plan>(1);
        expect_status(context.get(), brume_plan_create(scene.get(), &format, &plan), status, named);
        EXPECT_EQ(plan, nullptr);
    }
};
INSTANTIATE_EACH_BACKEND(Plans);

const char *const only_medium = R"({"brume": 1, "medium": {"scattering": 0.02}})";
const char *const only_absorption = R"({"brume": 1, "medium": {"absorption": 0.02}})";
const char *const layered = R"({"brume": 1, "medium": {"absorption": 0.02,
    "density": [{"type": "exponential", "falloff": 0.1}]}})";

}  // namespace

// What callers bring in other formats than effects take is converted, and what moves is uploaded.
TEST_P(Plans, CountTheMemoryOfWhatFramesBring)
{
    Scene scene = make_scene(context, R"({"brume": 1,
        "camera": {"vertical_fov": 50, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium": {"scattering": 0.03}, "lights": [{"type": "point", "position": [0, 0, -5], "intensity": 9}]})");
    Plan plan = make_plan(context, scene, ray_format(32, 24));
    const uint64_t planned = info(plan).image_bytes;
    Picture color(32, 24), half(32, 24, {.pixel = BRUME_PIXEL_F16}), depth(32, 24, {.channels = 1}), output(32, 24);
    paint(color);
    paint(half);
    paint_depth(depth);
    auto bytes_after = [&](const Picture &given) {
        EXPECT_EQ(execute(plan.get(), given, depth, output), BRUME_OK) << message(context.get());
        return info(plan).image_bytes;
    };
    const uint64_t packed = bytes_after(color);
    EXPECT_GE(packed, planned + 1024 * 16) << "the lights";
    if (GetParam() != BRUME_BACKEND_CPU)  // OpenGL has its own of all
        return;
    EXPECT_EQ(bytes_after(half), packed + 32 * 24 * 16);
    EXPECT_EQ(bytes_after(color), packed);
}

TEST_P(Plans, EntriesHaveReasons)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(64, 48));
    const brume_plan_info i = info(plan);
    EXPECT_EQ(i.does_nothing, 0u);
    EXPECT_GT(i.image_bytes, 0u);
    EXPECT_GT(i.predicted_ms, 0.0);
    uint32_t running = 0;
    double predicted = 0;
    ASSERT_GE(i.entry_count, 2u);
    for (uint32_t k = 0; k < i.entry_count; ++k) {
        const brume_plan_entry e = entry(plan, k);
        const std::string name = e.name;
        EXPECT_STREQ(e.effect, name == "density" ? "brume" : name == "airlight" && !e.runs ? "airlight" : "multiscatter");
        EXPECT_STRNE(e.name, "");
        EXPECT_STRNE(e.reason, "");
        EXPECT_LT(e.measured_ms, 0.0);
        EXPECT_EQ(e.runs ? e.bytes > 0 && e.operations > 0 && e.predicted_ms > 0 : e.bytes == 0, true) << e.name;
        running += e.runs;
        predicted += e.predicted_ms;
    }
    EXPECT_GE(running, 3u);
    EXPECT_NEAR(predicted, i.predicted_ms, 1e-9);
    brume_plan_entry past = BRUME_PLAN_ENTRY_INIT;
    expect_status(context.get(), brume_plan_get_entry(plan.get(), i.entry_count, &past), BRUME_ERROR_ARGUMENT, "index");
}

TEST_P(Plans, SayWhichGaussiansTheViewDoesNotMeet)
{
    const auto said = [&](const std::string &camera, const std::string &centers) {
        std::string text =
            R"({"brume": 1, "camera": {"vertical_fov": 50)" + camera + R"(}, "medium": {"scattering": 0.1, "density": [)";
        for (size_t from = 0; from < centers.size(); from += 8)
            text += (from ? "," : "") +
                    (R"({"type": "gaussian", "scale": 2, "amplitude": 1, "center": )" + centers.substr(from, 8) + "}");
        Scene scene = make_scene(context, (text + "]}}").c_str());
        Plan plan = make_plan(context, scene, ray_format(64, 48));
        std::string reason;
        for (uint32_t k = 0; k < info(plan).entry_count; ++k)
            if (brume_plan_entry e = entry(plan, k); !e.runs && std::string(e.name) == "gaussians")
                reason += e.reason;
        return reason.substr(0, reason.find(" outside"));
    };
    const std::string here = R"(, "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]])",
                      turned = R"(, "camera_to_world": [[-1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]])";
    EXPECT_EQ(said(here, "[0,0,-9][1,0,-9]"), "");
    EXPECT_EQ(said(here, "[0,0,-9][1,0,-9][0,0, 9][9,0,-5]"), "2 of 4 Gaussians");
    EXPECT_EQ(said(turned, "[0,0,-9][1,0,-9][0,0, 9][9,0,-5]"), "3 of 4 Gaussians");
    EXPECT_EQ(said("", "[0,0,-9][0,0, 9]"), "") << "frames bring the pose";
}

TEST_P(Plans, DropWhatTheSceneDoesNotNeed)
{
    const auto names = [&](const char *text, bool runs) {
        Scene scene = make_scene(context, text);
        Plan plan = make_plan(context, scene, ray_format(64, 48));
        std::string names;
        for (uint32_t k = 0; k < info(plan).entry_count; ++k)
            if (brume_plan_entry e = entry(plan, k); (e.runs != 0) == runs)
                names += std::string(e.name) + " ";
        return names;
    };
    EXPECT_EQ(names(only_absorption, true), "density compose ");
    EXPECT_EQ(names(only_absorption, false), "airlight pyramid ");
    EXPECT_EQ(names(foggy, true), "density scatter downsample smooth compose ");
    EXPECT_EQ(names(foggy, false), "airlight ");
    std::string with_setting = foggy;
    with_setting.insert(with_setting.rfind('}'), ",\"effects\":{\"multiscatter\":{\"masking\":false}}");
    EXPECT_EQ(names(with_setting.c_str(), false), "settings ");
}

TEST_P(Plans, MeasuredTimesComeWithAFrame)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(160, 120));
    Picture color(160, 120), depth(160, 120, {.channels = 1}), output(160, 120);
    paint(color);
    paint_depth(depth);
    for (int frame = 0; frame < 3; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        double sum = 0;
        for (uint32_t k = 0; k < info(plan).entry_count; ++k) {
            const brume_plan_entry e = entry(plan, k);
            EXPECT_GE(e.measured_ms, 0.0) << e.name;
            if (e.runs)
                sum += e.measured_ms;
        }
        EXPECT_GT(sum, 0.0);
        const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
        EXPECT_TRUE(GetParam() == BRUME_BACKEND_GL || sum <= wall.count());
    }
}

TEST_P(Plans, FormatRefusesNonsense)
{
    struct Case {
        std::function<void(brume_format &)> change;
        const char *named;
    };
    const Case cases[] = {
        {[](auto &f) { f.width = 0; }, "width"},
        {[](auto &f) { f.height = -3; }, "height"},
        {[](auto &f) { f.width = 65537; }, "width"},
        {[](auto &f) { f.height = INT32_MAX; }, "height"},
        {[](auto &f) { f.display_width = 10; }, "display_width"},
        {[](auto &f) { f.display_width = -10, f.display_height = 10; }, "display_width"},
        {[](auto &f) { f.depth_kind = 5; }, "depth_kind"},
        {[](auto &f) { f.sky = 3; }, "sky"},
        {[](auto &f) { f.output_count = BRUME_MAX_LAYERS + 1; }, "outputs"},
        {[](auto &f) { f.input_count = 1; }, "inputs"},
        {[](auto &f) { f.far_distance = 0; }, "far_distance"},
        {[](auto &f) { f.far_distance = NAN; }, "far_distance"},
        {[](auto &f) { f.depth_kind = BRUME_DEPTH_NORMALIZED, f.depth_range[1] = INFINITY; }, "depth_range"},
        {[](auto &f) { f.depth_kind = BRUME_DEPTH_DEVICE, f.depth_range[0] = 0; }, "depth_range"},
        {[](auto &f) { f.depth_kind = BRUME_DEPTH_DEVICE, f.depth_range[0] = f.depth_range[1] = 2; }, "depth_range"},
        {[](auto &f) { f.sky = BRUME_SKY_CLAMP, f.sky_distance = -1; }, "sky_distance"},
        {[](auto &f) { f.nonpositive = 2; }, "nonpositive"},
        {[](auto &f) { f.sky = BRUME_SKY_CLAMP, f.sky_distance = NAN; }, "sky_distance"},
    };
    Scene scene = make_scene(context, foggy);
    for (const Case &c : cases) {
        brume_format format = ray_format(8, 8);
        c.change(format);
        refused(scene, format, BRUME_ERROR_ARGUMENT, c.named);
    }
}

TEST_P(Plans, OutputsThatNothingFills)
{
    Scene empty = make_scene(context, R"({"brume": 1})");
    refused(empty, ray_format(8, 8, {layer("transmittance")}), BRUME_ERROR_UNSUPPORTED, "outputs");
}

TEST_P(Plans, MissingCameraSaysWhy)
{
    Picture color(16, 12), depth(16, 12, {.channels = 1}), output(16, 12);
    paint(color);
    paint_depth(depth);
    brume_format planar = ray_format(16, 12);
    planar.depth_kind = BRUME_DEPTH_PLANAR;
    struct Case {
        const char *scene;
        brume_format format;
        uint32_t needs;
        const char *what, *why;
    };
    const Case cases[] = {
        {only_medium, ray_format(16, 12), BRUME_CAMERA_FIELD_OF_VIEW, "field of view", "blur"},
        {only_absorption, planar, BRUME_CAMERA_FIELD_OF_VIEW, "field of view", "planar"},
        {only_absorption, ray_format(16, 12), 0, "", ""},
        {layered, ray_format(16, 12), BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE, "pose", "density"},
    };
    for (const Case &c : cases) {
        Scene scene = make_scene(context, c.scene);
        Plan plan = make_plan(context, scene, c.format);
        EXPECT_EQ(info(plan).camera_needs, c.needs);
        EXPECT_NE(std::string(info(plan).camera_reason).find(c.why), std::string::npos);
        const brume_status status = execute(plan.get(), color, depth, output);
        expect_status(context.get(), status, c.needs ? BRUME_ERROR_CAMERA : BRUME_OK, c.what);
        if (c.needs) {
            EXPECT_NE(message(context.get()).find(c.why), std::string::npos) << message(context.get());
        }

        brume_camera camera = BRUME_CAMERA_INIT;
        camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
        const brume_image images[] = {color.image(), depth.image(), output.image()};
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &images[0];
        frame.depth = &images[1];
        frame.output = &images[2];
        frame.camera = &camera;
        EXPECT_EQ(brume_plan_execute(plan.get(), &frame), BRUME_OK) << message(context.get());
        camera.vertical_fov = -1;
        expect_status(context.get(), brume_plan_execute(plan.get(), &frame), BRUME_ERROR_ARGUMENT, "camera.vertical_fov");
    }
}

TEST_P(Plans, ImagesMustFit)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(16, 12, {layer("transmittance")}));
    Picture color(16, 12), depth(16, 12, {.channels = 1}), output(16, 12), wide(17, 12), low_depth(16, 11, {.channels = 1});
    Picture three(16, 12, {.channels = 3}), flipped(16, 12, {.bottom_up = true});
    expect_status(context.get(), execute(plan.get(), wide, depth, output), BRUME_ERROR_FORMAT, "color: 17 x 12");
    expect_status(context.get(), execute(plan.get(), color, low_depth, output), BRUME_ERROR_FORMAT, "depth: 16 x 11");
    expect_status(context.get(), execute(plan.get(), color, depth, wide), BRUME_ERROR_FORMAT, "output: 17 x 12");
    expect_status(context.get(), execute(plan.get(), color, color, output), BRUME_ERROR_ARGUMENT, "depth.channels");
    expect_status(context.get(), execute(plan.get(), color, depth, three), BRUME_ERROR_ARGUMENT, "output.channels");
    expect_status(context.get(), execute(plan.get(), color, depth, flipped), BRUME_ERROR_ARGUMENT, "output.origin");

    const brume_image wide_image = wide.image(), good = wide.image();
    expect_status(context.get(), execute(plan.get(), color, depth, output, {layer("transmittance", &wide_image)}),
                  BRUME_ERROR_FORMAT, "transmittance: 17 x 12");
    expect_status(context.get(), execute(plan.get(), color, depth, output, {layer("scattered", &good)}),
                  BRUME_ERROR_ARGUMENT, "outputs[0] (scattered)");
    expect_status(context.get(), execute(plan.get(), color, depth, output, {layer("transmittance", nullptr)}),
                  BRUME_ERROR_ARGUMENT, "outputs[0] (transmittance).image");

    // A new plan for the new format is all that it takes.
    Plan again = make_plan(context, scene, ray_format(17, 12));
    Picture wide_depth(17, 12, {.channels = 1}), wide_output(17, 12);
    EXPECT_EQ(execute(again.get(), wide, wide_depth, wide_output), BRUME_OK) << message(context.get());
}

TEST_P(Plans, ImagesRefuseNonsense)
{
    struct Case {
        std::function<void(brume_image &)> change;
        const char *named;
    };
    const Case cases[] = {
        {[](auto &i) { i.kind = 3; }, ".kind"},
        {[](auto &i) { i.pixel = 2; }, ".pixel"},
        {[](auto &i) { i.channels = 0; }, ".channels"},
        {[](auto &i) { i.channels = 5; }, ".channels"},
        {[](auto &i) { i.origin = 2; }, ".origin"},
        {[](auto &i) { i.data = nullptr; }, ".data"},
        {[](auto &i) { i.pixel_stride = 1; }, ".pixel_stride"},
        {[](auto &i) { i.pixel_stride = INT64_MIN; }, ".pixel_stride"},
        {[](auto &i) { i.row_stride = 1; }, ".row_stride"},
        {[](auto &i) { i.row_stride = INT64_MIN; }, ".row_stride"},
        {[](auto &i) { i.row_stride = INT64_MAX; }, ".row_stride"},
        {[](auto &i) { i.kind = BRUME_IMAGE_GL_TEXTURE; }, ".gl_texture"},
    };
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(16, 12));
    Picture color(16, 12), depth(16, 12, {.channels = 1}), output(16, 12);
    const char *const names[] = {"color", "depth", "output"};
    for (const Case &c : cases)
        for (int which = 0; which < 3; ++which) {
            brume_image images[] = {color.image(), depth.image(), output.image()};
            c.change(images[which]);
            brume_frame frame = BRUME_FRAME_INIT;
            frame.color = &images[0];
            frame.depth = &images[1];
            frame.output = &images[2];
            expect_status(context.get(), brume_plan_execute(plan.get(), &frame), BRUME_ERROR_ARGUMENT,
                          std::string(names[which]) + c.named);
        }
    brume_image images[] = {color.image(), depth.image(), output.image()};
    images[0].kind = BRUME_IMAGE_GL_TEXTURE;
    images[0].gl_texture = 1;
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &images[0];
    frame.depth = &images[1];
    frame.output = &images[2];
    expect_status(context.get(), brume_plan_execute(plan.get(), &frame), BRUME_ERROR_UNSUPPORTED, "color");
}

TEST_P(Plans, KeepTheSceneTheyWereMadeFrom)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(16, 12));
    Picture color(16, 12), depth(16, 12, {.channels = 1}), before(16, 12), after(16, 12), changed(16, 12);
    paint(color);
    paint_depth(depth);
    ASSERT_EQ(execute(plan.get(), color, depth, before), BRUME_OK) << message(context.get());
    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.absorption[0] = 1;
    ASSERT_EQ(brume_scene_set_medium(scene.get(), &medium), BRUME_OK);
    ASSERT_EQ(brume_scene_set_metres_per_unit(scene.get(), 10), BRUME_OK);
    Plan second = make_plan(context, scene, ray_format(16, 12));
    ASSERT_EQ(execute(second.get(), color, depth, changed), BRUME_OK) << message(context.get());
    scene.reset();
    ASSERT_EQ(execute(plan.get(), color, depth, after), BRUME_OK) << message(context.get());
    expect_same_bits(before, after);
    EXPECT_NE(after.memory(), changed.memory());
}

TEST_P(Plans, MemoryDoesNotGrowOnceWarm)
{
    Scene scene = make_scene(context, foggy);
    const auto bytes = [&] {
        brume_context_info info = BRUME_CONTEXT_INFO_INIT;
        EXPECT_EQ(brume_context_get_info(context.get(), &info), BRUME_OK);
        return info.host_bytes + info.device_bytes;
    };
    Picture color(96, 64, {.pixel = BRUME_PIXEL_F16}), depth(96, 64, {.channels = 1}),
        output(96, 64, {.pixel = BRUME_PIXEL_F16}), transmittance(96, 64, {.pixel = BRUME_PIXEL_F16});
    const brume_image layer_image = transmittance.image();
    paint(color);
    paint_depth(depth);
    uint64_t warm = 0;
    for (int made = 0; made < 5; ++made) {
        Plan plan = make_plan(context, scene, ray_format(96, 64, {layer("transmittance")}));
        for (int frame = 0; frame < 20; ++frame) {
            ASSERT_EQ(execute(plan.get(), color, depth, output, {layer("transmittance", &layer_image)}), BRUME_OK)
                << message(context.get());
            if (made == 0 && frame == 1)
                warm = bytes();
        }
    }
    EXPECT_GT(warm, 0u);
    EXPECT_LE(bytes(), warm);
}

TEST_P(Plans, KeyedValuesFollowTheFrame)
{
    Scene scene = make_scene(context, R"({"brume": 1, "camera": {"vertical_fov": 50},
        "medium": {"absorption": {"keys": [[1, 0], [11, 1]]}}})");
    Plan plan = make_plan(context, scene, ray_format(2, 2));
    EXPECT_EQ(info(plan).does_nothing, 0u) << "a value that is 0 at first only";
    Picture color(2, 2), depth(2, 2, {.channels = 1}), output(2, 2);
    for (int i = 0; i < 4; ++i) {
        color.set(i % 2, i / 2, 0, 1);
        depth.set(i % 2, i / 2, 0, 2);
    }
    const brume_image images[] = {color.image(), depth.image(), output.image()};
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &images[0];
    frame.depth = &images[1];
    frame.output = &images[2];
    for (double number : {1.0, 6.0, 11.0, 100.0}) {
        frame.frame = number;
        ASSERT_EQ(brume_plan_execute(plan.get(), &frame), BRUME_OK) << message(context.get());
        const double absorption = std::min((number - 1) / 10, 1.0);
        EXPECT_NEAR(output.get(1, 1, 0), std::exp(-2 * absorption), 1e-6);
    }
}
