// A plan's effects: which of them, in what order, with what parameters, and what each plans.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "plan/plan.h"
#include "effects/plugin_lock.h"
#include "plan/services.h"

using namespace brume;

namespace {

constexpr uint32_t most_offers = 64;

bool is_lit(const Scene &scene)
{
    return !scene.lights.empty() || !scene.environment.coefficients.empty();
}

bool any(const Number3 &numbers)
{
    return std::any_of(numbers.begin(), numbers.end(), [](const Number &number) {
        return std::any_of(number.keys().begin(), number.keys().end(), [](auto &key) { return key.second != 0; });
    });
}

bool scatters(const Medium &medium)
{
    return medium.visibility || any(medium.scattering);
}

// Media of which this is false cannot be seen, however dense.
bool is_seen(const Medium &medium)
{
    return scatters(medium) || any(medium.absorption) || any(medium.emission);
}

// Whether the scene's content, which names no effects, asks for this one.
bool wants(const Scene &scene, const Effect &effect, const FrameLayers &layers)
{
    if (!scene.medium || scene.effects_named || !effect.refusal.empty())
        return false;
    if (effect.wanted == BRUME_WANTED_WITH_LAYERS)
        return !scene.lights.empty() && std::any_of(effect.layers.begin(), effect.layers.end(), [&](const Layer &layer) {
            // A picture of any size is of something else than the frame shows.
            return layer.flags & BRUME_LAYER_INPUT && !(layer.flags & BRUME_LAYER_ANY_SIZE) && layers.has_input(layer.name);
        });
    return effect.wanted == BRUME_WANTED_WITH_MEDIUM || (effect.wanted == BRUME_WANTED_WITH_LIGHTS && is_lit(scene));
}

}  // namespace

void brume_host_t::choose_effects()
{
    const auto &registry = context_->effects;
    if (!scene_.effects_named && scene_.medium && is_seen(*scene_.medium))
        registry.expect_one(BRUME_WANTED_WITH_MEDIUM, "medium", "media");
    if (!scene_.effects_named && scene_.medium && scatters(*scene_.medium) && is_lit(scene_))
        registry.expect_one(BRUME_WANTED_WITH_LIGHTS, scene_.lights.empty() ? "environment" : "lights",
                            "light that media scatter");
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
        const auto &uses = user.effect->uses, &makes = maker.effect->makes;
        return maker.effect != user.effect &&
               std::find_first_of(uses.begin(), uses.end(), makes.begin(), makes.end()) != uses.end();
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
        planned.settled = planned.parameters;
        planned.layer_places = layers_.places(planned.effect->layers);
        for (const std::string &product : planned.effect->uses)
            planned.uses.push_back(&products_.of(product));
    }
}

namespace {

// What an effect says of number `index` of the products that its table names.
bool with(decltype(brume_effect::makes_with) of, const PlannedEffect &planned, ptrdiff_t index, const char *what)
{
    if (!of)
        return true;
    try {
        return of(planned.settled.data(), uint32_t(index)) != 0;
    } catch (...) {
        throw Error(BRUME_ERROR_PLUGIN, planned.effect->name + ": threw in " + what);
    }
}

}  // namespace

bool brume_host_t::is_made_by(const PlannedEffect &planned, std::string_view product) const
{
    const auto &makes = planned.effect->makes;
    const auto found = std::find(makes.begin(), makes.end(), product);
    return found != makes.end() && with(planned.effect->makes_with, planned, found - makes.begin(), "makes_with");
}

bool brume_host_t::uses_product(const PlannedEffect &planned, std::string_view product) const
{
    const auto &uses = planned.effect->uses;
    const auto found = std::find(uses.begin(), uses.end(), product);
    return found != uses.end() && with(planned.effect->uses_with, planned, found - uses.begin(), "uses_with");
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

brume_plugin_request brume_host_t::request_of(const PlannedEffect &planned, const std::vector<uint32_t> &layers,
                                              const brume_plugin_scene &scene) const
{
    brume_plugin_request request{};
    request.struct_size = sizeof request;
    request.backend = context_->backend->kind();
    request.width = format_.width;
    request.height = format_.height;
    request.parameter_count = uint32_t(planned.settled.size());
    request.parameters = planned.settled.data();
    request.layer_count = uint32_t(layers.size());
    request.layers = layers.data();
    request.scene = &scene;
    request.animated = scene_.animated() ? 1 : 0;
    request.pose_matters = pose_matters(scene_) ? 1 : 0;
    request.transmittance = scene_.quality.transmittance;
    request.detail = scene_.quality.detail;
    return request;
}

// current_ stays this effect.
template <class Callback> void brume_host_t::call(PlannedEffect &planned, const char *name, const Callback &callback)
{
    current_ = &planned;
    failure_.clear();
    brume_status status = BRUME_OK;
    auto held = hold_if_unsafe(planned.effect->table);
    try {
        status = callback();
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        throw Error(BRUME_ERROR_PLUGIN, fmt::format("{}: threw in {}: {}", planned.effect->name, name, error.what()));
    } catch (...) {
        throw Error(BRUME_ERROR_PLUGIN, fmt::format("{}: threw in {}", planned.effect->name, name));
    }
    if (status != BRUME_OK)
        effect_failed(*planned.effect, name, status);
}

void brume_host_t::settle(PlannedEffect &planned, const brume_plugin_scene &scene)
{
    if (!planned.effect->settle)
        return;
    const std::vector<uint32_t> layers = layers_.given(planned.effect->layers);
    const brume_plugin_request request = request_of(planned, layers, scene);
    std::vector<double> settled = planned.settled;
    settling_ = true;
    call(planned, "settle", [&] { return planned.effect->settle(&services(), this, &request, settled.data()); });
    settling_ = false;
    planned.settled = std::move(settled);
}

void brume_host_t::plan_effect(PlannedEffect &planned, const brume_plugin_scene &scene)
{
    const std::vector<uint32_t> layers = layers_.given(planned.effect->layers);
    const brume_plugin_request request = request_of(planned, layers, scene);
    const size_t first = entries_.size();
    call(planned, "plan", [&] { return planned.effect->table->plan(&services(), this, &request, &planned.state); });
    planned.runs = std::any_of(entries_.begin() + ptrdiff_t(first), entries_.end(), [](auto &e) { return e.runs; });
    if (entries_.size() == first)
        throw Error(BRUME_ERROR_PLUGIN,
                    planned.effect->name + ": plan added no entry; expected one that runs or says why nothing does");
    if (planned.runs && planned.effect->offer && !waking_)
        take_offers(planned, request);
    current_ = nullptr;
}

void brume_host_t::take_offers(PlannedEffect &planned, brume_plugin_request request)
{
    request.parameters = planned.parameters.data();
    auto held = hold_if_unsafe(planned.effect->table);
    for (uint32_t i = 0; i < most_offers; ++i) {
        Offer offer{planned.parameters, 0};
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
