// Messages about numbers: the argument, what it was, what was expected; in the same words whatever the host's locale is.
#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <brume/brume_media.h>

#include "client.h"

using namespace client;

namespace {

class Messages : public testing::Test {
protected:
    void refused(brume_status status, const char *text) { expect_status(context.get(), status, BRUME_ERROR_ARGUMENT, text); }
    template <class Change> void format_refused(Change change, const char *text)
    {
        brume_format format = ray_format(4, 3);
        change(format);
        brume_plan made = nullptr;
        refused(brume_plan_create(scene.get(), &format, &made), text);
    }
    template <class Change> void color_refused(Change change, const char *text)
    {
        brume_image color_image = color.image(), depth_image = depth.image();
        brume_frame frame = BRUME_FRAME_INIT;
        change(color_image);
        frame.color = frame.output = &color_image;
        frame.depth = &depth_image;
        refused(brume_plan_execute(plan.get(), &frame), text);
    }
    void fov_refused(double fov, const char *text)
    {
        brume_camera camera = BRUME_CAMERA_INIT;
        camera.given = BRUME_CAMERA_FIELD_OF_VIEW;
        camera.vertical_fov = fov;
        refused(brume_scene_set_camera(scene.get(), &camera), text);
    }

    Context context = make_context();
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(4, 3));
    Picture color{4, 3}, depth{4, 3, {.channels = 1}};
};

// Writes numbers with a comma; "" where there is no such locale and no means to make one.
std::string comma_locale()
{
    if (std::setlocale(LC_ALL, "de_DE.UTF-8"))
        return "de_DE.UTF-8";
    const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "brume_locale";
    std::filesystem::create_directories(directory);
    std::ofstream(directory / "comma.src") << "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\n"
                                              "END LC_NUMERIC\n";
    const std::string path = directory.string();
    // Fails over the categories that it takes from elsewhere, having written what is wanted.
    if (std::system(("localedef -c -i '" + path + "/comma.src' '" + path + "/comma' >/dev/null 2>&1").c_str()) == -1)
        return "";
    setenv("LOCPATH", path.c_str(), 1);
    const bool made = std::setlocale(LC_NUMERIC, "comma");
    unsetenv("LOCPATH");
    return made ? "comma" : "";
}

}  // namespace

TEST_F(Messages, HaveTheValueGiven)
{
    format_refused([](auto &f) { f.width = 70000; }, "brume_format.width: 70000; expected 1 to 65536");
    format_refused([](auto &f) { f.height = -1; }, "brume_format.height: -1; expected 1 to 65536");
    format_refused([](auto &f) { f.display_width = -3; }, "display_height: -3, 0; expected both");
    format_refused([](auto &f) { f.depth_kind = 9; }, "brume_format.depth_kind: 9; expected");
    format_refused([](auto &f) { f.sky = 9; }, "brume_format.sky: 9; expected");
    format_refused([](auto &f) { f.nonpositive = 9; }, "brume_format.nonpositive: 9; expected");
    format_refused([](auto &f) { f.output_count = 1u << 30; },
                   "brume_format.outputs: 1073741824 layers; expected 0 to 8192");
    format_refused([](auto &f) { f.input_count = 3; }, "brume_format.inputs: NULL; expected 3 layers");
    format_refused([](auto &f) { f.far_distance = -2.5; }, "brume_format.far_distance: -2.5; expected");
    format_refused(
        [](auto &f) {
            f.depth_kind = BRUME_DEPTH_DEVICE;
            f.depth_range[0] = -0.5;
        },
        "brume_format.depth_range: -0.5, 1; expected");
    format_refused(
        [](auto &f) {
            f.depth_kind = BRUME_DEPTH_DEVICE;
            f.depth_range[0] = f.depth_range[1] = 2;
        },
        "brume_format.depth_range: 2, 2; expected two different");
    format_refused(
        [](auto &f) {
            f.sky = BRUME_SKY_CLAMP;
            f.sky_distance = -7;
        },
        "brume_format.sky_distance: -7; expected");

    color_refused([](auto &i) { i.kind = 8; }, "color.kind: 8; expected");
    color_refused([](auto &i) { i.pixel = 8; }, "color.pixel: 8; expected");
    color_refused([](auto &i) { i.channels = 5; }, "color.channels: 5; expected 1 to 4");
    color_refused([](auto &i) { i.origin = 8; }, "color.origin: 8; expected");
    color_refused([](auto &i) { i.data = nullptr; }, "color.data: NULL; expected");
    color_refused([](auto &i) { i.pixel_stride = 7; }, "color.pixel_stride: 7; expected");
    color_refused([](auto &i) { i.row_stride = INT64_MIN; }, "color.row_stride: -9223372036854775808; expected");
    color_refused([](auto &i) { i.row_stride = 60; }, "color.row_stride: 60 bytes between what takes 64; expected");

    brume_camera camera = BRUME_CAMERA_INIT;
    camera.given = 12;
    refused(brume_scene_set_camera(scene.get(), &camera), "camera.given: 12; expected");
    fov_refused(4.5, "camera.vertical_fov: 4.5; expected");
    fov_refused(1e-9, "camera.vertical_fov: 1e-09; expected");

    brume_quality quality = BRUME_QUALITY_INIT;
    quality.preset = 77;
    refused(brume_scene_set_quality(scene.get(), &quality), "brume_quality.preset: 77; expected");
    brume_medium medium = BRUME_MEDIUM_INIT;
    const brume_density_term term = BRUME_DENSITY_TERM_INIT;
    medium.terms = &term;
    medium.term_count = 5000;
    refused(brume_scene_set_medium(scene.get(), &medium), "brume_medium.term_count: 5000; expected");
    refused(brume_scene_set_metres_per_unit(scene.get(), -0.25), "metres: -0.25; expected");
    const double negative[] = {0.5, -0.5, 1}, bright[] = {0.5, 0.5, 0.5};
    refused(brume_scene_set_luminance_weights(scene.get(), negative), "weights[1]: -0.5; expected");
    refused(brume_scene_set_luminance_weights(scene.get(), bright), "weights: a sum of 1.5; expected 1");

    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.threads = 4711;
    brume_context none = nullptr;
    expect_status(nullptr, brume_context_create(&desc, &none), BRUME_ERROR_ARGUMENT, "threads: 4711; expected 0 to 1024");
}

