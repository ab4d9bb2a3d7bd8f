// Size-tagged structs: smaller ones of an older header, larger ones of a newer, and nonsense.
#include <brume/brume_media.h>

#include "client.h"

using namespace client;

namespace {

constexpr size_t tail = 64;

// A struct followed by what a newer header might have appended.
template <class Struct> struct Tagged {
    explicit Tagged(const Struct &value) { std::memcpy(bytes, &value, sizeof value); }
    Struct *get() { return reinterpret_cast<Struct *>(bytes); }
    void set_size(uint32_t size) { std::memcpy(bytes, &size, sizeof size); }

    alignas(8) unsigned char bytes[sizeof(Struct) + tail] = {};
};

// Sizes that every struct must take or refuse; `call` makes a call that succeeds with the struct as it is.
template <class Struct>
void check_sizes(brume_context context, const Struct &value, std::function<brume_status(Struct *)> call)
{
    const auto at_size = [&](uint32_t size, unsigned char last) {
        Tagged<Struct> tagged(value);
        tagged.set_size(size);
        tagged.bytes[sizeof tagged.bytes - 1] = last;
        return call(tagged.get());
    };
    constexpr uint32_t known = sizeof(Struct);
    expect_status(context, at_size(known, 0), BRUME_OK, "");
    expect_status(context, at_size(known, 1), BRUME_OK, "");
    expect_status(context, at_size(known + tail, 0), BRUME_OK, "");
    expect_status(context, at_size(known + tail, 1), BRUME_ERROR_ARGUMENT, "struct_size");
    expect_status(context, at_size(known + tail - 1, 1), BRUME_OK, "");
    expect_status(context, at_size(0, 0), BRUME_ERROR_ARGUMENT, "struct_size");
    expect_status(context, at_size(3, 0), BRUME_ERROR_ARGUMENT, "struct_size");
    expect_status(context, at_size(UINT32_MAX, 0), BRUME_ERROR_ARGUMENT, "struct_size");
    expect_status(context, at_size(0xa5a5a5a5u, 0), BRUME_ERROR_ARGUMENT, "struct_size");
    expect_status(context, at_size(1025, 0), BRUME_ERROR_ARGUMENT, "struct_size");
}

// The first `size` bytes of a struct, then bytes that must not be looked at.
template <class Struct> Struct cut(const Struct &value, size_t size)
{
    Struct result;
    std::memset(static_cast<void *>(&result), 0xff, sizeof result);
    std::memcpy(static_cast<void *>(&result), &value, size);
    result.struct_size = uint32_t(size);
    return result;
}

class StructSize : public testing::Test {
protected:
    Context context = make_context();
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(4, 3, {layer("transmittance")}));
    Picture color{4, 3}, depth{4, 3, {.channels = 1}}, output{4, 3}, transmittance{4, 3};
    brume_image color_image = color.image(), depth_image = depth.image(), output_image = output.image(),
                transmittance_image = transmittance.image();

    brume_frame frame()
    {
        brume_frame frame = BRUME_FRAME_INIT;
        frame.color = &color_image;
        frame.depth = &depth_image;
        frame.output = &output_image;
        return frame;
    }
};

}  // namespace

