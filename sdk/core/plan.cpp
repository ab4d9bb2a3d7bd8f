#include "core/plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/plugin_lock.h"
#include "core/services.h"

using namespace brume;

namespace {

const std::string host_name = "brume";  // of the host's own entries
constexpr uint32_t most_offers = 64;

// What a rehearsal hands out in place of images and passes.
Image *image_of_rehearsal()
{
    static Image image;
    return &image;
}
Pass *pass_of_rehearsal()
{
    static Pass pass;
    return &pass;
}

bool on_llvmpipe(const Backend &backend)
{
    return backend.device().find("llvmpipe") != std::string::npos;
}

bool contains(const std::vector<std::string> &names, const std::string &name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_lit(const Scene &scene)
{
    return !scene.lights.empty() || !scene.environment.coefficients.empty();
}

// Media of which this is false cannot be seen, however dense.
bool renders(const Medium &medium)
{
    const auto any = [](const Number3 &numbers) {
        return std::any_of(numbers.begin(), numbers.end(), [](const Number &number) {
            return std::any_of(number.keys.begin(), number.keys.end(), [](auto &key) { return key.second != 0; });
        });
    };
    return medium.visibility || any(medium.scattering) || any(medium.absorption) || any(medium.emission);
}

// Whether the scene's content, which names no effects, asks for this one.
bool wants(const Scene &scene, const Effect &effect, const FrameLayers &layers)
{
    if (!scene.medium || scene.effects_named || !effect.refusal.empty())
        return false;
    if (effect.wanted == BRUME_WANTED_WITH_LAYERS)
        return !scene.lights.empty() && std::any_of(effect.layers.begin(), effect.layers.end(), [&](const Layer &layer) {
                   return layer.flags & BRUME_LAYER_INPUT && layers.has_input(layer.name);
               });
    return effect.wanted == BRUME_WANTED_WITH_MEDIUM || (effect.wanted == BRUME_WANTED_WITH_LIGHTS && is_lit(scene));
}

}  // namespace

brume_host_t::brume_host_t(std::shared_ptr<Context> context, Scene scene, const Format &format, Purpose purpose)
    : context_(std::move(context)), scene_(std::move(scene)), given_effects_(scene_.effects), format_(format),
      structure_(scene_, format_),
      rehearsal_(purpose == Purpose::rehearsal)
{
    context_->backend->invoke([&] {
        int32_t largest = context_->backend->largest_size();
        if (format_.width > largest || format_.height > largest)
            throw Error(BRUME_ERROR_UNSUPPORTED, fmt::format("format: {} x {}; this device takes up to {} a side", format_.width,
                                                             format_.height, largest));
        try {
            layers_.plan(format_, context_->effects);
            expect_shadow_maps();
            choose_effects();
            order_effects();
            set_parameters();
            plan_effects();
            if (!rehearsal_)
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
            throw Error(BRUME_ERROR_SCENE, fmt::format("lights[{}].shadow.file: {} is not read by the library; expected the layer "
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
    data_.clear();
    images_.clear();
    between_[0] = between_[1] = nullptr;
    passes_.clear();
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

void brume_host_t::choose_effects()
{
    const auto &registry = context_->effects;
    if (!scene_.effects_named && scene_.medium && renders(*scene_.medium))
        registry.expect_one_for_media();
    for (const EffectSettings &settings : scene_.effects)
        effects_.push_back({.effect = &registry.find(settings.name), .named = true});
    for (const Effect &effect : registry.all()) {
        const bool there = std::any_of(effects_.begin(), effects_.end(), [&](auto &p) { return p.effect == &effect; });
        if (wants(scene_, effect, layers_) && !there)
            effects_.push_back({.effect = &effect});
        if (scene_.medium && !scene_.effects_named && !is_lit(scene_) && effect.refusal.empty() &&
            effect.wanted == BRUME_WANTED_WITH_LIGHTS)
            entries_.push_back({false, effect.name, effect.name, "no lights and no environment", 0, 0, 0});
    }
}

// By their numbers, but after those that make what they use.
void brume_host_t::order_effects()
{
    std::vector<PlannedEffect> waiting = std::move(effects_);
    std::sort(waiting.begin(), waiting.end(), [](const auto &a, const auto &b) {
        return std::pair(a.effect->order, a.effect->name) < std::pair(b.effect->order, b.effect->name);
    });
    effects_.clear();
    auto makes_for = [](const PlannedEffect &maker, const PlannedEffect &user) {
        return maker.effect != user.effect && std::any_of(user.effect->uses.begin(), user.effect->uses.end(), [&](auto &product) {
                   return contains(maker.effect->makes, product);
               });
    };
    while (!waiting.empty()) {
        const auto ready = std::find_if(waiting.begin(), waiting.end(), [&](const PlannedEffect &user) {
            return std::none_of(waiting.begin(), waiting.end(), [&](auto &maker) { return makes_for(maker, user); });
        });
        if (ready == waiting.end())
            throw Error(BRUME_ERROR_PLUGIN, fmt::format("{} and {}: each uses what the other makes", waiting[0].effect->name,
                                                        waiting[1].effect->name));
        effects_.push_back(std::move(*ready));
        waiting.erase(ready);
    }
}

void brume_host_t::set_parameters()
{
    for (auto &planned : effects_) {
        for (const Parameter &parameter : planned.effect->parameters)
            planned.parameters.push_back(parameter.default_value);
        for (const EffectSettings &settings : scene_.effects)
            if (settings.name == planned.effect->name)
                for (auto &[name, value] : settings.parameters)
                    planned.parameters[find_parameter(*planned.effect, name)] = value;
        planned.layer_places = layers_.places(planned.effect->layers);
        for (const std::string &product : planned.effect->uses)
            planned.uses.push_back(&products_.of(product));
    }
}

bool brume_host_t::is_made_by(const PlannedEffect &planned, std::string_view product) const
{
    const Effect &effect = *planned.effect;
    const auto found = std::find(effect.makes.begin(), effect.makes.end(), product);
    if (found == effect.makes.end() || !effect.makes_with)
        return found != effect.makes.end();
    try {
        const auto &values = planned.settled.empty() ? planned.parameters : planned.settled;
        return effect.makes_with(values.data(), uint32_t(found - effect.makes.begin())) != 0;
    } catch (...) {
        throw Error(BRUME_ERROR_PLUGIN, effect.name + ": threw in makes_with");
    }
}

uint32_t brume_host_t::made(std::string_view product) const
{
    if (product == "density_rgb")
        return layers_.has_input("optical_depth") || layers_.has_input("transmittance") ? BRUME_MADE_EARLIER : BRUME_MADE_NOWHERE;
    if (HostProducts::makes(product))
        return BRUME_MADE_EARLIER;
    bool passed = false;
    uint32_t made = BRUME_MADE_NOWHERE;
    for (const PlannedEffect &planned : effects_) {
        passed = passed || &planned == current_;
        if (!is_made_by(planned, product))
            continue;
        if (!passed && (planned.runs || settling_))
            return BRUME_MADE_EARLIER;
        if (passed)
            made = BRUME_MADE_LATER;
    }
    return made;
}

void brume_host_t::plan_effects()
{
    if (!scene_.medium && scene_.effects.empty())
        entries_.push_back({false, "brume", "medium", "the scene has no medium: nothing to do", 0, 0, 0});
    if (!scene_.lights.empty() && std::none_of(effects_.begin(), effects_.end(), [](auto &planned) {
            return contains(planned.effect->uses, "lights") || contains(planned.effect->makes, "single_scattering");
        }))
        entries_.push_back({false, "brume", "lights",
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
    check_outputs();
    plan_host_products(scene);
    bind_passes();
    content_.scene_changed();

    for (int i = 0; i < std::min<int>(int(running_.size()) - 1, 2) && !rehearsal_; ++i) {
        between_[i] = context_->backend->create_image(format_.width, format_.height, 4, BRUME_PIXEL_F32);
        image_bytes_ += uint64_t(format_.width) * uint64_t(format_.height) * 16;
    }
    for (auto &entry : entries_)
        if (entry.runs)
            entry.predicted_ms =
                context_->rates.milliseconds(*context_->backend, entry.effect, entry.name, entry.operations, entry.bytes);
}

// An effect that the scene names must run; another one is left out.
bool brume_host_t::lacks_layer(PlannedEffect &planned)
{
    for (size_t i = 0; i < planned.effect->layers.size(); ++i) {
        const Layer &layer = planned.effect->layers[i];
        if (!(layer.flags & BRUME_LAYER_NEEDED) || planned.layer_places[i] >= 0)
            continue;
        const std::string reason = fmt::format("needs an input layer {}: {}", layer.name, layer.help);
        if (planned.named)
            throw Error(BRUME_ERROR_UNSUPPORTED, planned.effect->name + " " + reason);
        entries_.push_back({false, planned.effect->name, planned.effect->name, reason, 0, 0, 0});
        return true;
    }
    return false;
}

void brume_host_t::check_outputs() const
{
    std::string missing;
    for (const FormatLayer &layer : layers_.all()) {
        const bool filled = std::any_of(running_.begin(), running_.end(), [&](const PlannedEffect *planned) {
            return std::any_of(planned->effect->layers.begin(), planned->effect->layers.end(), [&](const Layer &of) {
                return of.flags & BRUME_LAYER_OUTPUT && of.name == layer.name.name;
            });
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
        uses.insert(uses.end(), planned->effect->uses.begin(), planned->effect->uses.end());
    const auto first = ptrdiff_t(entries_.size());
    host_products_.plan(*this, uses, scene, layers_, format_.width, format_.height);
    std::rotate(entries_.begin(), entries_.begin() + first, entries_.end());
    for (const FormatLayer &layer : layers_.all()) {
        const bool by_host = contains(uses, "density") && std::any_of(host_layers().begin(), host_layers().end(), [&](auto &of) {
                                 return of.name == layer.name.name;
                             });
        const bool read = by_host || std::any_of(running_.begin(), running_.end(), [&](const PlannedEffect *planned) {
                              return std::any_of(planned->effect->layers.begin(), planned->effect->layers.end(), [&](auto &of) {
                                  return of.flags & BRUME_LAYER_INPUT && of.name == layer.name.name;
                              });
                          });
        if (layer.flags & BRUME_LAYER_INPUT && !read)
            entries_.push_back({false, "brume", layer.name.name, "an input layer that nothing which runs reads", 0, 0, 0});
    }
}

// Finds the entry that each pass's time counts to.
void brume_host_t::bind_passes()
{
    for (size_t i = 0; i < passes_.size(); ++i) {
        Pass &pass = *passes_[i];
        const std::string &owner = pass_owners_[i] ? pass_owners_[i]->name : host_name;
        const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const PlanEntry &entry) {
            return entry.runs && entry.effect == owner && entry.name == pass.layout.name;
        });
        if (found == entries_.end())
            throw Error(BRUME_ERROR_PLUGIN, fmt::format("{}: pass \"{}\" is not among the running entries of the plan", owner,
                                                        pass.layout.name));
        pass.entry = int(found - entries_.begin());
    }
}

void brume_host_t::warn_on_software_gl(const std::string &message)
{
    if (warned_ || !on_llvmpipe(*context_->backend))
        return;
    warned_ = true;
    context_->log(BRUME_LOG_WARNING, message);
}

// What this plan has dropped and a plan of that scene would run; empty if nothing.
std::string brume_host_t::wakes(const Scene &scene, const Format &format) const
{
    if (running_.size() == effects_.size())
        return {};
    Scene planned = scene;
    planned.effects = scene_.effects;
    planned.quality = {};
    const brume_host_t rehearsal(context_, std::move(planned), format, Purpose::rehearsal);
    for (size_t i = 0; i < std::min(effects_.size(), rehearsal.effects_.size()); ++i)
        if (rehearsal.effects_[i].runs && !effects_[i].runs)
            return effects_[i].effect->name + ": dropped when planned, it would run now";
    return {};
}

void brume_host_t::update(const Scene &scene, const Format *format)
{
    const Format &next = format ? *format : format_;
    std::string difference = structure_.difference(Structure(scene, next));
    auto same_layers = [](const std::vector<Format::LayerName> &a, const std::vector<Format::LayerName> &b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](auto &x, auto &y) { return x.name == y.name && x.kind == y.kind; });
    };
    if (difference.empty() && !(same_layers(next.input_layers, format_.input_layers) &&
                                same_layers(next.output_layers, format_.output_layers)))
        difference = "format: the layers";
    auto same_settings = [](const EffectSettings &a, const EffectSettings &b) {
        return a.name == b.name && a.parameters == b.parameters;
    };
    if (difference.empty() && scene.quality != scene_.quality)
        difference = "quality: another is asked";
    if (difference.empty() &&
        !(scene.effects_named == scene_.effects_named && std::equal(scene.effects.begin(), scene.effects.end(), given_effects_.begin(),
                                                                   given_effects_.end(), same_settings)))
        difference = "effects: they or their parameters are others";
    if (difference.empty())
        difference = wakes(scene, next);
    if (!difference.empty())
        throw Error(BRUME_ERROR_FORMAT, "plan: of another structure than the scene it was made for: " + difference +
                                            "; expected a new plan for it");
    Scene kept = scene;
    kept.effects = std::move(scene_.effects);  // with what was chosen for the quality asked
    kept.effects_named = scene_.effects_named;
    kept.quality = scene_.quality;
    scene_ = std::move(kept);
    if (format)
        format_ = *format;
    content_.scene_changed();
}

brume_plugin_request brume_host_t::request_of(const PlannedEffect &planned, const std::vector<uint32_t> &layers,
                                              const brume_plugin_scene &scene) const
{
    brume_plugin_request request{};
    request.struct_size = sizeof request;
    request.backend = context_->backend->kind();
    request.width = format_.width;
    request.height = format_.height;
    request.parameter_count = uint32_t(planned.parameters.size());
    request.parameters = planned.parameters.data();
    request.layer_count = uint32_t(layers.size());
    request.layers = layers.data();
    request.scene = &scene;
    request.animated = scene_.animated() ? 1 : 0;
    request.pose_matters = pose_matters(scene_) ? 1 : 0;
    request.transmittance = scene_.quality.transmittance;
    request.detail = scene_.quality.detail;
    return request;
}

void brume_host_t::settle(PlannedEffect &planned, const brume_plugin_scene &scene)
{
    planned.settled = planned.parameters;
    if (!planned.effect->settle)
        return;
    const std::vector<uint32_t> layers = layers_.given(planned.effect->layers);
    const brume_plugin_request request = request_of(planned, layers, scene);
    current_ = &planned;
    settling_ = true;
    failure_.clear();
    brume_status status = BRUME_OK;
    auto held = hold_if_unsafe(planned.effect->table);
    try {
        status = planned.effect->settle(&services(), this, &request, planned.settled.data());
    } catch (const std::bad_alloc &) {
        throw;
    } catch (...) {
        throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in settle");
    }
    if (status != BRUME_OK)
        effect_failed(*planned.effect, "settle", status);
    settling_ = false;
    current_ = nullptr;
}

void brume_host_t::plan_effect(PlannedEffect &planned, const brume_plugin_scene &scene)
{
    const std::vector<uint32_t> layers = layers_.given(planned.effect->layers);
    brume_plugin_request request = request_of(planned, layers, scene);
    request.parameters = planned.settled.data();
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
            if (!planned.effect->offer(&services(), this, &request, i, offer.parameters.data(), &offer.error))
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

brume_plugin_image brume_host_t::create_image(const char *label, int32_t width, int32_t height, int32_t channels)
{
    int32_t largest = context_->backend->largest_size();
    if (width < 1 || height < 1 || width > largest || height > largest || (channels != 1 && channels != 2 && channels != 4))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("image {}: {} x {} x {}; expected sides from 1 to {} and 1, 2 or 4 channels", label ? label : "?",
                                width, height, channels, largest));
    if (rehearsal_)
        return image_of_rehearsal();
    try {
        images_.push_back(context_->backend->create_image(width, height, channels, BRUME_PIXEL_F32));
    } catch (const Error &error) {
        throw Error(error.status(), fmt::format("image {}: {}", label ? label : "?", error.what()));
    }
    image_bytes_ += uint64_t(width) * uint64_t(height) * uint64_t(channels) * 4;
    return images_.back().get();
}

brume_pass brume_host_t::create_pass(const brume_pass_desc &desc)
{
    PassLayout layout = layout_of(desc);
    if (rehearsal_)
        return pass_of_rehearsal();
    passes_.push_back(context_->backend->create_pass(desc, std::move(layout)));
    pass_owners_.push_back(current_ ? current_->effect : nullptr);
    return passes_.back().get();
}

double brume_host_t::share_before(int entry) const
{
    double before = 0, all = 0;
    for (size_t i = 0; i < entries_.size(); ++i) {
        before += int(i) < entry ? entries_[i].predicted_ms : 0;
        all += entries_[i].predicted_ms;
    }
    return all > 0 ? before / all : 0;
}

brume_status brume_host_t::run(brume_pass pass, const brume_plugin_image *images, const void *constants, int32_t width,
                               int32_t height, void *user)
{
    if (!pass || (!images && !pass->layout.slots.empty()) || (!constants && pass->layout.constant_size > 0))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("run: {} is NULL", !pass ? "pass" : !images ? "images" : "constants"));
    if (width < 1 || height < 1)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("pass \"{}\": its grid is {} x {}; expected at least 1 x 1",
                                                      pass->layout.name, width, height));
    timer_->mark(pass->entry);
    Watch watch{context_->progress, share_before(pass->entry), share_before(pass->entry + 1)};
    const brume_status status = context_->backend->run(*pass, images, constants, width, height, content_.scene(), user,
                                                       context_->progress.wanted() ? &watch : nullptr);
    context_->progress.throw_if_cancelled();
    return status;
}

void brume_host_t::publish(const char *product, const brume_plugin_image *images, uint32_t image_count, uint32_t count,
                           uint64_t revision)
{
    if (!product || (!images && image_count > 0))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("publish: {} is NULL", product ? "images" : "product"));
    if (current_ && !is_made_by(*current_, product))
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("publish: {} is not among what the effect's table says it makes", product));
    products_.publish(product, images, image_count, count, revision);
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
