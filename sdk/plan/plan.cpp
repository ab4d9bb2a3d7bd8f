#include "plan/plan.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "effects/plugin_lock.h"

using namespace brume;

namespace {

bool on_llvmpipe(const Backend &backend)
{
    return backend.device().find("llvmpipe") != std::string::npos;
}

bool contains(const std::vector<std::string> &names, const std::string &name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

brume_host_t::brume_host_t(std::shared_ptr<Context> context, Scene scene, const Format &format, Purpose purpose)
    : context_(std::move(context)), scene_(std::move(scene)), given_effects_(scene_.effects), format_(format),
      structure_(scene_, format_), resources_(*context_->backend, purpose), waking_(purpose == Purpose::waking)
{
    context_->backend->invoke([&] {
        int32_t largest = context_->backend->largest_size();
        if (format_.width > largest || format_.height > largest)
            throw Error(BRUME_ERROR_UNSUPPORTED, fmt::format("format: {} x {}; this device takes up to {} a side",
                                                             format_.width, format_.height, largest));
        try {
            layers_.plan(format_, context_->effects);
            expect_shadow_maps();
            choose_effects();
            order_effects();
            set_parameters();
            plan_effects();
            if (purpose == Purpose::execution)
                timer_ = context_->backend->create_timer();
        } catch (...) {
            release();
            context_->backend->trim();
            throw;
        }
    });
}

void brume_host_t::expect_shadow_maps() const
{
    for (size_t i = 0; i < scene_.lights.size() && !layers_.has_input("shadow"); ++i)
        if (const std::string &file = scene_.lights[i].shadow.file; !file.empty())
            throw Error(BRUME_ERROR_SCENE,
                        fmt::format("lights[{}].shadow.file: {} is not read by the library; expected the layer "
                                    "shadow among format.inputs, and frames to bring it for light {}",
                                    i, file, i));
}

brume_host_t::~brume_host_t()
{
    try {
        context_->backend->invoke([&] {
            release();
            timer_.reset();
        });
    } catch (const std::exception &error) {
        context_->log(BRUME_LOG_ERROR, std::string("plan: ") + error.what());
    }
}

void brume_host_t::release() noexcept
{
    destroy_states();
    layers_.release();
    resources_.release();
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

void brume_host_t::plan_effects()
{
    if (!scene_.medium && scene_.effects.empty())
        entries_.push_back({false, host_name, "medium", "the scene has no medium: nothing to do", 0, 0, 0});
    if (!scene_.lights.empty() && std::none_of(effects_.begin(), effects_.end(), [](auto &planned) {
            return contains(planned.effect->uses, "lights") || contains(planned.effect->makes, "single_scattering");
        }))
        entries_.push_back({false, host_name, "lights",
                            fmt::format("{} lights: no effect of this scene reads them", scene_.lights.size()), 0, 0, 0});

    const brume_plugin_scene &scene = content_.plan(scene_, format_);
    if (!effects_.empty() && has_gaussians(scene_))
        need_camera(BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE, "the medium's Gaussians are placed in the world");
    std::vector<PlannedEffect *> ready;
    for (auto &planned : effects_)
        if (!lacks_layer(planned))
            ready.push_back(&planned);
    for (PlannedEffect *planned : ready)
        settle(*planned, scene);
    for (PlannedEffect *planned : ready)
        plan_effect(*planned, scene);
    current_ = nullptr;
    for (auto &planned : effects_)
        if (planned.runs)
            running_.push_back(&planned);
    if (waking_)
        return;
    check_outputs();
    plan_host_products(scene);
    resources_.bind_passes(entries_);
    content_.scene_changed();

    for (int i = 0; i < std::min<int>(int(running_.size()) - 1, 2); ++i)
        between_[i] = create_image("between effects", format_.width, format_.height, 4);
    for (auto &entry : entries_)
        if (entry.runs)
            entry.predicted_ms =
                context_->rates.milliseconds(*context_->backend, entry.effect, entry.name, entry.operations, entry.bytes);
}

void brume_host_t::check_outputs() const
{
    std::string missing;
    for (const FormatLayer &layer : layers_.all()) {
        const bool filled = std::any_of(running_.begin(), running_.end(), [&](const PlannedEffect *planned) {
            return std::any_of(planned->effect->layers.begin(), planned->effect->layers.end(),
                               [&](const Layer &of) { return of.flags & BRUME_LAYER_OUTPUT && of.name == layer.name.name; });
        });
        if (layer.flags & BRUME_LAYER_OUTPUT && !filled)
            missing += (missing.empty() ? "" : ", ") + layer.name.name;
    }
    if (!missing.empty())
        throw Error(BRUME_ERROR_UNSUPPORTED, "format.outputs: nothing that runs fills " + missing +
                                                 (entries_.empty() ? "" : " (" + entries_.back().reason + ")"));
}

// What running effects use; its entries stand before theirs, as it runs.
void brume_host_t::plan_host_products(const brume_plugin_scene &scene)
{
    std::vector<std::string> uses;
    for (const PlannedEffect *planned : running_)
        for (const std::string &product : planned->effect->uses)
            if (uses_product(*planned, product))
                uses.push_back(product);
    const auto first = ptrdiff_t(entries_.size());
    host_products_.plan(*this, uses, scene, layers_, format_.width, format_.height);
    std::rotate(entries_.begin(), entries_.begin() + first, entries_.end());
    for (const FormatLayer &layer : layers_.all()) {
        const bool by_host = contains(uses, "density") && std::any_of(host_layers().begin(), host_layers().end(),
                                                                      [&](auto &of) { return of.name == layer.name.name; });
        const bool read =
            by_host || std::any_of(running_.begin(), running_.end(), [&](const PlannedEffect *planned) {
                return std::any_of(planned->effect->layers.begin(), planned->effect->layers.end(),
                                   [&](auto &of) { return of.flags & BRUME_LAYER_INPUT && of.name == layer.name.name; });
            });
        if (layer.flags & BRUME_LAYER_INPUT && !read)
            entries_.push_back({false, host_name, layer.name.name, "an input layer that nothing which runs reads", 0, 0, 0});
    }
}

void brume_host_t::warn_on_software_gl(const std::string &message)
{
    if (warned_ || !on_llvmpipe(*context_->backend))
        return;
    warned_ = true;
    context_->log(BRUME_LOG_WARNING, message);
}

// What this plan has dropped and a plan of that scene would run; empty if nothing. Of the scene and the format at hand that
// is nothing.
std::string brume_host_t::wakes(const Scene &scene, const Format &format) const
{
    if (running_.size() == effects_.size() || (drops_alike(scene, scene_) && drops_alike(format, format_)))
        return {};
    Scene least = least_to_drop_alike(scene);
    least.effects = scene_.effects;
    const brume_host_t rehearsal(context_, std::move(least), format, Purpose::waking);
    for (size_t i = 0; i < std::min(effects_.size(), rehearsal.effects_.size()); ++i)
        if (rehearsal.effects_[i].runs && !effects_[i].runs)
            return effects_[i].effect->name + ": dropped when planned, it would run now";
    return {};
}

// Takes no memory where the plan had such values before.
void brume_host_t::take(const SceneValues &values)
{
    spare_ = values;  // should it throw, the plan is as it was
    std::swap(static_cast<SceneValues &>(scene_), spare_);
    if (!spare_.medium)
        return;
    for (GaussianSet &set : spare_.medium->gaussian_sets) {
        set.fixed.reset();
        set.frames.reset();
    }
}

void brume_host_t::update(const Scene &scene, const Format *format)
{
    const Format &next = format ? *format : format_;
    std::string difference = structure_.difference(Structure(scene, next));
    auto same_layers = [](const std::vector<Format::LayerName> &a, const std::vector<Format::LayerName> &b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](auto &x, auto &y) { return x.name == y.name && x.kind == y.kind; });
    };
    if (difference.empty() &&
        !(same_layers(next.input_layers, format_.input_layers) && same_layers(next.output_layers, format_.output_layers)))
        difference = "format: the layers";
    auto same_settings = [](const EffectSettings &a, const EffectSettings &b) {
        return a.name == b.name && a.parameters == b.parameters;
    };
    if (difference.empty() && scene.quality != scene_.quality)
        difference = "quality: another is asked";
    if (difference.empty() && !(scene.effects_named == scene_.effects_named &&
                                std::equal(scene.effects.begin(), scene.effects.end(), given_effects_.begin(),
                                           given_effects_.end(), same_settings)))
        difference = "effects: they or their parameters are others";
    if (difference.empty())
        difference = wakes(scene, next);
    if (!difference.empty())
        throw Error(BRUME_ERROR_FORMAT, "plan: of another structure than the scene it was made for: " + difference +
                                            "; expected a new plan for it");
    take(scene);
    if (format)
        format_ = *format;
    content_.scene_changed();
}
