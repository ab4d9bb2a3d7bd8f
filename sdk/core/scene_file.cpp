#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/effects.h"
#include "core/error.h"
#include "core/json_node.h"
#include "core/parameters.h"
#include "core/scene.h"
#include "core/scene_ranges.h"

namespace brume {
namespace {

constexpr double degree = 0.017453292519943295;
constexpr double rigid_tolerance = 1e-3;

double read_constant(const JsonNode &node, const Range &range)
{
    const std::string what = range.describe();
    const double value = node.number(what);
    if (!range.contains(value))
        node.expected(what);
    return value;
}

Number read_keys(const JsonNode &keys, const Range &range)
{
    const std::string what = "[frame, value] pairs, one at least";
    const size_t count = keys.array_size(what);
    if (count == 0)
        keys.expected(what);
    Number number;
    number.keys.clear();
    for (size_t i = 0; i < count; ++i) {
        const JsonNode key = keys.item(i);
        key.check_array_size(2, "a [frame, value] pair");
        const double frame = read_constant(key.item(0), ranges::frame);
        if (i > 0 && frame <= number.keys.back().first)
            key.item(0).expected(fmt::format("a frame after {}: keys ascend", number.keys.back().first));
        number.keys.emplace_back(frame, read_constant(key.item(1), range));
    }
    return number;
}

Number read_number(const JsonNode &node, const Range &range)
{
    if (node.value().as<double>())
        return read_constant(node, range);
    if (!node.value().as<JsonValue::Object>())
        node.expected(range.describe() + ", or {\"keys\": [[frame, value], ...]}");
    node.allow_only({"keys"});
    return read_keys(node.get("keys"), range);
}

Number3 read_vector(const JsonNode &node, const Range &range)
{
    node.check_array_size(3, "an array of 3 numbers");
    return {read_number(node.item(0), range), read_number(node.item(1), range), read_number(node.item(2), range)};
}

bool always_zero(const Number &number)
{
    return std::all_of(number.keys.begin(), number.keys.end(), [](const auto &key) { return key.second == 0.0; });
}

Number3 read_direction(const JsonNode &node)
{
    const Number3 direction = read_vector(node, ranges::any);
    if (std::all_of(direction.begin(), direction.end(), always_zero))
        node.fail("(0, 0, 0); expected a vector that is not zero");
    return direction;
}

// A scalar stands for three equal channels.
Number3 read_rgb(const JsonNode &node, const Range &range)
{
    if (node.value().as<JsonValue::Array>())
        return read_vector(node, range);
    if (!node.value().as<double>() && !node.value().as<JsonValue::Object>())
        node.expected(range.describe() + ", [r, g, b], or {\"keys\": [[frame, value], ...]}");
    const Number grey = read_number(node, range);
    return {grey, grey, grey};
}

Number in_radians(Number degrees)
{
    for (auto &key : degrees.keys)
        key.second *= degree;
    return degrees;
}

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

DensityTerm read_density_term(const JsonNode &node)
{
    const JsonNode type = node.get("type");
    const std::string &name = type.string("\"constant\" or \"exponential\"");
    if (name == "gaussian" || name == "gaussians")
        type.expected("\"constant\" or \"exponential\": this version has no Gaussian terms");
    DensityTerm term;
    if (name == "constant") {
        node.allow_only({"type", "value"});
    } else if (name == "exponential") {
        node.allow_only({"type", "value", "falloff", "direction", "origin"});
        term.type = BRUME_DENSITY_EXPONENTIAL;
    } else {
        type.expected("\"constant\" or \"exponential\"");
    }
    if (const auto value = node.find("value"))
        term.value = read_number(*value, ranges::not_negative);
    if (const auto falloff = node.find("falloff"))
        term.falloff = read_number(*falloff, ranges::not_negative);
    if (const auto direction = node.find("direction"))
        term.direction = read_direction(*direction);
    if (const auto origin = node.find("origin"))
        term.origin = read_vector(*origin, ranges::any);
    return term;
}

std::vector<DensityTerm> read_density(const JsonNode &node)
{
    std::vector<DensityTerm> terms;
    const size_t count = node.array_size("an array of density terms");
    uint32_t exponential = 0;
    for (size_t i = 0; i < count; ++i) {
        terms.push_back(read_density_term(node.item(i)));
        if (terms.back().type == BRUME_DENSITY_EXPONENTIAL && ++exponential > BRUME_MAX_DENSITY_TERMS)
            node.item(i).fail(fmt::format("exponential term {}; expected at most {}", exponential, BRUME_MAX_DENSITY_TERMS));
    }
    return terms;
}

Medium read_medium(const JsonNode &node)
{
    node.allow_only({"scattering", "absorption", "emission", "g", "visibility", "droplet_diameter", "density"});
    node.refuse_both("scattering", "visibility");
    node.refuse_both("g", "droplet_diameter");
    Medium medium;
    if (const auto scattering = node.find("scattering"))
        medium.scattering = read_rgb(*scattering, ranges::not_negative);
    if (const auto absorption = node.find("absorption"))
        medium.absorption = read_rgb(*absorption, ranges::not_negative);
    if (const auto emission = node.find("emission"))
        medium.emission = read_rgb(*emission, ranges::not_negative);
    if (const auto g = node.find("g"))
        medium.g = read_number(*g, ranges::asymmetry);
    if (const auto visibility = node.find("visibility"))
        medium.visibility = read_number(*visibility, ranges::positive);
    if (const auto diameter = node.find("droplet_diameter"))
        medium.droplet_diameter = read_number(*diameter, ranges::droplet_diameter);
    if (const auto density = node.find("density"))
        medium.density = read_density(*density);
    return medium;
}

// Lights are checked, so that files stay valid when effects begin to read them.
void check_light(const JsonNode &node)
{
    const JsonNode type = node.get("type");
    const std::string what = "\"point\", \"spot\" or \"directional\"";
    const std::string &name = type.string(what);
    const bool placed = name == "point" || name == "spot";
    const bool directed = name == "spot" || name == "directional";
    if (!placed && !directed)
        type.expected(what);
    std::vector<std::string> keys{"type", "intensity"};
    if (placed)
        keys.insert(keys.end(), {"position", "radius"});
    if (directed)
        keys.push_back("direction");
    if (name == "spot")
        keys.push_back("angle");
    node.allow_only(keys);

    read_rgb(node.get("intensity"), ranges::not_negative);
    if (placed)
        read_vector(node.get("position"), ranges::any);
    if (directed)
        read_direction(node.get("direction"));
    if (const auto radius = node.find("radius"))
        read_number(*radius, ranges::not_negative);
    if (const auto angle = node.find("angle"))
        read_number(*angle, ranges::spot_angle);
}

size_t read_lights(const JsonNode &node)
{
    const size_t count = node.array_size("an array of lights");
    for (size_t i = 0; i < count; ++i)
        check_light(node.item(i));
    return count;
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

Scene read_scene(const JsonNode &root, const EffectRegistry &registry)
{
    root.allow_only({"brume", "metres_per_unit", "camera", "medium", "lights", "effects", "quality"});
    const std::string version = "1, the version of this file format";
    if (root.get("brume").number(version) != 1.0)
        root.get("brume").expected(version);
    if (const auto quality = root.find("quality"))
        quality->fail("this version does not choose by quality; expected the parameters under \"effects\"");

    Scene scene;
    if (const auto metres = root.find("metres_per_unit"))
        scene.metres_per_unit = read_constant(*metres, ranges::positive);
    if (const auto camera = root.find("camera"))
        scene.camera = read_camera(*camera);
    if (const auto medium = root.find("medium"))
        scene.medium = read_medium(*medium);
    if (const auto lights = root.find("lights"))
        scene.lights.resize(read_lights(*lights));
    if (const auto effects = root.find("effects"))
        for (const JsonMember &member : effects->object())
            scene.effects.push_back(read_effect(*effects, member, registry));
    scene.effects_named = !scene.effects.empty();
    return scene;
}

}  // namespace

Scene parse_scene(const std::string &text, const std::string &name, const EffectRegistry &effects)
{
    const JsonValue root = parse_json(text, name);
    return read_scene(JsonNode(root, name), effects);
}

}  // namespace brume
