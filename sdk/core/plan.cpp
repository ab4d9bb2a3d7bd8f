#include "core/plan.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>

#include "core/error.h"
#include "core/plugin_lock.h"
#include "core/services.h"
#include "core/view.h"

using namespace brume;

namespace {

const std::string host_name = "brume";  // of the host's own entries
constexpr uint32_t most_offers = 64;

// What a rehearsal hands out in place of images and programs.
Image *image_of_rehearsal()
{
    static Image image;
    return &image;
}
Program *program_of_rehearsal()
{
    static Program program;
    return &program;
}

bool on_llvmpipe(const Backend &backend)
{
    return backend.device().find("llvmpipe") != std::string::npos;
}

std::string output_names(uint32_t outputs)
{
    const char *const names[] = {"transmittance", "optical depth",  "scattered",          "blur radius",
                                 "airlight",      "airlight error", "airlight of a light"};
    std::string text;
    for (uint32_t i = 0; i < std::size(names); ++i)
        if (outputs & (1u << i))
            text += (text.empty() ? "" : ", ") + std::string(names[i]);
    return text;
}

}  // namespace

brume_host_t::brume_host_t(std::shared_ptr<Context> context, Scene scene, const brume_format &format, Purpose purpose)
    : context_(std::move(context)), scene_(std::move(scene)), format_(format), rehearsal_(purpose == Purpose::rehearsal)
{
    context_->backend->invoke([&] {
        int32_t largest = context_->backend->largest_size();
        if (format_.width > largest || format_.height > largest)
            throw Error(BRUME_ERROR_UNSUPPORTED, "format: " + std::to_string(format_.width) + " x " +
                                                     std::to_string(format_.height) + "; this device takes up to " +
                                                     std::to_string(largest) + " a side");
        try {
            plan_effects();
            if (!rehearsal_)
                timer_ = context_->backend->create_timer();
        } catch (...) {
            destroy_states();
            data_.clear();
            images_.clear();
            between_[0] = between_[1] = nullptr;
            programs_.clear();
            context_->backend->trim();
            throw;
        }
    });
}

brume_host_t::~brume_host_t()
{
    try {
        context_->backend->invoke([&] {
            destroy_states();
            data_.clear();
            images_.clear();
            between_[0] = between_[1] = nullptr;
            programs_.clear();
            timer_.reset();
        });
    } catch (const std::exception &error) {
        context_->log(BRUME_LOG_ERROR, std::string("plan: ") + error.what());
    }
}

void brume_host_t::destroy_states() noexcept
{
    for (auto &planned : effects_) {
        if (!planned.state)
            continue;
        try {
            auto held = hold_if_unsafe(planned.effect->table);
            planned.effect->table->destroy(planned.state);
        } catch (...) {
            context_->log(BRUME_LOG_ERROR, planned.effect->name + ": threw in destroy");
        }
        planned.state = nullptr;
    }
}

bool brume_host_t::does_nothing() const
{
    return std::none_of(effects_.begin(), effects_.end(), [](auto &planned) { return planned.runs; });
}

bool brume_host_t::lights_scatter() const
{
    return std::any_of(effects_.begin(), effects_.end(),
                       [](auto &planned) { return planned.effect->wanted == BRUME_WANTED_WITH_LIGHTS; });
}

