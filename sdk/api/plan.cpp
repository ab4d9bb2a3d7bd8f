#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "api/handles.h"
#include "api/structs.h"
#include "base/pixels.h"
#include "effects/effects.h"
#include "plan/quality.h"

using namespace brume;
using namespace brume::api;

namespace brume::api {

brume_camera read_camera(const brume_camera *given, const char *name)
{
    brume_camera camera = BRUME_CAMERA_INIT;
    return read_struct(given, camera, name, &brume_camera::given, &brume_camera::vertical_fov, &brume_camera::pixel_aspect,
                       &brume_camera::center, &brume_camera::camera_to_world);
}

namespace {

// A caller's layers by their stride; of formats without their images. Names for messages are made only where something is
// wrong.
void read_layers(const brume_layer *given, uint32_t count, const char *name, bool of_frame, std::vector<brume_layer> &layers)
{
    if (count > BRUME_MAX_LAYERS)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: {} layers; expected 0 to {}", name, count, BRUME_MAX_LAYERS));
    if (count > 0 && !given)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: NULL; expected {} layers", name, count));
    layers.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        auto refuse = [&](const std::string &problem) {
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}[{}]{}", name, i, problem));
        };
        brume_layer &layer = layers[i];
        layer = read_struct(element(given, i), brume_layer BRUME_LAYER_INIT, name, &brume_layer::kind, &brume_layer::name,
                            &brume_layer::image, &brume_layer::light, &brume_layer::reserved);
        if (!layer.name || !*layer.name)
            refuse(fmt::format(".name: {}; expected that of a layer", layer.name ? "empty" : "NULL"));
        if (layer.kind > BRUME_LAYER_CAMERA)
            refuse(fmt::format(".kind: {}; expected a BRUME_LAYER_...", layer.kind));
        if (layer.reserved != 0)
            refuse(fmt::format(".reserved: {}; expected 0", layer.reserved));
        for (uint32_t k = 0; k < i && !of_frame; ++k)
            if (std::string_view(layers[k].name) == layer.name)
                refuse(fmt::format(" ({}): given twice", layer.name));
    }
}

}  // namespace

Format read_format(const brume_format *given)
{
    brume_format format = BRUME_FORMAT_INIT;
    format =
        read_struct(given, format, "brume_format", &brume_format::width, &brume_format::height, &brume_format::display_x,
                    &brume_format::display_y, &brume_format::display_width, &brume_format::display_height,
                    &brume_format::depth_kind, &brume_format::depth_range, &brume_format::far_distance, &brume_format::sky,
                    &brume_format::input_count, &brume_format::sky_distance, &brume_format::nonpositive,
                    &brume_format::output_count, &brume_format::inputs, &brume_format::outputs);
    expect(format.width >= 1 && format.width <= 65536, "brume_format.width", format.width, "1 to 65536");
    expect(format.height >= 1 && format.height <= 65536, "brume_format.height", format.height, "1 to 65536");
    expect(format.display_width >= 0 && format.display_height >= 0 &&
               (format.display_width == 0) == (format.display_height == 0),
           "brume_format.display_width, display_height", fmt::format("{}, {}", format.display_width, format.display_height),
           "both positive, or both 0");
    expect(format.depth_kind <= BRUME_DEPTH_DEVICE, "brume_format.depth_kind", format.depth_kind, "a BRUME_DEPTH_...");
    expect(format.sky <= BRUME_SKY_CLAMP, "brume_format.sky", format.sky, "a BRUME_SKY_...");
    expect(format.nonpositive <= BRUME_NONPOSITIVE_NEAR, "brume_format.nonpositive", format.nonpositive,
           "a BRUME_NONPOSITIVE_...");
    expect(format.far_distance > 0, "brume_format.far_distance", format.far_distance, "a positive number");
    const auto &range = format.depth_range;
    const std::string given_range = fmt::format("{}, {}", range[0], range[1]);
    bool device = format.depth_kind == BRUME_DEPTH_DEVICE;
    if (device || format.depth_kind == BRUME_DEPTH_NORMALIZED)
        for (double end : range)
            expect(device ? end > 0 : end >= 0 && std::isfinite(end), "brume_format.depth_range", given_range,
                   device ? "two positive distances (one may be infinite)" : "two finite distances of 0 or more");
    expect(!device || range[0] != range[1], "brume_format.depth_range", given_range, "two different distances");
    expect(format.sky != BRUME_SKY_CLAMP || (format.sky_distance >= 0 && std::isfinite(format.sky_distance)),
           "brume_format.sky_distance", format.sky_distance, "a finite distance of 0 or more");
    std::vector<brume_layer> inputs, outputs;
    read_layers(format.inputs, format.input_count, "brume_format.inputs", false, inputs);
    read_layers(format.outputs, format.output_count, "brume_format.outputs", false, outputs);
    format.inputs = inputs.data();
    format.outputs = outputs.data();
    return format;
}

namespace {

// What is all of its whole is no part, and is not copied as one.
void check_part(brume_image &image, const char *name)
{
    const bool whole = image.whole_width == 0 && image.whole_height == 0;
    auto within = [](int64_t first, int64_t count, int64_t all) {
        return all <= 65536 && first >= 0 && count >= 1 && first + count <= all;
    };
    if (whole ? image.x != 0 || image.y != 0
              : !within(image.x, image.width, image.whole_width) || !within(image.y, image.height, image.whole_height))
        throw Error(
            BRUME_ERROR_ARGUMENT,
            fmt::format("{}: {} x {} at ({}, {}) of whole_width x whole_height {} x {}; expected {}", name, image.width,
                        image.height, image.x, image.y, image.whole_width, image.whole_height,
                        whole ? "the size of what it is a part of" : "a part that lies within, of at most 65536 a side"));
    if (image.width == image.whole_width && image.height == image.whole_height)
        image = whole_of(image);
}

}  // namespace

