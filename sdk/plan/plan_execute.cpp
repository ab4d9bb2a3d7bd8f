// A plan's frames: checked, run through the effects, timed.
#include <algorithm>
#include <cfloat>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image_memory.h"
#include "plan/plan.h"
#include "effects/plugin_lock.h"
#include "plan/services.h"

using namespace brume;

namespace {

constexpr int64_t most_scale = 16;  // of depth, to larger or smaller; as brume.h says

// Whether depth shows the picture of a format: there is one factor for both sides of which rounding, up or down, makes its
// own. What is a pixel off is more likely a mistake than a factor.
bool is_scaled(const brume_image &depth, const Format &format)
{
    const int64_t width = format.width, height = format.height;
    if (depth.width == width && depth.height == height)
        return true;
    auto in_range = [](int64_t a, int64_t b) { return a <= most_scale * b && b <= most_scale * a; };
    return in_range(depth.width, width) && in_range(depth.height, height) &&
           (std::abs(depth.width - width) > 1 || std::abs(depth.height - height) > 1) &&
           (depth.width - 1) * height < (depth.height + 1) * width &&
           (depth.height - 1) * width < (depth.width + 1) * height;
}

enum class Sizes { format, scaled, any };

}  // namespace

void brume_host_t::check_frame(const brume_frame &frame) const
{
    auto check = [&](const brume_image *image, const char *what, bool writable, uint32_t most_channels,
                     Sizes sizes = Sizes::format) {
        if (!image)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: NULL", what));
        const int32_t largest = context_->backend->largest_size();
        if (sizes != Sizes::format &&
            (image->width < 1 || image->height < 1 || image->width > largest || image->height > largest))
            throw Error(BRUME_ERROR_FORMAT,
                        fmt::format("{}: {}; expected sides from 1 to {}", what, extent_text(*image), largest));
        if (sizes == Sizes::format && (image->width != format_.width || image->height != format_.height))
            throw Error(BRUME_ERROR_FORMAT, fmt::format("{}: {}; the plan was made for {} x {}", what, extent_text(*image),
                                                        format_.width, format_.height));
        if (sizes == Sizes::scaled && !is_scaled(*image, format_))
            throw Error(BRUME_ERROR_FORMAT,
                        fmt::format("{}: {}; the plan was made for {} x {}; expected that size, or both sides larger or "
                                    "smaller by one factor, at most {}",
                                    what, extent_text(*image), format_.width, format_.height, most_scale));
        if (image->channels > most_channels)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.channels: {}; expected 1{}", what, image->channels,
                                                          most_channels > 1 ? " to 4" : ""));
        if (image->origin != frame.color->origin)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}.origin: differs from color.origin", what));
        try {
            context_->backend->check(*image, what, writable);
        } catch (const Error &error) {
            if (!is_part(*image))
                throw;
            throw Error(error.status(), fmt::format("{} (the image is {})", error.what(), extent_text(*image)));
        }
    };
    check(frame.color, "color", false, 4);
    check(frame.output, "output", true, 4);
    if (frame.output->channels != frame.color->channels)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("output.channels: {}; expected those of color, {}",
                                                      frame.output->channels, frame.color->channels));
    if (!does_nothing())
        check(frame.depth, "depth", false, 1, Sizes::scaled);
    layers_.check(frame, scene_.lights.size());
    for (uint32_t i = 0; i < frame.input_count; ++i)
        check(frame.inputs[i].image, frame.inputs[i].name, false, 4,
              layers_.has_any_size(frame.inputs[i].name) ? Sizes::any : Sizes::format);
    for (uint32_t i = 0; i < frame.output_count; ++i)
        check(frame.outputs[i].image, frame.outputs[i].name, true, 4);
    if (same_memory(*frame.color, *frame.output) && !same_image(*frame.color, *frame.output))
        throw Error(BRUME_ERROR_ARGUMENT, "output: overlaps color; expected the very same image or none of its memory" +
                                              extents_text("output", *frame.output, "color", *frame.color));
}