void brume_host_t::plan_effects()
{
    const auto &registry = context_->effects;
    for (const EffectSettings &settings : scene_.effects)
        effects_.push_back({.effect = &registry.find(settings.name)});
    for (const Effect &effect : registry.all()) {
        bool lit = !scene_.lights.empty() || !scene_.environment.coefficients.empty();
        bool needed = scene_.medium && !scene_.effects_named && effect.refusal.empty() &&
                      (effect.wanted == BRUME_WANTED_WITH_MEDIUM || (effect.wanted == BRUME_WANTED_WITH_LIGHTS && lit));
        if (needed && std::none_of(effects_.begin(), effects_.end(), [&](auto &p) { return p.effect == &effect; }))
            effects_.push_back({.effect = &effect});
        if (!needed && !lit && scene_.medium && !scene_.effects_named && effect.refusal.empty() &&
            effect.wanted == BRUME_WANTED_WITH_LIGHTS)
            entries_.push_back({false, effect.name, effect.name, "no lights and no environment", 0, 0, 0});
    }
    std::sort(effects_.begin(), effects_.end(), [](const auto &a, const auto &b) {
        return std::pair(a.effect->order, a.effect->name) < std::pair(b.effect->order, b.effect->name);
    });
    if (!scene_.medium && scene_.effects.empty())
        entries_.push_back({false, "brume", "medium", "the scene has no medium: nothing to do", 0, 0, 0});
    if (!scene_.lights.empty() && !lights_scatter())
        entries_.push_back({false, "brume", "lights",
                            std::to_string(scene_.lights.size()) + " lights: no effect of this scene reads them", 0, 0, 0});

    for (auto &planned : effects_) {
        for (const Parameter &parameter : planned.effect->parameters)
            planned.parameters.push_back(parameter.default_value);
        for (const EffectSettings &settings : scene_.effects)
            if (settings.name == planned.effect->name)
                for (auto &[name, value] : settings.parameters)
                    planned.parameters[find_parameter(*planned.effect, name)] = value;
    }
    brume_plugin_scene scene{};
    scene.struct_size = sizeof scene;
    View view = view_of(scene_, nullptr, 0, format_);
    fill_camera(scene_, view, format_, BRUME_ORIGIN_TOP_LEFT, scene.camera);
    scene.has_medium = scene_.medium ? 1 : 0;
    evaluate_medium(with_peak_medium(scene_), 0, view.camera_to_world, scene.medium);
    scene.output_limit = FLT_MAX;
    plan_content(view, scene);
    uint32_t filled = 0;
    bool attenuated = false;
    for (auto &planned : effects_) {
        plan_effect(planned, scene, attenuated);
        filled |= planned.runs ? planned.effect->table->outputs : 0;
        attenuated = attenuated || (planned.runs && planned.effect->table->attenuates);
    }
    if (uint32_t missing = format_.outputs & ~filled)
        throw Error(BRUME_ERROR_UNSUPPORTED, "format.outputs: nothing that runs fills " + output_names(missing) +
                                                 (entries_.empty() ? "" : " (" + entries_.back().reason + ")"));

    auto running = std::count_if(effects_.begin(), effects_.end(), [](auto &planned) { return planned.runs; });
    for (int i = 0; i < std::min<int>(int(running) - 1, 2) && !rehearsal_; ++i) {
        between_[i] = context_->backend->create_image(format_.width, format_.height, 4, BRUME_PIXEL_F32);
        image_bytes_ += uint64_t(format_.width) * uint64_t(format_.height) * 16;
    }
    for (auto &entry : entries_)
        if (entry.runs)
            entry.predicted_ms =
                context_->rates.milliseconds(*context_->backend, entry.effect, entry.name, entry.operations, entry.bytes);
}

// Lights, environment and Gaussians as effects see them when planning. Of Gaussians only that there are some where files
// bring them with the frame, or frames the camera.
void brume_host_t::plan_content(const View &view, brume_plugin_scene &scene)
{
    if (!scene_.environment.file.empty() && scene_.environment.coefficients.empty())
        throw Error(BRUME_ERROR_SCENE,
                    "environment.file: " + scene_.environment.file +
                        " is not read by the library; expected brume_scene_set_environment to have been called");
    for (auto &c : scene_.environment.coefficients)
        environment_.push_back({float(c[0]), float(c[1]), float(c[2])});
    evaluate_lights(scene_, 0, view.camera_to_world, lights_);
    scene.lights = lights_.data();
    scene.light_count = uint32_t(lights_.size());
    scene.environment = environment_.empty() ? nullptr : reinterpret_cast<const float(*)[3]>(environment_.data());
    scene.environment_count = uint32_t(environment_.size());
    const bool any_gaussians = has_gaussians(scene_);
    scene.gaussian_count = any_gaussians ? 1 : 0;
    const uint32_t placed = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    if (any_gaussians && (view.given & placed) == placed && !reads_gaussians_by_frame(scene_)) {
        evaluate_gaussians(scene_, 0, view.camera_to_world, gaussians_);
        if (!gaussians_.empty()) {
            scene.gaussians = gaussians_.data();
            scene.gaussian_count = uint32_t(gaussians_.size());
        }
    }
    if (effects_.empty())
        return;
    if (any_gaussians)
        need_camera(placed, "the medium's Gaussians are placed in the world");
    scene_images_.plan(*this, scene, format_, context_->backend->kind());
}

void brume_host_t::warn_on_software_gl(const std::string &message)
{
    if (warned_ || !on_llvmpipe(*context_->backend))
        return;
    warned_ = true;
    context_->log(BRUME_LOG_WARNING, message);
}