TEST_F(StructSize, OfInputs)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    check_sizes<brume_context_desc>(nullptr, desc, [](auto *given) {
        brume_context made = nullptr;
        brume_status status = brume_context_create(given, &made);
        brume_context_destroy(made);
        return status;
    });
    const std::vector<brume_layer> outputs{layer("transmittance")};
    check_sizes<brume_format>(context.get(), ray_format(4, 3, outputs),
                              [&](auto *given) { return brume_plan_update(plan.get(), scene.get(), given); });
    check_sizes<brume_medium>(context.get(), BRUME_MEDIUM_INIT,
                              [&](auto *given) { return brume_scene_set_medium(scene.get(), given); });
    check_sizes<brume_quality>(context.get(), BRUME_QUALITY_INIT,
                               [&](auto *given) { return brume_scene_set_quality(scene.get(), given); });
    check_sizes<brume_density_term>(context.get(), BRUME_DENSITY_TERM_INIT, [&](auto *given) {
        brume_medium medium = BRUME_MEDIUM_INIT;
        medium.term_count = 1;
        medium.terms = given;
        return brume_scene_set_medium(scene.get(), &medium);
    });
    check_sizes<brume_gaussian>(context.get(), BRUME_GAUSSIAN_INIT, [&](auto *given) {
        brume_medium medium = BRUME_MEDIUM_INIT;
        medium.gaussian_count = 1;
        medium.gaussians = given;
        return brume_scene_set_medium(scene.get(), &medium);
    });
    check_sizes<brume_light>(context.get(), BRUME_LIGHT_INIT,
                             [&](auto *given) { return brume_scene_set_lights(scene.get(), given, 1); });
    check_sizes<brume_camera>(context.get(), BRUME_CAMERA_INIT,
                              [&](auto *given) { return brume_scene_set_camera(scene.get(), given); });
    check_sizes<brume_camera>(context.get(), BRUME_CAMERA_INIT, [&](auto *given) {
        brume_frame f = frame();
        f.camera = given;
        return brume_plan_execute(plan.get(), &f);
    });
    check_sizes<brume_format>(context.get(), ray_format(4, 3), [&](auto *given) {
        brume_plan made = nullptr;
        brume_status status = brume_plan_create(scene.get(), given, &made);
        brume_plan_destroy(made);
        return status;
    });
    for (const brume_image *brume_frame::*slot : {&brume_frame::color, &brume_frame::depth, &brume_frame::output})
        check_sizes<brume_image>(context.get(), *(frame().*slot), [&](auto *given) {
            brume_frame f = frame();
            f.*slot = given;
            return brume_plan_execute(plan.get(), &f);
        });
    check_sizes<brume_frame>(context.get(), frame(), [&](auto *given) { return brume_plan_execute(plan.get(), given); });
    check_sizes<brume_layer>(context.get(), layer("transmittance", &transmittance_image), [&](auto *given) {
        brume_frame f = frame();
        f.output_count = 1;
        f.outputs = given;
        return brume_plan_execute(plan.get(), &f);
    });
    check_sizes<brume_layer>(context.get(), layer("optical_depth"), [&](auto *given) {
        brume_format format = ray_format(4, 3);
        format.input_count = 1;
        format.inputs = given;
        brume_plan made = nullptr;
        brume_status status = brume_plan_create(scene.get(), &format, &made);
        brume_plan_destroy(made);
        return status;
    });
}

TEST_F(StructSize, OfMedia)
{
    brume_media media = nullptr;
    ASSERT_EQ(brume_media_create(context.get(), &media), BRUME_OK);
    const double points[] = {0, 0, 0}, rectangle[] = {0, 0, 1, 1};
    brume_camera camera = BRUME_CAMERA_INIT;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    const brume_format format = ray_format(4, 3);
    brume_media_view view = BRUME_MEDIA_VIEW_INIT;
    view.camera = &camera;
    view.format = &format;
    brume_media_stroke stroke = BRUME_MEDIA_STROKE_INIT;
    stroke.points = points;
    stroke.point_count = 1;
    brume_media_paint paint = BRUME_MEDIA_PAINT_INIT;
    paint.stroke = &stroke;
    brume_media_erase erase = BRUME_MEDIA_ERASE_INIT;
    erase.stroke = &stroke;
    check_sizes<brume_media_info>(context.get(), BRUME_MEDIA_INFO_INIT,
                                  [&](auto *info) { return brume_media_get_info(media, info); });
    check_sizes<brume_media_view>(context.get(), view,
                                  [&](auto *given) { return brume_media_select_rectangle(media, given, rectangle, 0); });
    check_sizes<brume_media_stroke>(context.get(), stroke, [&](auto *given) {
        brume_media_paint p = paint;
        p.stroke = given;
        return brume_media_apply_paint(media, &p);
    });
    check_sizes<brume_media_paint>(context.get(), paint, [&](auto *given) { return brume_media_apply_paint(media, given); });
    check_sizes<brume_media_erase>(context.get(), erase, [&](auto *given) { return brume_media_apply_erase(media, given); });
    check_sizes<brume_media_emitter>(context.get(), BRUME_MEDIA_EMITTER_INIT,
                                     [&](auto *given) { return brume_media_apply_emit(media, given, 1.0); });
    check_sizes<brume_media_airbrush>(context.get(), BRUME_MEDIA_AIRBRUSH_INIT,
                                      [&](auto *given) { return brume_media_apply_airbrush(media, given); });
    brume_media_destroy(media);
}

