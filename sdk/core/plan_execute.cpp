// A plan's frames: checked, run through the effects, timed.
#include <algorithm>
#include <cfloat>

#include <fmt/format.h>

#include "core/error.h"
#include "core/pixels.h"
#include "core/plan.h"
#include "core/plugin_lock.h"
#include "core/services.h"
#include "core/view.h"

using namespace brume;

namespace {

bool same_memory(const brume_image &a, const brume_image &b)
{
    const bool texture = a.kind != BRUME_IMAGE_HOST;
    if (texture != (b.kind != BRUME_IMAGE_HOST))
        return false;
    if (texture)
        return a.gl_texture == b.gl_texture;
    HostPixels pa(a), pb(b);
    return pa.begin() < pb.end() && pb.begin() < pa.end();
}

bool same_layout(const brume_image &a, const brume_image &b)
{
    HostPixels pa(a), pb(b);
    return pa.data == pb.data && pa.pixel == pb.pixel && pa.channels == pb.channels && pa.pixel_stride == pb.pixel_stride &&
           pa.row_stride == pb.row_stride;
}

}  // namespace

void brume_host_t::check_frame(const brume_frame &frame) const
{
    auto check = [&](const brume_image *image, const char *what, bool writable, uint32_t min_channels,
                     uint32_t max_channels) {
        if (!image)
            throw Error(BRUME_ERROR_ARGUMENT, std::string(what) + ": NULL");
        if (image->width != format_.width || image->height != format_.height)
            throw Error(BRUME_ERROR_FORMAT, std::string(what) + ": " + std::to_string(image->width) + " x " +
                                                std::to_string(image->height) + "; the plan was made for " +
                                                std::to_string(format_.width) + " x " + std::to_string(format_.height));
        if (image->channels < min_channels || image->channels > max_channels)
            throw Error(BRUME_ERROR_ARGUMENT, std::string(what) + ".channels: " + std::to_string(image->channels) +
                                                  "; expected " + std::to_string(min_channels) + " to " +
                                                  std::to_string(max_channels));
        if (image->origin != frame.color->origin)
            throw Error(BRUME_ERROR_ARGUMENT, std::string(what) + ".origin: differs from color.origin");
        context_->backend->check(*image, what, writable);
    };
    check(frame.color, "color", false, 1, 4);
    check(frame.output, "output", true, 1, 4);
    if (frame.output->channels != frame.color->channels)
        throw Error(BRUME_ERROR_ARGUMENT, "output.channels: " + std::to_string(frame.output->channels) +
                                              "; expected those of color, " + std::to_string(frame.color->channels));
    if (!does_nothing())
        check(frame.depth, "depth", false, 1, 1);
    uint32_t seen = 0;
    for (uint32_t i = 0; i < frame.extra_count; ++i) {
        const auto &extra = frame.extra[i];
        std::string name = "extra[" + std::to_string(i) + "]";
        if (extra.output == 0 || (extra.output & (extra.output - 1)) || !(extra.output & format_.outputs))
            throw Error(BRUME_ERROR_ARGUMENT, name + ".output: " + std::to_string(extra.output) +
                                                  "; expected one of the flags in the plan's format.outputs");
        bool of_light = extra.output == BRUME_OUTPUT_LIGHT_AIRLIGHT;
        if (extra.light >= (of_light ? scene_.lights.size() : 1))
            throw Error(BRUME_ERROR_ARGUMENT,
                        name + ".light: " + std::to_string(extra.light) + "; expected " +
                            (of_light ? "an index below " + std::to_string(scene_.lights.size()) : std::string("0")));
        bool again = seen & extra.output;
        if (of_light)
            again = std::any_of(frame.extra, frame.extra + i,
                                [&](auto &e) { return e.output == extra.output && e.light == extra.light; });
        if (again)
            throw Error(BRUME_ERROR_ARGUMENT, name + ".output: given twice");
        seen |= extra.output;
        bool scalar = extra.output == BRUME_OUTPUT_BLUR_RADIUS;
        check(extra.image, name.c_str(), true, scalar ? 1 : 3, scalar ? 1 : 4);
        bool shared = same_memory(*extra.image, *frame.color) || same_memory(*extra.image, *frame.output) ||
                      (frame.depth && same_memory(*extra.image, *frame.depth));
        for (uint32_t k = 0; k < i; ++k)
            shared = shared || same_memory(*extra.image, *frame.extra[k].image);
        if (shared)
            throw Error(BRUME_ERROR_ARGUMENT, name + ": shares memory with another image of the frame");
    }
    if (same_memory(*frame.color, *frame.output) && frame.color->kind == BRUME_IMAGE_HOST &&
        !same_layout(*frame.color, *frame.output))
        throw Error(BRUME_ERROR_ARGUMENT, "output: overlaps color; expected the very same image or none of its memory");
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
    brume_plugin_scene scene{};
    scene.struct_size = sizeof scene;
    fill_camera(scene_, view, format_, frame.color->origin, scene.camera);
    scene.has_medium = scene_.medium ? 1 : 0;
    evaluate_medium(scene_, frame.frame, view.camera_to_world, scene.medium);
    evaluate_content(frame.frame, view, scene);
    context_->backend->invoke([&] {
        check_frame(frame);
        scene.output_limit = context_->backend->pixel(*frame.output) == BRUME_PIXEL_F16 ? 65504.0f : FLT_MAX;
        timer_->begin();
        clamped_values_ = does_nothing() ? copy_frame(frame) : run_effects(frame, scene);
        timer_->end();
        context_->backend->flush();
    });
    if (clamped_values_ > 0 && !warned_of_clamping_)
        context_->log(BRUME_LOG_WARNING,
                      fmt::format("frame {}: {} values beyond 65504 clamped to fit half outputs; in further frames of this plan "
                                  "brume_plan_info.clamped_values alone tells",
                                  frame.frame, clamped_values_));
    warned_of_clamping_ = warned_of_clamping_ || clamped_values_ > 0;
}