void brume_host_t::evaluate_content(double frame, const View &view, brume_plugin_scene &scene)
{
    if (scene_.animated() && frame != content_frame_)
        ++revision_;
    content_frame_ = frame;
    scene.revision = revision_;
    evaluate_lights(scene_, frame, view.camera_to_world, lights_);
    evaluate_gaussians(scene_, frame, view.camera_to_world, gaussians_);
    scene.lights = lights_.data();
    scene.light_count = uint32_t(lights_.size());
    scene.gaussians = gaussians_.data();
    scene.gaussian_count = uint32_t(gaussians_.size());
    scene.environment = environment_.empty() ? nullptr : reinterpret_cast<const float(*)[3]>(environment_.data());
    scene.environment_count = uint32_t(environment_.size());
    for (size_t i = 0; i < 3; ++i)
        scene.position[i] = view.camera_to_world[4 * i + 3] * scene_.metres_per_unit;
}

void brume_host_t::plan_effect(PlannedEffect &planned, const brume_plugin_scene &scene, bool attenuated)
{
    brume_plugin_request request{};
    request.struct_size = sizeof request;
    request.backend = context_->backend->kind();
    request.width = format_.width;
    request.height = format_.height;
    request.outputs = format_.outputs;
    request.parameter_count = uint32_t(planned.parameters.size());
    request.parameters = planned.parameters.data();
    request.scene = &scene;
    request.animated = scene_.animated() ? 1 : 0;
    request.pose_matters = pose_matters(scene_) ? 1 : 0;
    request.attenuated = attenuated ? 1 : 0;
    request.lights_scatter = lights_scatter() ? 1 : 0;
    request.transmittance = scene_.quality.transmittance;
    request.detail = scene_.quality.detail;
    current_ = &planned;
    failure_.clear();
    size_t first = entries_.size();
    brume_status status = BRUME_OK;
    auto held = hold_if_unsafe(planned.effect->table);
    try {
        status = planned.effect->table->plan(&services(), this, &request, &planned.state);
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in plan: " + error.what());
    } catch (...) {
        throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in plan");
    }
    if (status != BRUME_OK)
        effect_failed(*planned.effect, "plan", status);
    planned.runs = std::any_of(entries_.begin() + ptrdiff_t(first), entries_.end(), [](auto &e) { return e.runs; });
    if (entries_.size() == first)
        throw Error(BRUME_ERROR_PLUGIN,
                    planned.effect->name + ": plan added no entry; expected one that runs or says why nothing does");
    if (planned.runs && planned.effect->offer)
        take_offers(planned, request);
    current_ = nullptr;
}

void brume_host_t::take_offers(PlannedEffect &planned, brume_plugin_request request)
{
    for (uint32_t i = 0; i < most_offers; ++i) {
        Offer offer{planned.parameters, 0};
        request.parameters = planned.parameters.data();
        try {
            if (!planned.effect->offer(&request, i, offer.parameters.data(), &offer.error))
                return;
        } catch (...) {
            throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in offer");
        }
        if (!std::isfinite(offer.error) || offer.error < 0)
            throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": offer " + std::to_string(i) +
                                                " predicts an error of " + std::to_string(offer.error) +
                                                "; expected a finite one of 0 or more");
        planned.offers.push_back(std::move(offer));
    }
}

double brume_host_t::predicted_error() const
{
    double squares = 0;
    for (const PlannedEffect &planned : effects_) {
        if (!planned.runs)
            continue;
        auto at = std::find_if(planned.offers.begin(), planned.offers.end(),
                               [&](const Offer &offer) { return offer.parameters == planned.parameters; });
        if (at == planned.offers.end())
            return -1;
        squares += at->error * at->error;
    }
    return std::sqrt(squares);
}

void brume_host_t::effect_failed(const Effect &effect, const char *callback, brume_status status) const
{
    bool known = status > BRUME_OK && status <= BRUME_ERROR_INTERNAL;
    std::string message = failure_.empty() ? std::string("failed in ") + callback + " without a message" : failure_;
    if (!known)
        message += " (status " + std::to_string(status) + ", which no version of the ABI knows)";
    throw Error(known ? status : BRUME_ERROR_PLUGIN, effect.name + ": " + message);
}

brume_status brume_host_t::fail(brume_status status, const char *message)
{
    failure_ = message ? message : "";
    return status;
}

