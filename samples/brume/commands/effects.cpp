#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "run/layers.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

struct EffectsOptions {
    std::string name;
    bool json = false;
};

std::string type_text(const brume_parameter_info &p)
{
    switch (p.type) {
    case BRUME_PARAMETER_INTEGER:
        return "integer";
    case BRUME_PARAMETER_BOOLEAN:
        return "boolean";
    case BRUME_PARAMETER_CHOICE:
        return "choice";
    default:
        return "number";
    }
}

std::string nth_choice(const std::string &choices, std::size_t n)
{
    std::size_t from = 0;
    for (; n > 0; --n)
        from = choices.find('|', from) + 1;
    return choices.substr(from, choices.find('|', from) - from);
}

std::string default_text(const brume_parameter_info &p)
{
    switch (p.type) {
    case BRUME_PARAMETER_BOOLEAN:
        return p.default_number != 0 ? "true" : "false";
    case BRUME_PARAMETER_CHOICE:
        return nth_choice(p.choices, std::size_t(p.default_number));
    default:
        return fmt::format("{:g}", p.default_number);
    }
}

std::string range_text(const brume_parameter_info &p)
{
    if (p.type == BRUME_PARAMETER_BOOLEAN)
        return "true|false";
    if (p.type == BRUME_PARAMETER_CHOICE)
        return p.choices;
    return fmt::format("{:g} to {:g}{}{}", p.minimum, p.maximum, *p.unit ? " " : "", p.unit);
}

std::string flags_text(const brume_layer_info &layer)
{
    return fmt::format("{}{}{}", layer.flags & BRUME_LAYER_INPUT ? "read" : "filled",
                       layer.flags & BRUME_LAYER_NEEDED ? ", needed" : "",
                       layer.flags & BRUME_LAYER_OF_LIGHT ? ", one for each light" : "");
}

ordered_json parameters_of(brume_context context, const brume_effect_info &effect)
{
    ordered_json parameters = ordered_json::array();
    for (std::uint32_t i = 0; i < effect.parameter_count; ++i) {
        brume_parameter_info p = BRUME_PARAMETER_INFO_INIT;
        check_request(context, brume_parameter_get_info(context, effect.name, i, &p), effect.name);
        parameters.push_back({{"name", p.name},
                              {"type", type_text(p)},
                              {"default", default_text(p)},
                              {"range", range_text(p)},
                              {"help", p.help}});
    }
    return parameters;
}

ordered_json layers_in_json(brume_context context, const char *effect)
{
    ordered_json layers = ordered_json::array();
    for (const brume_layer_info &layer : layers_of(context, effect))
        layers.push_back({{"name", layer.name},
                          {"direction", layer.flags & BRUME_LAYER_INPUT ? "read" : "filled"},
                          {"needed", (layer.flags & BRUME_LAYER_NEEDED) != 0},
                          {"of_light", (layer.flags & BRUME_LAYER_OF_LIGHT) != 0},
                          {"channels", layer.channels},
                          {"help", layer.help}});
    return layers;
}

void print_layers(brume_context context, const char *effect)
{
    for (const brume_layer_info &layer : layers_of(context, effect))
        fmt::print("  {:<20} layer    {:<26} {} {:<13} {}\n", layer.name, flags_text(layer), layer.channels,
                   layer.channels == 1 ? "channel" : "channels", layer.help);
}

void print_effect(brume_context context, const brume_effect_info &effect)
{
    fmt::print("{}  {}\n", effect.name, effect.help);
    for (std::uint32_t i = 0; i < effect.parameter_count; ++i) {
        brume_parameter_info p = BRUME_PARAMETER_INFO_INIT;
        check_request(context, brume_parameter_get_info(context, effect.name, i, &p), effect.name);
        fmt::print("  {:<20} {:<8} default {:<10} {:<24} {}\n", p.name, type_text(p), default_text(p), range_text(p),
                   p.help);
    }
    print_layers(context, effect.name);
}

int effects(const EffectsOptions &options)
{
    const ContextHandle handle = create_context("cpu");
    const brume_context context = handle.get();
    bool found = false;
    std::string known;
    ordered_json list = ordered_json::array();
    for (std::uint32_t i = 0; i < brume_effect_count(context); ++i) {
        brume_effect_info effect = BRUME_EFFECT_INFO_INIT;
        check_request(context, brume_effect_get_info(context, i, &effect), "");
        known += fmt::format("{}{}", known.empty() ? "" : ", ", effect.name);
        if (!options.name.empty() && options.name != effect.name)
            continue;
        found = true;
        if (options.json)
            list.push_back(effect.refusal ? ordered_json{{"name", effect.name}, {"refusal", effect.refusal}}
                                          : ordered_json{{"name", effect.name},
                                                         {"help", effect.help},
                                                         {"parameters", parameters_of(context, effect)},
                                                         {"layers", layers_in_json(context, effect.name)}});
        else if (effect.refusal)
            fmt::print("{}  not loaded: {}\n", effect.name, effect.refusal);
        else
            print_effect(context, effect);
    }
    if (!options.name.empty() && !found)
        throw RequestError(fmt::format("no effect '{}'; there are {}", options.name, known.empty() ? "none" : known));
    if (options.json) {
        const ordered_json out{{"effects", list}, {"library_layers", layers_in_json(context, nullptr)}};
        fmt::print("{}\n", out.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    } else if (options.name.empty()) {
        fmt::print("brume  the library itself, for all effects\n");
        print_layers(context, nullptr);
    }
    return kDone;
}

int schema()
{
    const ContextHandle context = create_context("cpu");
    std::string text(brume_scene_schema(context.get(), nullptr, 0), '\0');
    brume_scene_schema(context.get(), text.data(), text.size());
    fmt::print("{}\n", text.c_str());
    return kDone;
}

}  // namespace

void add_effects(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand(
        "effects", "List effects, their parameters (type, default, range, unit) and the layers they read and fill");
    auto options = std::make_shared<EffectsOptions>();
    command->add_option("NAME", options->name, "Only this effect");
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([&chosen, options] { chosen = [options] { return effects(*options); }; });
}

void add_schema(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("schema", "Print the JSON Schema of scene files");
    command->callback([&chosen] { chosen = schema; });
}

}  // namespace brume::tool
