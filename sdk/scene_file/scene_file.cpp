#include <fmt/format.h>

#include "effects/effects.h"
#include "base/error.h"
#include "effects/parameters.h"
#include "scene_file/scene_file.h"

namespace brume {
namespace {

double read_parameter(const JsonNode &node, const Effect &effect, const Parameter &parameter)
{
    const bool boolean = parameter.type == BRUME_PARAMETER_BOOLEAN, choice = parameter.type == BRUME_PARAMETER_CHOICE;
    const auto *number = node.value().as<double>();
    const auto *truth = node.value().as<bool>();
    const auto *word = node.value().as<std::string>();
    if (node.value().as<JsonValue::Object>())
        node.expected(parameter_expectation(parameter) + "; effects' parameters have no keys");
    if (boolean ? !truth : choice ? !word : !number)
        node.expected(parameter_expectation(parameter));
    try {
        return boolean  ? double(*truth)
               : choice ? parameter_from_text(effect, parameter, *word)
                        : parameter_from_number(effect, parameter, *number);
    } catch (const Error &) {
        node.expected(parameter_expectation(parameter));
    }
}

EffectSettings read_effect(const JsonNode &effects, const JsonMember &member, const EffectRegistry &registry)
{
    const Effect *effect = nullptr;
    try {
        effect = &registry.find(member.key);
    } catch (const Error &error) {
        effects.fail_key(member, error.what());
    }
    EffectSettings settings{effect->name, {}};
    const JsonNode node = effects.member(member);
    for (const JsonMember &setting : node.object()) {
        const Parameter *parameter = nullptr;
        try {
            parameter = &effect->parameters[find_parameter(*effect, setting.key)];
        } catch (const Error &error) {
            node.fail_key(setting, error.what());
        }
        const double value = read_parameter(node.member(setting), *effect, *parameter);
        if (!settings.parameters.emplace(parameter->name, value).second)
            node.fail_key(setting, fmt::format("{} and {} are one parameter", parameter->name, parameter->alias));
    }
    return settings;
}

uint32_t read_preset(const JsonNode &node)
{
    const std::string what = "one of draft, standard, final, reference";
    const std::string &name = node.string(what);
    for (uint32_t i = 0; i < std::size(preset_names); ++i)
        if (name == preset_names[i])
            return BRUME_PRESET_DRAFT + i;
    node.expected(what);
}

// A preset's name by itself, or an object.
Quality read_quality(const JsonNode &node)
{
    Quality quality;
    if (node.value().as<std::string>()) {
        quality.preset = read_preset(node);
        return quality;
    }
    allow_fields<Quality>(node, quality_fields, ~0u);
    node.refuse_both("max_error", "budget_ms");
    const uint32_t kind = node.find("preset")      ? preset_kind
                          : node.find("max_error") ? error_kind
                          : node.find("budget_ms") ? budget_kind
                                                   : 0;
    if (!kind)
        node.fail("nothing is asked; expected a preset, max_error or budget_ms");
    read_fields<Quality>(node, {}, quality_fields, kind, quality,
                         [&](std::string_view, const JsonNode &preset) { quality.preset = read_preset(preset); });
    return quality;
}

Scene read_scene(const JsonNode &root, const std::filesystem::path &folder, const EffectRegistry &registry)
{
    root.allow_only({"brume", "metres_per_unit", "camera", "medium", "lights", "environment", "effects", "quality"});
    const std::string version = "1, the version of this file format";
    if (root.get("brume").number(version) != 1.0)
        root.get("brume").expected(version);

    Scene scene;
    if (const auto metres = root.find("metres_per_unit"))
        scene.metres_per_unit = read_constant(*metres, ranges::positive);
    if (const auto camera = root.find("camera"))
        read_fields<Camera>(*camera, folder, camera_fields, ~0u, scene.camera, nothing_more);
    if (const auto medium = root.find("medium"))
        scene.medium = read_medium(*medium, folder);
    if (const auto lights = root.find("lights"))
        scene.lights = read_lights(*lights, folder);
    if (const auto environment = root.find("environment"))
        scene.environment = read_environment(*environment, folder);
    if (const auto effects = root.find("effects"))
        for (const JsonMember &member : effects->object())
            scene.effects.push_back(read_effect(*effects, member, registry));
    scene.effects_named = !scene.effects.empty();
    if (const auto quality = root.find("quality"))
        scene.quality = read_quality(*quality);
    return scene;
}

}  // namespace

Scene parse_scene(const std::string &text, const std::string &name, const EffectRegistry &effects)
{
    const JsonValue root = parse_json(text, name);
    return read_scene(JsonNode(root, name), std::filesystem::path(name).parent_path(), effects);
}

}  // namespace brume
