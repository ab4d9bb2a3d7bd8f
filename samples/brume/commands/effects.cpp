#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "run/options.hpp"
#include "support/sdk.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

struct EffectsOptions {
    std::string name, plugins;
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

ordered_json in_json(const std::vector<brume_parameter_info> &parameters)
{
    ordered_json list = ordered_json::array();
    for (const brume_parameter_info &p : parameters)
        list.push_back({{"name", p.name},
                        {"type", type_text(p)},
                        {"default", default_text(p)},
                        {"range", range_text(p)},
                        {"help", p.help},
                        {"alias", p.alias}});
    return list;
}

ordered_json in_json(const std::vector<brume_layer_info> &layers)
{
    ordered_json list = ordered_json::array();
    for (const brume_layer_info &layer : layers)
        list.push_back({{"name", layer.name},
                        {"direction", layer.flags & BRUME_LAYER_INPUT ? "read" : "filled"},
                        {"needed", (layer.flags & BRUME_LAYER_NEEDED) != 0},
                        {"of_light", (layer.flags & BRUME_LAYER_OF_LIGHT) != 0},
                        {"channels", layer.channels},
                        {"help", layer.help}});
    return list;
}

void print_layers(const std::vector<brume_layer_info> &layers)
{
    for (const brume_layer_info &layer : layers)
        fmt::print("  {:<20} layer    {:<26} {} {:<13} {}\n", layer.name, flags_text(layer), layer.channels,
                   layer.channels == 1 ? "channel" : "channels", layer.help);
}

void print_effect(const Context &context, const brume_effect_info &effect)
{
    fmt::print("{}  {}\n", effect.name, effect.help);
    for (const brume_parameter_info &p : context.parameters(effect.name))
        fmt::print("  {:<20} {:<8} default {:<10} {:<24} {}{}\n", p.name, type_text(p), default_text(p), range_text(p),
                   p.help, *p.alias ? fmt::format(" (also {})", p.alias) : "");
    print_layers(context.layers(effect.name));
}

int effects(const EffectsOptions &options)
{
    const Context context = create_context("cpu", options.plugins);
    bool found = false;
    std::string known;
    ordered_json list = ordered_json::array();
    for (const brume_effect_info &effect : context.effects()) {
        known += fmt::format("{}{}", known.empty() ? "" : ", ", effect.name);
        if (!options.name.empty() && options.name != effect.name)
            continue;
        found = true;
        if (options.json)
            list.push_back(effect.refusal ? ordered_json{{"name", effect.name}, {"refusal", effect.refusal}}
                                          : ordered_json{{"name", effect.name},
                                                         {"help", effect.help},
                                                         {"parameters", in_json(context.parameters(effect.name))},
                                                         {"layers", in_json(context.layers(effect.name))}});
        else if (effect.refusal)
            fmt::print("{}  not loaded: {}\n", effect.name, effect.refusal);
        else
            print_effect(context, effect);
    }
    if (!options.name.empty() && !found)
        throw RequestError(fmt::format("no effect '{}'; there are {}", options.name, known.empty() ? "none" : known));
    if (options.json) {
        const ordered_json out{{"effects", list}, {"library_layers", in_json(context.library_layers())}};
        fmt::print("{}\n", out.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    } else if (options.name.empty()) {
        fmt::print("brume  the library itself, for all effects\n");
        print_layers(context.library_layers());
    }
    return kDone;
}

int schema(const std::string &plugins)
{
    const Context context = create_context("cpu", plugins);
    fmt::print("{}\n", context.scene_schema());
    return kDone;
}

}  // namespace

void add_effects(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand(
        "effects", "List effects, their parameters (type, default, range, unit) and the layers they read and fill");
    auto options = std::make_shared<EffectsOptions>();
    command->add_option("NAME", options->name, "Only this effect");
    add_plugins_option(*command, options->plugins);
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([&chosen, options] { chosen = [options] { return effects(*options); }; });
}

void add_schema(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("schema", "Print the JSON Schema of scene files");
    auto plugins = std::make_shared<std::string>();
    add_plugins_option(*command, *plugins);
    command->callback([&chosen, plugins] { chosen = [plugins] { return schema(*plugins); }; });
}

}  // namespace brume::tool