TEST_F(StructSize, OfResults)
{
    check_sizes<brume_context_info>(context.get(), BRUME_CONTEXT_INFO_INIT,
                                    [&](auto *info) { return brume_context_get_info(context.get(), info); });
    check_sizes<brume_effect_info>(context.get(), BRUME_EFFECT_INFO_INIT,
                                   [&](auto *info) { return brume_effect_get_info(context.get(), 0, info); });
    check_sizes<brume_parameter_info>(context.get(), BRUME_PARAMETER_INFO_INIT, [&](auto *info) {
        return brume_parameter_get_info(context.get(), "multiscatter", 0, info);
    });
    check_sizes<brume_layer_info>(context.get(), BRUME_LAYER_INFO_INIT,
                                  [&](auto *info) { return brume_layer_get_info(context.get(), nullptr, 0, info); });
    check_sizes<brume_scene_info>(context.get(), BRUME_SCENE_INFO_INIT,
                                  [&](auto *info) { return brume_scene_get_info(scene.get(), info); });
    check_sizes<brume_plan_info>(context.get(), BRUME_PLAN_INFO_INIT,
                                 [&](auto *info) { return brume_plan_get_info(plan.get(), info); });
    check_sizes<brume_plan_entry>(context.get(), BRUME_PLAN_ENTRY_INIT,
                                  [&](auto *info) { return brume_plan_get_entry(plan.get(), 0, info); });
}

TEST_F(StructSize, ResultsStayInsideTheSizeGiven)
{
    unsigned char bytes[sizeof(brume_plan_info)];
    for (uint32_t size : {4u, 8u, 12u, 16u, 24u}) {
        std::memset(bytes, 0xff, sizeof bytes);
        std::memcpy(bytes, &size, sizeof size);
        ASSERT_EQ(brume_plan_get_info(plan.get(), reinterpret_cast<brume_plan_info *>(bytes)), BRUME_OK);
        for (size_t i = size; i < sizeof bytes; ++i)
            ASSERT_EQ(bytes[i], 0xff) << "byte " << i << " of a struct of " << size;
        uint32_t kept;
        std::memcpy(&kept, bytes, sizeof kept);
        EXPECT_EQ(kept, size);
    }
}