TEST_F(Messages, ReservedFieldsAreZero)
{
    brume_layer reserved = layer("transmittance");
    reserved.reserved = 7;
    format_refused(
        [&](auto &f) {
            f.output_count = 1;
            f.outputs = &reserved;
        },
        "brume_format.outputs[0].reserved: 7; expected 0");

    brume_medium medium = BRUME_MEDIUM_INIT;
    brume_gaussian gaussians[2] = {BRUME_GAUSSIAN_INIT, BRUME_GAUSSIAN_INIT};
    gaussians[1].reserved = 7;
    medium.gaussians = gaussians;
    medium.gaussian_count = 2;
    refused(brume_scene_set_medium(scene.get(), &medium), "gaussians[1].reserved: 7; expected 0");

    Plan with_layer = make_plan(context, scene, ray_format(4, 3, {layer("transmittance")}));
    Picture output(4, 3), transmittance(4, 3);
    const brume_image image = transmittance.image();
    reserved.image = &image;
    refused(execute(with_layer.get(), color, depth, output, {reserved}), "outputs[0].reserved: 7; expected 0");
    const brume_image color_image = color.image(), depth_image = depth.image(), output_image = output.image();
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color_image;
    frame.depth = &depth_image;
    frame.output = &output_image;
    frame.reserved = 7;
    refused(brume_plan_execute(with_layer.get(), &frame), "brume_frame.reserved: 7; expected 0");

    brume_media media = nullptr;
    ASSERT_EQ(brume_media_create(context.get(), &media), BRUME_OK);
    const double point[] = {0, 0, 0}, rectangle[] = {0, 0, 1, 1};
    brume_media_stroke stroke = BRUME_MEDIA_STROKE_INIT;
    stroke.points = point;
    stroke.point_count = 1;
    brume_media_erase erase = BRUME_MEDIA_ERASE_INIT;
    erase.stroke = &stroke;
    erase.reserved = 7;
    refused(brume_media_apply_erase(media, &erase), "brume_media_erase.reserved: 7; expected 0");
    brume_media_view view = BRUME_MEDIA_VIEW_INIT;
    view.reserved = 7;
    refused(brume_media_select_rectangle(media, &view, rectangle, 0), "brume_media_view.reserved: 7; expected 0");
    brume_media_destroy(media);
}

TEST_F(Messages, DoNotFollowTheLocale)
{
    const std::string locale = comma_locale();
    if (locale.empty())
        GTEST_SKIP() << "no locale whose numbers have a comma, and no localedef to make one";
    char sample[16];
    snprintf(sample, sizeof sample, "%.1f", 4.5);
    ASSERT_STREQ(sample, "4,5") << locale;
    fov_refused(4.5, "camera.vertical_fov: 4.5; expected an angle from 1e-6 to 3.141592");
    format_refused([](auto &f) { f.width = 70000; }, "brume_format.width: 70000; expected 1 to 65536");
    refused(brume_scene_set_metres_per_unit(scene.get(), -0.25), "metres: -0.25; expected");
    refused(brume_scene_set_text(scene.get(), "multiscatter", "level_scale", "-1.5"), "-1.5; expected");
    EXPECT_EQ(brume_scene_set_text(scene.get(), "multiscatter", "level_scale", "1.5"), BRUME_OK) << message(context.get());
    EXPECT_NO_THROW(make_scene(context, R"({"brume": 1, "metres_per_unit": 0.5, "medium": {"visibility": 12.5}})"));
    std::setlocale(LC_ALL, "C");
}
