#include <bit>
#include <cmath>
#include <vector>

#include "api/handles.h"
#include "api/structs.h"
#include "core/effects.h"
#include "core/quality.h"

using namespace brume;
using namespace brume::api;

namespace brume::api {

brume_camera read_camera(const brume_camera *given, const char *name)
{
    brume_camera camera = BRUME_CAMERA_INIT;
    return read_struct(given, camera, name, &brume_camera::given, &brume_camera::vertical_fov, &brume_camera::pixel_aspect,
                       &brume_camera::center, &brume_camera::camera_to_world);
}

// Each flag once, and that of lights once for each of them.
constexpr uint32_t most_extras = uint32_t(std::popcount(known_outputs)) - 1 + BRUME_MAX_LIGHTS;

brume_format read_format(const brume_format *given)
{
    brume_format format = BRUME_FORMAT_INIT;
    format =
        read_struct(given, format, "brume_format", &brume_format::width, &brume_format::height, &brume_format::display_x,
                    &brume_format::display_y, &brume_format::display_width, &brume_format::display_height,
                    &brume_format::depth_kind, &brume_format::depth_range, &brume_format::far_distance, &brume_format::sky,
                    &brume_format::outputs, &brume_format::sky_distance, &brume_format::nonpositive);
    expect(format.width >= 1 && format.width <= 65536, "brume_format.width: expected 1 to 65536");
    expect(format.height >= 1 && format.height <= 65536, "brume_format.height: expected 1 to 65536");
    expect(format.display_width >= 0 && format.display_height >= 0 &&
               (format.display_width == 0) == (format.display_height == 0),
           "brume_format.display_width, display_height: expected both positive, or both 0");
    expect(format.depth_kind <= BRUME_DEPTH_DEVICE, "brume_format.depth_kind: expected a BRUME_DEPTH_...");
    expect(format.sky <= BRUME_SKY_CLAMP, "brume_format.sky: expected a BRUME_SKY_...");
    expect(format.nonpositive <= BRUME_NONPOSITIVE_NEAR, "brume_format.nonpositive: expected a BRUME_NONPOSITIVE_...");
    expect((format.outputs & ~known_outputs) == 0, "brume_format.outputs: expected BRUME_OUTPUT_... flags");
    expect(format.far_distance > 0, "brume_format.far_distance: expected a positive number");
    bool device = format.depth_kind == BRUME_DEPTH_DEVICE;
    if (device || format.depth_kind == BRUME_DEPTH_NORMALIZED)
        for (double end : format.depth_range)
            expect(device ? end > 0 : end >= 0 && std::isfinite(end),
                   device ? "brume_format.depth_range: expected two positive distances (one may be infinite)"
                          : "brume_format.depth_range: expected two finite distances of 0 or more");
    expect(!device || format.depth_range[0] != format.depth_range[1],
           "brume_format.depth_range: expected two different distances");
    expect(format.sky != BRUME_SKY_CLAMP || (format.sky_distance >= 0 && std::isfinite(format.sky_distance)),
           "brume_format.sky_distance: expected a finite distance of 0 or more");
    return format;
}

brume_image read_image(const brume_image *given, const char *name)
{
    brume_image image = BRUME_IMAGE_INIT;
    image = read_struct(given, image, name, &brume_image::kind, &brume_image::pixel, &brume_image::channels,
                        &brume_image::width, &brume_image::height, &brume_image::origin, &brume_image::gl_texture,
                        &brume_image::data, &brume_image::pixel_stride, &brume_image::row_stride);
    auto check = [&](bool good, const char *field, const char *expected) {
        if (!good)
            throw Error(BRUME_ERROR_ARGUMENT, std::string(name) + "." + field + ": expected " + expected);
    };
    check(image.kind <= BRUME_IMAGE_GL_TEXTURE_TRUSTED, "kind", "a BRUME_IMAGE_...");
    check(image.pixel <= BRUME_PIXEL_F16, "pixel", "a BRUME_PIXEL_...");
    check(image.channels >= 1 && image.channels <= 4, "channels", "1 to 4");
    check(image.origin <= BRUME_ORIGIN_BOTTOM_LEFT, "origin", "a BRUME_ORIGIN_...");
    if (image.kind != BRUME_IMAGE_HOST) {
        check(image.gl_texture != 0, "gl_texture", "the name of a texture");
    } else {
        check(image.data, "data", "memory");
        const int64_t size = (image.pixel == BRUME_PIXEL_F16 ? 2 : 4) * int64_t(image.channels);
        auto within = [](int64_t value, int64_t limit) { return value >= -limit && value <= limit; };
        check(within(image.pixel_stride, 65536) && (image.pixel_stride == 0 || std::abs(image.pixel_stride) >= size),
              "pixel_stride", "0, or at least the size of a pixel and at most 64 KiB");
        check(within(image.row_stride, int64_t(1) << 40), "row_stride", "at most 1 TiB");
        // Rows may interleave with the pixels of others (a transposed image); only overlap is refused.
        const int64_t pixel_step = image.pixel_stride ? std::abs(image.pixel_stride) : size;
        const int64_t row_step = std::abs(image.row_stride);
        check(row_step == 0 || image.width < 1 || image.height <= 1 || row_step >= pixel_step * (image.width - 1) + size ||
                  (row_step >= size && pixel_step >= row_step * (image.height - 1) + size),
              "row_stride", "0, or rows that do not overlap");
    }
    return image;
}

}  // namespace brume::api

