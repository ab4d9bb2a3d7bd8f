#include "plan/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "plan/combinations.h"

namespace brume {
namespace {

constexpr double preset_errors[] = {0.3, 0.1, 0.03, 0};  // from BRUME_PRESET_DRAFT on

struct Choosing {
    const Effect *effect;
    std::vector<Option> options;
};

EffectSettings &settings_of(Scene &scene, const std::string &effect)
{
    for (EffectSettings &settings : scene.effects)
        if (settings.name == effect)
            return settings;
    scene.effects.push_back({effect, {}});
    return scene.effects.back();
}

bool contradicts(const Scene &scene, const Effect &effect, const Offer &offer)
{
    for (const EffectSettings &settings : scene.effects)
        if (settings.name == effect.name)
            for (const auto &[name, value] : settings.parameters)
                if (offer.parameters[find_parameter(effect, name)] != value)
                    return true;
    return false;
}

Scene with_offer(Scene scene, const Effect &effect, const Offer &offer)
{
    EffectSettings &settings = settings_of(scene, effect.name);
    for (size_t i = 0; i < effect.parameters.size(); ++i)
        settings.parameters[effect.parameters[i].name] = offer.parameters[i];
    return scene;
}

Option rehearsed(const std::shared_ptr<Context> &context, const Scene &scene, const Format &format, const Effect &effect,
                 const Offer &offer)
{
    const brume_host_t rehearsal(context, with_offer(scene, effect, offer), format, Purpose::rehearsal);
    Option option{offer};
    for (const PlanEntry &entry : rehearsal.entries())
        if (entry.runs && entry.effect == effect.name) {
            option.operations += double(entry.operations);
            option.ms += entry.predicted_ms;
        }
    return option;
}

// The first of those that `fits` by `better`, or of all by `otherwise`; whether it fits.
template <class Fits, class Better, class Otherwise>
std::pair<const Combination *, bool> best(const std::vector<Combination> &all, Fits fits, Better better, Otherwise otherwise)
{
    const Combination *found = nullptr;
    for (const Combination &c : all)
        if (fits(c) && (!found || better(c, *found)))
            found = &c;
    if (found)
        return {found, true};
    for (const Combination &c : all)
        if (!found || otherwise(c, *found))
            found = &c;
    return {found, false};
}

std::string described(const Effect &effect, const Option &option)
{
    std::string text;
    for (size_t i = 0; i < effect.parameters.size(); ++i) {
        const Parameter &p = effect.parameters[i];
        const double value = option.offer.parameters[i];
        if (value != p.default_value)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", p.name,
                                p.type == BRUME_PARAMETER_CHOICE ? p.choices[size_t(value)] : fmt::format("{}", value));
    }
    return fmt::format("{} {} (predicted error {:.2g}, {:.3g} ms)", effect.name, text.empty() ? "with its defaults" : text,
                       option.offer.error, option.ms);
}

}  // namespace

Chosen plan_with_quality(const std::shared_ptr<Context> &context, const Scene &scene, const Format &format)
{
    const Quality &quality = scene.quality;
    if (!quality.asked())
        return {plan_in_memory(context, scene, format), ""};

    const brume_host_t open(context, scene, format, Purpose::rehearsal);
    const bool reference = quality.preset == BRUME_PRESET_REFERENCE;
    std::vector<Choosing> choosing;
    std::string fixed;
    double others_ms = 0;
    for (const PlannedEffect &planned : open.effects()) {
        if (!planned.runs)
            continue;
        Choosing c{planned.effect, {}};
        // References take minutes for small frames: only who asks for them gets them.
        for (const Offer &offer : planned.offers)
            if ((reference || offer.error > 0) && !contradicts(scene, *planned.effect, offer))
                c.options.push_back(rehearsed(context, scene, format, *planned.effect, offer));
        if (c.options.empty())
            fixed += fmt::format("; {} as its parameters are", planned.effect->name);
        else
            choosing.push_back(std::move(c));
    }
    for (const PlanEntry &entry : open.entries())
        if (entry.runs &&
            std::none_of(choosing.begin(), choosing.end(), [&](auto &c) { return c.effect->name == entry.effect; }))
            others_ms += entry.predicted_ms;

    std::vector<Combination> all{{}};
    for (const Choosing &c : choosing)
        all = with_each(all, c.options);
    auto more_accurate = [](const Combination &a, const Combination &b) {
        return a.error < b.error || (a.error == b.error && a.operations < b.operations);
    };
    auto cheaper = [](const Combination &a, const Combination &b) { return a.operations < b.operations; };
    auto faster = [](const Combination &a, const Combination &b) { return a.ms < b.ms; };
    std::pair<const Combination *, bool> found;
    std::string asked, missed;
    if (quality.budget_ms > 0) {
        asked = fmt::format("budget_ms {}", quality.budget_ms);
        missed = "; nothing is predicted to be as fast";
        found = best(
            all, [&](const Combination &c) { return c.ms + others_ms <= quality.budget_ms; }, more_accurate, faster);
        if (!context->rates.measured())
            missed += " (at nominal rates; a calibration measures them)";
    } else {
        const double error = quality.max_error > 0 ? quality.max_error : preset_errors[quality.preset - BRUME_PRESET_DRAFT];
        asked = quality.max_error > 0 ? fmt::format("max_error {}", error)
                                      : fmt::format("{}", preset_names[quality.preset - BRUME_PRESET_DRAFT]);
        missed = reference ? "; not all of this backend's effects have a reference"
                           : "; nothing but the references is predicted to be as accurate";
        found = best(
            all, [&](const Combination &c) { return c.error <= error; }, cheaper, more_accurate);
    }
    Scene chosen = scene;
    std::string text = asked + ": ";
    for (size_t i = 0; i < choosing.size(); ++i) {
        chosen = with_offer(std::move(chosen), *choosing[i].effect, found.first->options[i]->offer);
        text += (i ? "; " : "") + described(*choosing[i].effect, *found.first->options[i]);
    }
    if (choosing.empty())
        text += "nothing to choose from";
    auto plan = plan_in_memory(context, chosen, format);
    plan->set_given_effects(scene.effects);
    return {std::move(plan), text + fixed + (found.second ? "" : missed)};
}

}  // namespace brume