void brume_host_t::add_entry(const brume_plugin_entry &entry)
{
    if (!entry.name || !entry.reason)
        throw Error(BRUME_ERROR_ARGUMENT, "add_entry: name or reason is NULL");
    entries_.push_back({entry.runs != 0, current_ ? current_->effect->name : host_name, entry.name, entry.reason,
                        entry.bytes, entry.operations, 0});
}

void brume_host_t::need_camera(uint32_t needs, const std::string &reason)
{
    if ((needs & ~camera_needs_) == 0)
        return;
    camera_needs_ |= needs;
    camera_reason_ += (camera_reason_.empty() ? "" : "; ") + reason;
}

brume_plugin_image brume_host_t::create_image(int32_t width, int32_t height, int32_t channels)
{
    int32_t largest = context_->backend->largest_size();
    if (width < 1 || height < 1 || width > largest || height > largest || (channels != 1 && channels != 2 && channels != 4))
        throw Error(BRUME_ERROR_ARGUMENT, std::to_string(width) + " x " + std::to_string(height) + " x " +
                                              std::to_string(channels) + "; expected sides from 1 to " +
                                              std::to_string(largest) + " and 1, 2 or 4 channels");
    if (rehearsal_)
        return image_of_rehearsal();
    images_.push_back(context_->backend->create_image(width, height, channels, BRUME_PIXEL_F32));
    image_bytes_ += uint64_t(width) * uint64_t(height) * uint64_t(channels) * 4;
    return images_.back().get();
}

brume_program brume_host_t::compile(const char *name, const char *source, const char *defines)
{
    if (rehearsal_)
        return program_of_rehearsal();
    programs_.push_back(context_->backend->compile(name, source, defines));
    return programs_.back().get();
}

int brume_host_t::entry_index(const char *name) const
{
    const std::string &owner = current_ ? current_->effect->name : host_name;
    for (size_t i = 0; i < entries_.size() && name; ++i)
        if (entries_[i].runs && entries_[i].name == name && entries_[i].effect == owner)
            return int(i);
    throw Error(BRUME_ERROR_PLUGIN,
                std::string("pass \"") + (name ? name : "NULL") + "\" is not among the running entries of the plan");
}

void brume_host_t::run(const brume_plugin_pass &pass)
{
    timer_->mark(entry_index(pass.name));
    context_->backend->run(pass, *current_scene_);
}

brume_status brume_host_t::rows(const char *name, int32_t count, int32_t grain, brume_rows_function function, void *user)
{
    if (!function || count < 0 || grain < 1)
        throw Error(BRUME_ERROR_ARGUMENT, "rows: function NULL, count below 0 or grain below 1");
    timer_->mark(entry_index(name));
    return context_->backend->rows(count, grain, function, user);
}

brume_plugin_image brume_host_t::upload(uint32_t slot, int32_t channels, const float *values, uint64_t texels)
{
    const uint64_t width = BRUME_DATA_WIDTH, most = width * uint64_t(context_->backend->largest_size());
    if (slot > 63 || (channels != 1 && channels != 4) || texels > most)
        throw Error(BRUME_ERROR_ARGUMENT, "upload: slot " + std::to_string(slot) + ", " + std::to_string(channels) +
                                              " channels, " + std::to_string(texels) +
                                              " texels; expected a slot from 0 to 63, 1 or 4 channels and at most " +
                                              std::to_string(most) + " texels");
    if (rehearsal_)
        return image_of_rehearsal();
    Data &data = data_[{current_, slot}];
    data.image.reset();
    // Powers of two, so that the pool serves the next frame's slightly longer list with the same image.
    const uint64_t rows = std::min<uint64_t>(std::bit_ceil(std::max<uint64_t>(1, (texels + width - 1) / width)),
                                             uint64_t(context_->backend->largest_size()));
    data.values.assign(rows * width * uint64_t(channels), 0.0f);
    std::copy_n(values, texels * uint64_t(channels), data.values.begin());
    brume_image image = BRUME_IMAGE_INIT;
    image.channels = uint32_t(channels);
    image.width = int32_t(width);
    image.height = int32_t(rows);
    image.data = data.values.data();
    data.image = context_->backend->import(image, channels);
    return data.image.get();
}

brume_plugin_pixels brume_host_t::pixels(brume_plugin_image image)
{
    return context_->backend->pixels(*image);
}
