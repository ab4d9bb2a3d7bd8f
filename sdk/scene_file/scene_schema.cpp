#include <cmath>

#include <nlohmann/json.hpp>

#include "effects/effects.h"
#include "scene/fields.h"

namespace brume {
namespace {

using Json = nlohmann::ordered_json;

Json array_of(const Json &items, size_t count)
{
    return {{"type", "array"}, {"items", items}, {"minItems", count}, {"maxItems", count}};
}

Json object_of(const Json &properties, const std::vector<std::string> &required = {})
{
    Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty())
        schema["required"] = required;
    return schema;
}

Json described(Json schema, const std::string &description)
{
    schema["description"] = description;
    return schema;
}

Json constant(const Range &range)
{
    return {{"type", "number"},
            {range.open ? "exclusiveMinimum" : "minimum", range.minimum},
            {range.open ? "exclusiveMaximum" : "maximum", range.maximum}};
}

// A number, or keys over the frames.
Json number(const Range &range)
{
    const Json pair{{"type", "array"},
                    {"prefixItems", Json::array({constant(ranges::frame), constant(range)})},
                    {"minItems", 2},
                    {"maxItems", 2}};
    const Json keys{{"type", "array"}, {"items", pair}, {"minItems", 1}};
    return {{"anyOf", Json::array({constant(range), object_of({{"keys", keys}}, {"keys"})})}};
}

// How each type of member is written, and what it is where nothing is written.
struct MemberSchema {
    const Range &range;
    uint32_t traits;

    Json written(bool) const { return {{"type", "boolean"}}; }
    Json written(double) const { return constant(range); }
    Json written(uint32_t) const
    {
        return {{"type", "integer"}, {"minimum", int(range.minimum)}, {"maximum", int(range.maximum)}};
    }
    Json written(const std::string &) const { return {{"type", "string"}, {"minLength", 1}}; }
    Json written(const Number &) const { return number(range); }
    Json written(const std::array<Number, 2> &) const { return array_of(number(range), 2); }
    Json written(const Number3 &) const
    {
        Json three = array_of(number(range), 3);
        if (traits & direction)
            three["not"] = {{"const", {0, 0, 0}}};
        return traits & color ? Json{{"anyOf", Json::array({number(range), three})}} : three;
    }
    Json written(const Matrix &) const { return array_of(array_of(number(range), 4), 4); }
    template <class Value> Json written(const std::optional<Value> &) const { return written(Value()); }

