#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/effects.h"
#include "core/error.h"
#include "core/parameters.h"
#include "core/scene_file.h"
#include "core/scene_numbers.h"

namespace brume {
namespace {

constexpr double rigid_tolerance = 1e-3;

// Says what is wrong with a matrix as a rigid motion; empty if nothing is.
std::string rigid_defect(const std::array<double, 16> &m)
{
    for (size_t column = 0; column < 4; ++column)
        if (m[12 + column] != (column == 3 ? 1.0 : 0.0))
            return fmt::format("last row {} {} {} {}", m[12], m[13], m[14], m[15]);
    for (size_t a = 0; a < 3; ++a) {
        for (size_t b = a; b < 3; ++b) {
            const double product = m[a] * m[b] + m[4 + a] * m[4 + b] + m[8 + a] * m[8 + b];
            if (!(std::abs(product - (a == b)) <= rigid_tolerance))
                return a == b ? fmt::format("column {} has length {:.6g}", a, std::sqrt(product))
                              : fmt::format("columns {} and {} have the product {:.6g}", a, b, product);
        }
    }
    const double determinant =
        m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
    return determinant > 0.0 ? "" : "it mirrors: its determinant is negative";
}

std::array<Number, 16> read_matrix(const JsonNode &node)
{
    const std::string what = "4 rows of 4 numbers";
    std::array<Number, 16> matrix;
    std::set<double> frames;
    node.check_array_size(4, what);
    for (size_t row = 0; row < 4; ++row) {
        node.item(row).check_array_size(4, what);
        for (size_t column = 0; column < 4; ++column) {
            const Number &element = matrix[4 * row + column] = read_number(node.item(row).item(column), ranges::any);
            for (const auto &key : element.keys)
                frames.insert(key.first);
        }
    }
    for (double frame : frames) {
        std::array<double, 16> values;
        std::transform(matrix.begin(), matrix.end(), values.begin(), [&](const Number &n) { return n.at(frame); });
        if (const std::string defect = rigid_defect(values); !defect.empty())
            node.fail(fmt::format("{}{}; expected a rigid motion: orthonormal columns, determinant 1, last row 0 0 0 1",
                                  defect, frames.size() > 1 ? fmt::format(" at frame {}", frame) : ""));
    }
    return matrix;
}

Camera read_camera(const JsonNode &node)
{
    node.allow_only({"vertical_fov", "horizontal_fov", "camera_to_world", "pixel_aspect", "center"});
    node.refuse_both("vertical_fov", "horizontal_fov");
    Camera camera;
    if (const auto fov = node.find("vertical_fov"))
        camera.vertical_fov = in_radians(read_number(*fov, ranges::field_of_view));
    if (const auto fov = node.find("horizontal_fov"))
        camera.horizontal_fov = in_radians(read_number(*fov, ranges::field_of_view));
    if (const auto pose = node.find("camera_to_world"))
        camera.camera_to_world = read_matrix(*pose);
    if (const auto aspect = node.find("pixel_aspect"))
        camera.pixel_aspect = read_number(*aspect, ranges::pixel_aspect);
    if (const auto center = node.find("center")) {
        center->check_array_size(2, "an array of 2 numbers");
        camera.center = {read_number(center->item(0), ranges::center), read_number(center->item(1), ranges::center)};
    }
    return camera;
}

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
        settings.parameters[parameter->name] = read_parameter(node.member(setting), *effect, *parameter);
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
    node.allow_only({"preset", "max_error", "budget_ms", "transmittance", "detail"});
    node.refuse_both("preset", "max_error");
    node.refuse_both("preset", "budget_ms");
    node.refuse_both("max_error", "budget_ms");
    if (const auto preset = node.find("preset"))
        quality.preset = read_preset(*preset);
    if (const auto error = node.find("max_error"))
        quality.max_error = read_constant(*error, ranges::max_error);
    if (const auto budget = node.find("budget_ms"))
        quality.budget_ms = read_constant(*budget, ranges::budget_ms);
    if (const auto transmittance = node.find("transmittance"))
        quality.transmittance = read_constant(*transmittance, ranges::fraction);
    if (const auto detail = node.find("detail"))
        quality.detail = read_constant(*detail, ranges::detail);
    if (!quality.asked())
        node.fail("nothing is asked; expected a preset, max_error or budget_ms");
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
        scene.camera = read_camera(*camera);
    if (const auto medium = root.find("medium"))
        scene.medium = read_medium(*medium, folder);
    if (const auto lights = root.find("lights"))
        scene.lights = read_lights(*lights);
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