brume_image read_image(const brume_image *given, const char *name)
{
    brume_image image = BRUME_IMAGE_INIT;
    image = read_struct(given, image, name, &brume_image::kind, &brume_image::pixel, &brume_image::channels,
                        &brume_image::width, &brume_image::height, &brume_image::origin, &brume_image::gl_texture,
                        &brume_image::data, &brume_image::pixel_stride, &brume_image::row_stride, &brume_image::plane_stride,
                        &brume_image::x, &brume_image::y, &brume_image::whole_width, &brume_image::whole_height);
    auto check = [&](bool good, const char *field, auto value, const char *expected) {
        if (!good)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.{}: {}; expected {}", name, field, value, expected));
    };
    check(image.kind <= BRUME_IMAGE_GL_TEXTURE_TRUSTED, "kind", image.kind, "a BRUME_IMAGE_...");
    check(image.pixel <= BRUME_PIXEL_F16, "pixel", image.pixel, "a BRUME_PIXEL_...");
    check(image.channels >= 1 && image.channels <= 4, "channels", image.channels, "1 to 4");
    check(image.origin <= BRUME_ORIGIN_BOTTOM_LEFT, "origin", image.origin, "a BRUME_ORIGIN_...");
    check_part(image, name);
    if (image.kind != BRUME_IMAGE_HOST) {
        check(image.gl_texture != 0, "gl_texture", 0, "the name of a texture");
        return image;
    }
    check(image.data, "data", "NULL", "memory");
    const int64_t sample = image.pixel == BRUME_PIXEL_F16 ? 2 : 4;
    const int64_t pixel = image.plane_stride ? sample : sample * int64_t(image.channels);
    auto within = [](int64_t value, int64_t limit) { return value >= -limit && value <= limit; };
    check(within(image.pixel_stride, 65536) && (image.pixel_stride == 0 || std::abs(image.pixel_stride) >= pixel),
          "pixel_stride", image.pixel_stride, "0, or at least the size of a pixel and at most 64 KiB");
    check(within(image.row_stride, int64_t(1) << 40), "row_stride", image.row_stride, "at most 1 TiB");
    check(within(image.plane_stride, int64_t(1) << 50), "plane_stride", image.plane_stride, "at most 1 PiB");
    // Whatever lies farther apart must step over all that lies closer together: rows may interleave with the pixels of
    // others (a transposed image) and planes with rows; only overlap is refused.
    const brume_image whole = whole_of(image);
    const int64_t width = std::clamp(whole.width, 1, 65536), height = std::clamp(whole.height, 1, 65536);
    struct Step {
        int64_t bytes, count;
        const char *name;
        int order;
    };
    const int64_t pixel_step = image.pixel_stride ? std::abs(image.pixel_stride) : pixel;
    Step steps[] = {{image.plane_stride ? std::abs(image.plane_stride) : sample, image.channels, "plane_stride", 0},
                    {pixel_step, width, "pixel_stride", 1},
                    {image.row_stride ? std::abs(image.row_stride) : pixel_step * width, height, "row_stride", 2}};
    std::sort(std::begin(steps), std::end(steps),
              [](const Step &x, const Step &y) { return std::tie(x.bytes, x.order) < std::tie(y.bytes, y.order); });
    int64_t extent = sample;
    for (const Step &step : steps) {
        if (step.count == 1)
            continue;
        if (step.bytes < extent)
            check(false, image.plane_stride ? step.name : "row_stride",
                  fmt::format("{} bytes between what takes {}", step.bytes, extent),
                  "channels, pixels and rows that do not overlap");
        extent += step.bytes * (step.count - 1);
    }
    return image;
}

}  // namespace brume::api

namespace {

// A frame's layers with their images read.
const brume_layer *read_frame_layers(const brume_layer *given, uint32_t count, const char *name, LayersOfFrame &out)
{
    read_layers(given, count, name, true, out.layers);
    out.images.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        try {
            out.images[i] = read_image(out.layers[i].image, "image");
        } catch (const Error &error) {
            throw Error(error.status(), fmt::format("{}[{}] ({}).{}", name, i, out.layers[i].name, error.what()));
        }
        out.layers[i].image = &out.images[i];
    }
    return out.layers.data();
}

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
        *out = new brume_plan_t{scene->context, std::move(chosen.plan), std::move(chosen.quality), {}, {}};
    });
}

brume_status brume_plan_update(brume_plan handle, brume_scene scene, const brume_format *format)
{
    return with_plan(handle, [&](brume_host_t &plan) {
        expect(scene, "scene: NULL");
        if (!format)
            return plan.update(scene->scene, nullptr);
        const Format next = read_format(format);
        plan.update(scene->scene, &next);
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
        frame = read_struct(given, frame, "brume_frame", &brume_frame::input_count, &brume_frame::color, &brume_frame::depth,
                            &brume_frame::output, &brume_frame::inputs, &brume_frame::outputs, &brume_frame::output_count,
                            &brume_frame::reserved, &brume_frame::camera, &brume_frame::frame);
        expect(frame.reserved == 0, "brume_frame.reserved", frame.reserved, "0");
        expect(std::isfinite(frame.frame), "brume_frame.frame", frame.frame, "a finite number");
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
        frame.inputs = read_frame_layers(frame.inputs, frame.input_count, "inputs", handle->inputs);
        frame.outputs = read_frame_layers(frame.outputs, frame.output_count, "outputs", handle->outputs);
        Progress &progress = handle->context->progress;
        progress.begin();
        plan.execute(frame);
        progress.end();
    });
}

}  // extern "C"
