#include <nlohmann/json.hpp>

#include "effects/effects.h"
#include "scene/scene.h"
#include "base/scene_ranges.h"

namespace brume {
namespace {

using Json = nlohmann::ordered_json;

Json reference(const std::string &definition)
{
    return {{"$ref", "#/$defs/" + definition}};
}

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

Json not_together(const std::string &one, const std::string &other)
{
    return {{"not", {{"required", {one, other}}}}};
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

Json definitions()
{
    const Json vector = array_of(reference("number"), 3);
    Json direction = vector;
    direction["not"] = {{"const", {0, 0, 0}}};
    return {{"number", number(ranges::any)},
            {"not_negative", number(ranges::not_negative)},
            {"fraction", number(ranges::fraction)},
            {"field_of_view", number(ranges::field_of_view)},
            {"rgb", {{"anyOf", Json::array({reference("not_negative"), array_of(reference("not_negative"), 3)})}}},
            {"vector", vector},
            {"direction", direction}};
}

Json camera()
{
    Json schema = object_of(
        {{"vertical_fov", described(reference("field_of_view"), "Of the display window's height [degrees]")},
         {"horizontal_fov", described(reference("field_of_view"), "Of the display window's width [degrees]")},
         {"camera_to_world", described(array_of(array_of(reference("number"), 4), 4),
                                       "Row-major, applied to column points; rigid; looks down -z, +y up")},
         {"pixel_aspect", described(number(ranges::pixel_aspect), "Width of a pixel over its height; 1 by default")},
         {"center", described(array_of(number(ranges::center), 2),
                              "Principal point as a fraction of the display window, from its left and its top")}});
    schema["allOf"] = Json::array({not_together("vertical_fov", "horizontal_fov")});
    return schema;
}

Json density()
{
    const Json value = described(reference("not_negative"), "Ratio to unit density; 1 by default");
    const Json constant_term = object_of({{"type", {{"const", "constant"}}}, {"value", value}}, {"type"});
    const Json exponential_term =
        object_of({{"type", {{"const", "exponential"}}},
                   {"value", value},
                   {"falloff", described(reference("not_negative"), "[1/m]; 0 by default")},
                   {"direction", described(reference("direction"), "The density falls along it; [0, 1, 0] by default")},
                   {"origin", described(reference("vector"), "Where the density has its value; scene units")}},
                  {"type"});
    const Json tint{{"anyOf", Json::array({reference("fraction"), array_of(reference("fraction"), 3)})}};
    const Json gaussian_term =
        object_of({{"type", {{"const", "gaussian"}}},
                   {"center", described(reference("vector"), "Scene units")},
                   {"scale", described(number(ranges::positive), "a of exp(-a^2 |x - center|^2) [1/scene unit]")},
                   {"amplitude", described(reference("not_negative"), "Ratio to unit density; 1 by default")},
                   {"colour", described(tint, "Share of what it would scatter that is not absorbed; 1 by default")}},
                  {"type", "center", "scale"});
    const Json gaussians_term = object_of(
        {{"type", {{"const", "gaussians"}}},
         {"file", described({{"type", "string"}},
                            "CSV or PLY, relative to the scene file; one per frame with %04d or #### in its name")},
         {"amplitude", described(reference("not_negative"), "Times each of theirs; 1 by default")}},
        {"type", "file"});
    return {{"type", "array"},
            {"description", "Terms that add up; none: constant 1"},
            {"items", {{"oneOf", Json::array({constant_term, exponential_term, gaussian_term, gaussians_term})}}},
            {"contains", {{"properties", {{"type", {{"const", "exponential"}}}}}}},
            {"minContains", 0},
            {"maxContains", BRUME_MAX_DENSITY_TERMS}};
}

Json medium()
{
    Json schema = object_of(
        {{"scattering", described(reference("rgb"), "At unit density [1/m]")},
         {"absorption", described(reference("rgb"), "At unit density [1/m]")},
         {"emission", described(reference("rgb"), "Radiance per metre at unit density")},
         {"g", described(number(ranges::asymmetry), "Mean cosine of the phase function")},
         {"visibility", described(number(ranges::positive), "[m]; instead of scattering: 3.912 / visibility - absorption")},
         {"droplet_diameter", described(number(ranges::droplet_diameter), "[um]; instead of g")},
         {"density", density()},
         {"noise", described(object_of({{"strength", described(number(ranges::noise_strength), "In radii of each Gaussian")},
                                        {"scale", described(number(ranges::noise_scale), "Scene units; 1 by default")},
                                        {"offset", described(reference("vector"), "Scene units; keys animate it")},
                                        {"seed", {{"type", "integer"}, {"minimum", 0}, {"maximum", 65535}}}},
                                       {"strength"}),
                             "Shifts the view ray before it meets a Gaussian")}});
    schema["allOf"] = Json::array({not_together("scattering", "visibility"), not_together("g", "droplet_diameter")});
    return schema;
}

// A shadow map of one projection; those of points and spots are perspective, those of directional lights orthographic where
// none is named.
Json shadow(const std::string &projection, bool device = false)
{
    const bool parallel = projection == "orthographic";
    Json properties{
        {"file", described({{"type", "string"}},
                           "Depth picture, relative to the scene file; one per frame with %04d or #### in its name")},
        {"camera_to_world", described(array_of(array_of(reference("number"), 4), 4),
                                      "Of the camera that took it; row-major; rigid; looks down -z, +y up")},
        {"projection", {{"const", projection}}}};
    std::vector<std::string> required{"file", "camera_to_world"};
    if (projection == "latlong") {
        required.push_back("projection");
        properties["depth"] = {{"const", "ray"}};
        return described(object_of(properties, required),
                         "Shadow map: the distance to the scene as seen from the light, all around");
    }
    required.push_back(parallel ? "orthographic_width" : "vertical_fov");
    properties[required.back()] = parallel ? described(number(ranges::positive), "Of the map; scene units")
                                           : described(reference("field_of_view"), "Of the map's height [degrees]");
    if (!device) {
        properties["depth"] = described({{"enum", {"planar", "ray"}}}, "planar by default; in scene units");
        return described(object_of(properties, required), "Shadow map: the scene's depth as seen from the light");
    }
    const Json plane = constant(parallel ? ranges::any : ranges::positive);
    properties["depth"] = described({{"const", "device"}}, "A depth buffer of 0 to 1");
    properties["near"] = described(plane, "Where it is 0; scene units");
    properties["far"] =
        described(plane, std::string("Where it is 1; scene units") + (parallel ? "" : "; infinite by default"));
    properties["reversed"] = described({{"type", "boolean"}}, "It is 1 at near and 0 at far");
    required.insert(required.end(), {"depth", "near"});
    if (parallel)
        required.push_back("far");
    return described(object_of(properties, required), "Shadow map: a depth buffer of the scene as seen from the light");
}

Json lights()
{
    const Json type_of_point{{"const", "point"}}, type_of_spot{{"const", "spot"}}, type_of_sun{{"const", "directional"}};
    const Json position = described(reference("vector"), "Scene units");
    const Json direction = described(reference("direction"), "Where it shines to");
    const Json radiant = described(reference("rgb"), "[radiance m^2]: pi r^2 times the radiance of a sphere of radius r");
    const Json irradiance = described(reference("rgb"), "Irradiance on a surface that faces it");
    const Json radius = described(reference("not_negative"), "Scene units; 0 by default");
    const Json angle = described(number(ranges::spot_degrees), "Of the whole cone [degrees]; 45 by default");
    const Json penumbra =
        described(reference("fraction"), "Share of the half angle over which it falls off to nothing; .1 by default");
    const Json distance = described(reference("not_negative"),
                                    "That its light has come through the constant density; scene units; 0 by default");
    const Json of_screen = described({{"const", "screen"}}, "What the picture shows throws shadows, by its depth");
    const Json perspective{
        {"oneOf", Json::array({of_screen, shadow("perspective"), shadow("perspective", true), shadow("latlong")})}},
        parallel{{"oneOf", Json::array({shadow("orthographic"), shadow("orthographic", true)})}};
    const Json surfaces =
                   described({{"type", "boolean"}}, "false: nothing of what surfaces show is this light's; true by default"),
               group = described({{"type", "string"}, {"minLength", 1}},
                                 "Layer that has this light's share of the picture, as renderers' light groups do");
    const Json kinds = Json::array({object_of({{"type", type_of_point},
                                               {"position", position},
                                               {"intensity", radiant},
                                               {"radius", radius},
                                               {"shadow", perspective},
                                               {"surfaces", surfaces},
                                               {"group", group}},
                                              {"type", "position", "intensity"}),
                                    object_of({{"type", type_of_spot},
                                               {"position", position},
                                               {"direction", direction},
                                               {"intensity", radiant},
                                               {"radius", radius},
                                               {"angle", angle},
                                               {"penumbra", penumbra},
                                               {"shadow", perspective},
                                               {"surfaces", surfaces},
                                               {"group", group}},
                                              {"type", "position", "direction", "intensity"}),
                                    object_of({{"type", type_of_sun},
                                               {"direction", direction},
                                               {"intensity", irradiance},
                                               {"distance", distance},
                                               {"shadow", parallel},
                                               {"surfaces", surfaces},
                                               {"group", group}},
                                              {"type", "direction", "intensity"})});
    return {{"type", "array"}, {"maxItems", BRUME_MAX_LIGHTS}, {"items", {{"oneOf", kinds}}}};
}

Json environment()
{
    Json counts = Json::array();
    for (size_t order = 1; order <= 6; ++order)
        counts.push_back(array_of(array_of(constant(ranges::any), 3), order * order));
    const Json coefficients{{"anyOf", counts},
                            {"description", "RGB of real spherical harmonics in world axes: l = 0, 1, ..., m = -l to l"}};
    const Json file = described({{"type", "string"}}, "Lat-long image, relative to the scene file");
    const Json up{{"enum", {"y", "z"}}, {"description", "World axis of the image's top; y by default"}};
    return {{"description", "Distant light from all around"},
            {"oneOf",
             Json::array({object_of({{"sh", coefficients}}, {"sh"}), object_of({{"file", file}, {"up", up}}, {"file"})})}};
}

Json quality()
{
    const Json preset{{"enum", std::vector<std::string>(std::begin(preset_names), std::end(preset_names))}};
    const Json transmittance =
        described(constant(ranges::fraction), "Mean of what frames show; 0, the default: taken for dense");
    const Json detail =
        described(constant(ranges::detail), "Of frames against themselves blurred 9 x 9; 0, the default: taken for 5");
    auto asking = [&](const char *name, const Json &schema) {
        return object_of({{name, schema}, {"transmittance", transmittance}, {"detail", detail}}, {name});
    };
    return {{"description", "Largest error or time of a frame, by which plans choose parameters that `effects` leave open"},
            {"oneOf", Json::array({preset, asking("preset", preset),
                                   asking("max_error",
                                          described(constant(ranges::max_error), "Root of relMSE against the references")),
                                   asking("budget_ms", described(constant(ranges::budget_ms), "Milliseconds a frame"))})}};
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
        Json parameters = Json::object();
        for (const Parameter &parameter : effect.parameters)
            parameters[parameter.name] = parameter_schema(parameter);
        effects[effect.name] = described(object_of(parameters), effect.help);
    }
    return described(object_of(effects), "Effects and their parameters; none: those that the scene needs");
}

}  // namespace

std::string scene_schema(const EffectRegistry &effects)
{
    Json schema =
        object_of({{"brume", {{"const", 1}, {"description", "Version of the file format"}}},
                   {"metres_per_unit", described(constant(ranges::positive), "Length of one scene unit; 1 by default")},
                   {"camera", camera()},
                   {"medium", medium()},
                   {"lights", lights()},
                   {"environment", environment()},
                   {"effects", effects_schema(effects)},
                   {"quality", quality()}},
                  {"brume"});
    schema["$defs"] = definitions();
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = "Brume scene";
    return schema.dump(2);
}

}  // namespace brume