// A client of a header that ended earlier: what it did not know has the defaults, whatever lies behind its struct.
TEST_F(StructSize, CutFieldsTakeTheirDefaults)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = 4;
    format.height = 3;
    brume_format early = cut(format, offsetof(brume_format, display_x));
    brume_plan made = nullptr;
    ASSERT_EQ(brume_plan_create(scene.get(), &early, &made), BRUME_OK) << message(context.get());
    Plan owned(made);
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    ASSERT_EQ(brume_plan_get_info(made, &info), BRUME_OK);
    EXPECT_TRUE(info.camera_needs & BRUME_CAMERA_FIELD_OF_VIEW) << "the default depth kind is planar";

    // A size that ends inside a field does not count that field.
    brume_format inside = cut(format, offsetof(brume_format, display_x) + 3);
    brume_plan also_made = nullptr;
    ASSERT_EQ(brume_plan_create(scene.get(), &inside, &also_made), BRUME_OK) << message(context.get());
    brume_plan_destroy(also_made);

    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.scattering[0] = medium.scattering[1] = medium.scattering[2] = 0.1;
    brume_medium without_rest = cut(medium, offsetof(brume_medium, emission));
    EXPECT_EQ(brume_scene_set_medium(scene.get(), &without_rest), BRUME_OK) << message(context.get());

    brume_camera camera = BRUME_CAMERA_INIT;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    brume_camera fov_only = cut(camera, offsetof(brume_camera, pixel_aspect));
    EXPECT_EQ(brume_scene_set_camera(scene.get(), &fov_only), BRUME_OK) << message(context.get());

    brume_density_term term = BRUME_DENSITY_TERM_INIT;
    brume_density_term only_type = cut(term, offsetof(brume_density_term, value));
    medium.term_count = 1;
    medium.terms = &only_type;
    EXPECT_EQ(brume_scene_set_medium(scene.get(), &medium), BRUME_OK) << message(context.get());

    brume_gaussian only_center = cut(brume_gaussian BRUME_GAUSSIAN_INIT, offsetof(brume_gaussian, scale));
    medium.gaussian_count = 1;
    medium.gaussians = &only_center;
    EXPECT_EQ(brume_scene_set_medium(scene.get(), &medium), BRUME_OK) << message(context.get());
    brume_light only_place = cut(brume_light BRUME_LIGHT_INIT, offsetof(brume_light, direction));
    EXPECT_EQ(brume_scene_set_lights(scene.get(), &only_place, 1), BRUME_OK) << message(context.get());
    EXPECT_EQ(brume_scene_set_lights(scene.get(), nullptr, 0), BRUME_OK) << message(context.get());

    const brume_image packed = cut(color_image, offsetof(brume_image, pixel_stride));
    brume_frame f = frame();
    f.color = &packed;
    brume_frame early_frame = cut(f, offsetof(brume_frame, inputs));
    EXPECT_EQ(brume_plan_execute(plan.get(), &early_frame), BRUME_OK) << message(context.get());

    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = BRUME_BACKEND_CPU;
    brume_context_desc early_desc = cut(desc, offsetof(brume_context_desc, gl_context));
    brume_context second = nullptr;
    ASSERT_EQ(brume_context_create(&early_desc, &second), BRUME_OK) << message(nullptr);
    brume_context_destroy(second);
}

// Elements of an array lie struct_size of the first apart, so an array of a newer header's longer structs is walked.
TEST_F(StructSize, ArraysAreWalkedByTheirOwnSize)
{
    struct NewerTerm {
        brume_density_term term = BRUME_DENSITY_TERM_INIT;
        double appended[2] = {};
    } terms[3];
    for (NewerTerm &newer : terms)
        newer.term.struct_size = sizeof newer;
    terms[2].term.value = -1;
    brume_medium medium = BRUME_MEDIUM_INIT;
    medium.term_count = 3;
    medium.terms = &terms[0].term;
    expect_status(context.get(), brume_scene_set_medium(scene.get(), &medium), BRUME_ERROR_ARGUMENT, "terms[2].value");
    terms[2].term.value = 1;
    expect_status(context.get(), brume_scene_set_medium(scene.get(), &medium), BRUME_OK, "");

    // A size of no struct's: elements lie where it says, aligned or not.
    alignas(8) unsigned char bytes[3 * (sizeof(brume_density_term) + 1)] = {};
    const brume_density_term term = BRUME_DENSITY_TERM_INIT;
    const uint32_t odd = sizeof term + 1;
    for (uint32_t i = 0; i < 3; ++i) {
        std::memcpy(bytes + i * odd, &term, sizeof term);
        std::memcpy(bytes + i * odd, &odd, sizeof odd);
    }
    medium.terms = reinterpret_cast<const brume_density_term *>(bytes);
    expect_status(context.get(), brume_scene_set_medium(scene.get(), &medium), BRUME_OK, "");
}