void brume_host_t::execute(const brume_frame &frame)
{
    if (!frame.color || !frame.output)
        throw Error(BRUME_ERROR_ARGUMENT, frame.color ? "output: NULL" : "color: NULL");
    if (frame.camera)
        check_camera(*frame.camera);
    View view = view_of(scene_, frame.camera, frame.frame, format_);
    if (uint32_t missing = camera_needs_ & ~view.given) {
        std::string what = missing & BRUME_CAMERA_FIELD_OF_VIEW ? "a field of view" : "";
        if (missing & BRUME_CAMERA_POSE)
            what += what.empty() ? "a pose (camera_to_world)" : " and a pose (camera_to_world)";
        throw Error(BRUME_ERROR_CAMERA, "camera: " + what + " is missing; needed because " + camera_reason_);
    }
    content_.at(scene_, frame.frame, view, format_, frame.color->origin);
    context_->backend->invoke([&] {
        check_frame(frame);
        content_.set_output_limit(context_->backend->pixel(*frame.output) == BRUME_PIXEL_F16 ? 65504.0f : FLT_MAX);
        timer_->begin();
        clamped_values_ = does_nothing() ? copy_frame(frame) : run_effects(frame);
        timer_->end();
        context_->backend->flush();
    });
    if (clamped_values_ > 0 && !context_->warned_of_clamping) {
        context_->warned_of_clamping = true;
        context_->log(BRUME_LOG_WARNING,
                      fmt::format("frame {}: {} values beyond 65504 clamped to fit half outputs; of further frames "
                                  "brume_plan_info.clamped_values alone tells",
                                  frame.frame, clamped_values_));
    }
}

int64_t brume_host_t::copy_frame(const brume_frame &frame)
{
    return same_memory(*frame.color, *frame.output) ? 0 : context_->backend->copy(*frame.color, *frame.output);
}

int64_t brume_host_t::run_effects(const brume_frame &frame)
{
    Backend &backend = *context_->backend;
    bool in_place = same_memory(*frame.color, *frame.output) || same_memory(*frame.depth, *frame.output);
    auto color = backend.import(*frame.color, 4);
    auto depth = backend.import_depth(*frame.depth, format_.width, format_.height);
    auto output = backend.begin_output(*frame.output, 4, !in_place);
    layers_.begin(frame, scene_.lights.size(), backend);
    frame_bytes_ = color->bytes + depth->bytes + output->bytes + layers_.bytes();

    brume_plugin_frame seen{};
    seen.struct_size = sizeof seen;
    seen.scene = &content_.scene();
    seen.depth = depth.get();
    current_ = nullptr;
    failure_.clear();
    host_products_.execute(*this, content_.scene(), depth.get(), layers_);
    brume_plugin_image input = color.get();
    for (size_t i = 0; i < running_.size(); ++i) {
        seen.color = input;
        seen.output = i + 1 == running_.size() ? output.get() : between_[i % 2];
        run_effect(*running_[i], seen);
        input = seen.output;
    }
    timer_->mark(-1);
    int64_t clamped = backend.finish_output(*frame.output, *output);
    const int64_t more = layers_.finish(frame, backend);
    layers_.release();
    return clamped == not_counted || more == not_counted ? not_counted : clamped + more;
}

void brume_host_t::run_effect(PlannedEffect &planned, brume_plugin_frame &seen)
{
    layers_.see(planned.layer_places, planned.layers);
    planned.products.clear();
    for (const Products::Product *product : planned.uses)
        planned.products.push_back(Products::seen(*product));
    seen.layers = planned.layers.data();
    seen.layer_count = uint32_t(planned.layers.size());
    seen.products = planned.products.data();
    seen.product_count = uint32_t(planned.products.size());
    current_ = &planned;
    failure_.clear();
    brume_status status = BRUME_OK;
    auto held = hold_if_unsafe(planned.effect->table);
    try {
        status = planned.effect->table->execute(&services(), this, planned.state, &seen);
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in execute: " + error.what());
    } catch (...) {
        throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in execute");
    }
    context_->progress.throw_if_cancelled();
    if (status != BRUME_OK)
        effect_failed(*planned.effect, "execute", status);
}

std::vector<double> brume_host_t::measured_ms()
{
    std::vector<double> result;
    context_->backend->invoke([&] { result = timer_->milliseconds(int(entries_.size())); });
    return result;
}
