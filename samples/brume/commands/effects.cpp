#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "commands/commands.hpp"
#include "run/sdk.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

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

int effects(const std::string &wanted)
{
    const ContextHandle context = create_context("cpu");
    bool found = false;
    std::string known;
    for (std::uint32_t i = 0; i < brume_effect_count(context.get()); ++i) {
        brume_effect_info effect = BRUME_EFFECT_INFO_INIT;
        check_request(context.get(), brume_effect_get_info(context.get(), i, &effect), "");
        known += fmt::format("{}{}", known.empty() ? "" : ", ", effect.name);
        if (!wanted.empty() && wanted != effect.name)
            continue;
        found = true;
        if (effect.refusal) {
            fmt::print("{}  not loaded: {}\n", effect.name, effect.refusal);
            continue;
        }
        fmt::print("{}  {}\n", effect.name, effect.help);
        for (std::uint32_t j = 0; j < effect.parameter_count; ++j) {
            brume_parameter_info p = BRUME_PARAMETER_INFO_INIT;
            check_request(context.get(), brume_parameter_get_info(context.get(), effect.name, j, &p), effect.name);
            fmt::print("  {:<20} {:<8} default {:<10} {:<24} {}\n", p.name, type_text(p), default_text(p), range_text(p),
                       p.help);
        }
    }
    if (!wanted.empty() && !found)
        throw RequestError(fmt::format("no effect '{}'; there are {}", wanted, known.empty() ? "none" : known));
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
    auto *command = app.add_subcommand("effects", "List effects and their parameters: type, default, range, unit, help");
    auto name = std::make_shared<std::string>();
    command->add_option("NAME", *name, "Only this effect");
    command->callback([&chosen, name] { chosen = [name] { return effects(*name); }; });
}

void add_schema(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("schema", "Print the JSON Schema of scene files");
    command->callback([&chosen] { chosen = schema; });
}

}  // namespace brume::tool