namespace {

template <class Function> brume_status with_plan(brume_plan plan, Function function)
{
    if (!plan)
        return barrier(nullptr, [] { expect(false, "plan: NULL"); });
    return barrier(plan->context.get(), [&] { function(*plan->plan); });
}

}  // namespace

extern "C" {

brume_status brume_plan_create(brume_scene scene, const brume_format *format, brume_plan *out)
{
    if (out)
        *out = nullptr;
    if (!scene)
        return barrier(nullptr, [] { expect(false, "scene: NULL"); });
    return barrier(scene->context.get(), [&] {
        expect(out, "out: NULL");
        Chosen chosen = plan_with_quality(scene->context, scene->scene, read_format(format));
        *out = new brume_plan_t{scene->context, std::move(chosen.plan), std::move(chosen.quality)};
    });
}

void brume_plan_destroy(brume_plan plan)
{
    if (plan)
        plan->plan.reset();
    delete plan;
}

brume_status brume_plan_get_info(brume_plan handle, brume_plan_info *info)
{
    return with_plan(handle, [&](brume_host_t &plan) {
        double predicted = 0;
        for (const PlanEntry &entry : plan.entries())
            predicted += entry.predicted_ms;
        write_struct(info,
                     {0, uint32_t(plan.entries().size()), plan.does_nothing() ? 1u : 0u, plan.camera_needs(),
                      plan.camera_reason().c_str(), plan.image_bytes(), predicted, plan.predicted_error(),
                      handle->quality.c_str(), plan.clamped_values()},
                     "brume_plan_info");
    });
}

brume_status brume_plan_get_entry(brume_plan handle, uint32_t index, brume_plan_entry *out)
{
    return with_plan(handle, [&](brume_host_t &plan) {
        if (index >= plan.entries().size())
            throw Error(BRUME_ERROR_ARGUMENT, "index: " + std::to_string(index) + "; the plan has " +
                                                  std::to_string(plan.entries().size()) + " entries");
        const PlanEntry &entry = plan.entries()[index];
        auto measured = plan.measured_ms();
        write_struct(out,
                     {0, entry.runs ? 1u : 0u, entry.effect.c_str(), entry.name.c_str(), entry.reason.c_str(), entry.bytes,
                      entry.operations, entry.predicted_ms, measured.empty() ? -1.0 : measured[index]},
                     "brume_plan_entry");
    });
}

brume_status brume_plan_execute(brume_plan handle, const brume_frame *given)
{
    return with_plan(handle, [&](brume_host_t &plan) {
        brume_frame frame = BRUME_FRAME_INIT;
        frame = read_struct(given, frame, "brume_frame", &brume_frame::extra_count, &brume_frame::color, &brume_frame::depth,
                            &brume_frame::output, &brume_frame::extra, &brume_frame::camera, &brume_frame::frame);
        expect(std::isfinite(frame.frame), "brume_frame.frame: expected a finite number");
        brume_image color = read_image(frame.color, "color");
        brume_image output = read_image(frame.output, "output");
        frame.color = &color;
        frame.output = &output;
        brume_image depth;
        if (frame.depth) {
            depth = read_image(frame.depth, "depth");
            frame.depth = &depth;
        }
        brume_camera camera;
        if (frame.camera) {
            camera = read_camera(frame.camera, "camera");
            frame.camera = &camera;
        }
        if (frame.extra_count > most_extras)
            throw Error(BRUME_ERROR_ARGUMENT, "brume_frame.extra_count: " + std::to_string(frame.extra_count) +
                                                  "; expected 0 to " + std::to_string(most_extras));
        expect(frame.extra || frame.extra_count == 0, "brume_frame.extra: NULL with an extra_count above 0");
        std::vector<brume_extra_output> extras(frame.extra_count);
        std::vector<brume_image> images(frame.extra_count);
        for (uint32_t i = 0; i < frame.extra_count; ++i) {
            std::string name = "extra[" + std::to_string(i) + "]";
            extras[i] = read_struct(element(frame.extra, i), brume_extra_output BRUME_EXTRA_OUTPUT_INIT, name.c_str(),
                                    &brume_extra_output::output, &brume_extra_output::image, &brume_extra_output::light);
            images[i] = read_image(extras[i].image, (name + ".image").c_str());
            extras[i].image = &images[i];
        }
        frame.extra = extras.data();
        plan.execute(frame);
    });
}

}  // extern "C"