int64_t brume_host_t::copy_frame(const brume_frame &frame)
{
    return same_memory(*frame.color, *frame.output) ? 0 : context_->backend->copy(*frame.color, *frame.output);
}

int64_t brume_host_t::run_effects(const brume_frame &frame, const brume_plugin_scene &scene)
{
    Backend &backend = *context_->backend;
    bool in_place = same_memory(*frame.color, *frame.output) || same_memory(*frame.depth, *frame.output);
    auto color = backend.import(*frame.color, 4);
    auto depth = backend.import(*frame.depth, 1);
    auto output = backend.begin_output(*frame.output, 4, !in_place);

    brume_plugin_frame seen{};
    seen.struct_size = sizeof seen;
    seen.scene = &scene;
    seen.depth = depth.get();
    std::vector<std::shared_ptr<Image>> extras;
    begin_extras(frame, extras, seen);

    std::vector<PlannedEffect *> running;
    for (auto &planned : effects_)
        if (planned.runs)
            running.push_back(&planned);
    current_scene_ = &scene;
    current_ = nullptr;
    failure_.clear();
    if (brume_status status = scene_images_.execute(*this, seen))
        throw Error(status, failure_);
    Image *input = color.get();
    for (size_t i = 0; i < running.size(); ++i) {
        seen.color = input;
        seen.output = i + 1 == running.size() ? output.get() : between_[i % 2].get();
        current_ = running[i];
        failure_.clear();
        brume_status status = BRUME_OK;
        auto held = hold_if_unsafe(running[i]->effect->table);
        try {
            status = running[i]->effect->table->execute(&services(), this, running[i]->state, &seen);
        } catch (const std::bad_alloc &) {
            throw;
        } catch (const std::exception &error) {
            throw Error(BRUME_ERROR_PLUGIN, running[i]->effect->name + ": threw in execute: " + error.what());
        } catch (...) {
            throw Error(BRUME_ERROR_PLUGIN, running[i]->effect->name + ": threw in execute");
        }
        if (status != BRUME_OK)
            effect_failed(*running[i]->effect, "execute", status);
        input = seen.output;
    }
    timer_->mark(-1);
    int64_t clamped = backend.finish_output(*frame.output, *output);
    for (uint32_t i = 0; i < frame.extra_count; ++i) {
        const int64_t more = backend.finish_output(*frame.extra[i].image, *extras[i]);
        clamped = clamped == not_counted || more == not_counted ? not_counted : clamped + more;
    }
    return clamped;
}

void brume_host_t::begin_extras(const brume_frame &frame, std::vector<std::shared_ptr<Image>> &extras,
                                brume_plugin_frame &seen)
{
    Backend &backend = *context_->backend;
    light_airlight_.assign(lights_.size(), nullptr);
    for (uint32_t i = 0; i < frame.extra_count; ++i) {
        const auto &extra = frame.extra[i];
        bool scalar = extra.output == BRUME_OUTPUT_BLUR_RADIUS;
        // Effects hold only their output to the limit of halves, so halves of these are not written directly.
        bool direct = backend.pixel(*extra.image) == BRUME_PIXEL_F32;
        extras.push_back(backend.begin_output(*extra.image, scalar ? 1 : 4, direct));
        seen.outputs |= extra.output;
        Image *image = extras.back().get();
        switch (extra.output) {
        case BRUME_OUTPUT_TRANSMITTANCE:
            seen.transmittance = image;
            break;
        case BRUME_OUTPUT_OPTICAL_DEPTH:
            seen.optical_depth = image;
            break;
        case BRUME_OUTPUT_SCATTERED:
            seen.scattered = image;
            break;
        case BRUME_OUTPUT_BLUR_RADIUS:
            seen.blur_radius = image;
            break;
        case BRUME_OUTPUT_AIRLIGHT:
            seen.airlight = image;
            break;
        case BRUME_OUTPUT_AIRLIGHT_ERROR:
            seen.airlight_error = image;
            break;
        case BRUME_OUTPUT_LIGHT_AIRLIGHT:
            light_airlight_[extra.light] = image;
            break;
        }
    }
    seen.light_airlight = light_airlight_.data();
}

std::vector<double> brume_host_t::measured_ms()
{
    std::vector<double> result;
    context_->backend->invoke([&] { result = timer_->milliseconds(int(entries_.size())); });
    return result;
}