    Json left(bool value) const { return value; }
    Json left(double value) const { return std::isfinite(value) ? Json(value) : Json(); }
    Json left(uint32_t value) const { return value; }
    Json left(const std::string &) const { return {}; }
    Json left(const Number &value) const { return traits & degrees ? std::round(value.at(0) / degree) : value.at(0); }
    template <size_t N> Json left(const std::array<Number, N> &values) const
    {
        Json list = Json::array();
        for (const Number &value : values)
            list.push_back(value.at(0));
        return traits & color ? list[0] : list;
    }
    Json left(const Matrix &) const { return {}; }
    template <class Value> Json left(const std::optional<Value> &) const { return {}; }
};

// Objects of this kind. `own`: what the table has no member for.
template <class T> Json object_of_fields(Fields<T> fields, uint32_t kind = ~0u, Json own = {})
{
    Json properties, rules = Json::array();
    std::vector<std::string> required;
    for (const Field<T> &field : fields) {
        if (!field.is(kind))
            continue;
        Json &schema = properties[field.key];
        std::visit(
            [&](auto member) {
                if constexpr (std::is_same_v<decltype(member), std::monostate>) {
                    schema = own.at(field.key);
                } else {
                    static const T empty;
                    const MemberSchema as{field.range, field.traits};
                    schema = as.written(empty.*member);
                    if (const Json left = as.left(empty.*member); !field.has(needed) && !left.is_null())
                        schema["default"] = left;
                }
            },
            field.member);
        if (*field.help)
            schema["description"] = field.help;
        if (field.has(needed))
            required.push_back(field.key);
        if (field.instead_of && properties.contains(field.instead_of))
            rules.push_back({{"not", {{"required", {field.instead_of, field.key}}}}});
    }
    Json schema = object_of(properties, required);
    if (!rules.empty())
        schema["allOf"] = rules;
    return schema;
}

Json named(const char *type)
{
    return {{"type", {{"const", type}}}};
}

Json density()
{
    Json gaussians = named("gaussians");
    gaussians["file"] = {{"type", "string"}, {"minLength", 1}};
    const Json terms =
        Json::array({object_of_fields<DensityTerm>(density_fields, 1u << BRUME_DENSITY_CONSTANT, named("constant")),
                     object_of_fields<DensityTerm>(density_fields, 1u << BRUME_DENSITY_EXPONENTIAL, named("exponential")),
                     object_of_fields<GaussianTerm>(gaussian_fields, ~0u, named("gaussian")),
                     object_of_fields<GaussianSet>(gaussian_set_fields, ~0u, gaussians)});
    return {{"type", "array"},
            {"description", "Terms that add up; none: constant 1"},
            {"items", {{"oneOf", terms}}},
            {"contains", {{"properties", named("exponential")}}},
            {"minContains", 0},
            {"maxContains", BRUME_MAX_DENSITY_TERMS}};
}

Json shadow(const char *projection, uint32_t kind, const Json &depth)
{
    return described(
        object_of_fields<ShadowText>(shadow_fields, kind, {{"projection", {{"const", projection}}}, {"depth", depth}}),
        kind == latlong_map   ? "Shadow map: the distance to the scene as seen from the light, all around"
        : kind & device_kinds ? "Shadow map: a depth buffer of the scene as seen from the light"
                              : "Shadow map: the scene's depth as seen from the light");
}

Json lights()
{
    const Json distances{{"enum", {"planar", "ray"}}}, device{{"const", "device"}};
    const Json of_screen = described({{"const", "screen"}}, "What the picture shows throws shadows, by its depth");
    const Json around{{"oneOf", Json::array({of_screen, shadow("perspective", flat_map, distances),
                                             shadow("perspective", flat_buffer, device),
                                             shadow("latlong", latlong_map, {{"const", "ray"}})})}},
        parallel{{"oneOf", Json::array({shadow("orthographic", parallel_map, distances),
                                        shadow("orthographic", parallel_buffer, device)})}};
    Json kinds = Json::array();
    for (uint32_t type = BRUME_LIGHT_POINT; type <= BRUME_LIGHT_DIRECTIONAL; ++type) {
        Json own = named(light_names[type]);
        own["shadow"] = type == BRUME_LIGHT_DIRECTIONAL ? parallel : around;
        own["surfaces"] = {{"type", "boolean"}};
        own["group"] = {{"type", "string"}, {"minLength", 1}};
        kinds.push_back(object_of_fields<Light>(light_fields, 1u << type, own));
    }
    return {{"type", "array"}, {"maxItems", BRUME_MAX_LIGHTS}, {"items", {{"oneOf", kinds}}}};
}

Json environment()
{
    Json counts = Json::array();
    for (size_t order = 1; order <= 6; ++order)
        counts.push_back(array_of(array_of(constant(ranges::any), 3), order * order));
    const Json own{{"sh", {{"anyOf", counts}}}, {"up", {{"enum", {"y", "z"}}}}};
    return {{"description", "Distant light from all around"},
            {"oneOf", Json::array({object_of_fields<Environment>(environment_fields, coefficients_kind, own),
                                   object_of_fields<Environment>(environment_fields, picture_kind, own)})}};
}

Json quality()
{
    const Json preset{{"enum", std::vector<std::string>(std::begin(preset_names), std::end(preset_names))}};
    Json kinds = Json::array({preset});
    for (uint32_t kind : {preset_kind, error_kind, budget_kind})
        kinds.push_back(object_of_fields<Quality>(quality_fields, kind, {{"preset", preset}}));
    return {{"description", "Largest error or time of a frame, by which plans choose parameters that `effects` leave open"},
            {"oneOf", kinds}};
}

Json parameter_schema(const Parameter &parameter)
{
    Json schema;
    switch (parameter.type) {
    case BRUME_PARAMETER_BOOLEAN:
        schema = {{"type", "boolean"}, {"default", parameter.default_value != 0.0}};
        break;
    case BRUME_PARAMETER_CHOICE:
        schema = {{"enum", parameter.choices}, {"default", parameter.choices[size_t(parameter.default_value)]}};
        break;
    case BRUME_PARAMETER_INTEGER:
        schema = {{"type", "integer"},
                  {"minimum", int64_t(parameter.minimum)},
                  {"maximum", int64_t(parameter.maximum)},
                  {"default", int64_t(parameter.default_value)}};
        break;
    default:
        schema = constant({parameter.minimum, parameter.maximum});
        schema["default"] = parameter.default_value;
    }
    return described(schema, parameter.unit.empty() ? parameter.help : parameter.help + " [" + parameter.unit + "]");
}

Json effects_schema(const EffectRegistry &registry)
{
    Json effects = Json::object();
    for (const Effect &effect : registry.all()) {
        if (!effect.refusal.empty())
            continue;
        Json parameters = Json::object(), rules = Json::array();
        for (const Parameter &parameter : effect.parameters) {
            parameters[parameter.name] = parameter_schema(parameter);
            if (parameter.alias.empty())
                continue;
            Json &alias = parameters[parameter.alias] =
                described(parameter_schema(parameter), "The same as " + parameter.name);
            alias["deprecated"] = true;
            rules.push_back({{"not", {{"required", {parameter.name, parameter.alias}}}}});
        }
        Json schema = object_of(parameters);
        if (!rules.empty())
            schema["allOf"] = rules;
        effects[effect.name] = described(schema, effect.help);
    }
    return described(object_of(effects), "Effects and their parameters; none: those that the scene needs");
}

}  // namespace

std::string scene_schema(const EffectRegistry &effects)
{
    Json schema = object_of(
        {{"brume", {{"const", 1}, {"description", "Version of the file format"}}},
         {"metres_per_unit", described(constant(ranges::positive), "Length of one scene unit; 1 by default")},
         {"camera", object_of_fields<Camera>(camera_fields)},
         {"medium", object_of_fields<Medium>(medium_fields, ~0u,
                                             {{"density", density()}, {"noise", object_of_fields<Noise>(noise_fields)}})},
         {"lights", lights()},
         {"environment", environment()},
         {"effects", effects_schema(effects)},
         {"quality", quality()}},
        {"brume"});
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "Brume scene";
    return schema.dump(2);
}

}  // namespace brume
