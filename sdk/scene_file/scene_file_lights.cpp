#include <fmt/format.h>

#include "scene/scene_check.h"
#include "scene_file/scene_file.h"
#include "scene/scene_numbers.h"

namespace brume {
namespace {

LightShadow read_shadow(const JsonNode &node, bool parallel, const std::filesystem::path &folder)
{
    LightShadow shadow;
    if (const auto projection = parallel ? std::nullopt : node.find("projection")) {
        const std::string what = "\"latlong\"";
        if (projection->string(what) != "latlong")
            projection->expected(what);
        node.allow_only({"file", "camera_to_world", "projection"});
        shadow.kind = BRUME_SHADOW_LATLONG;
        shadow.depth = BRUME_DEPTH_RAY;
        shadow.file = (folder / node.get("file").string("the name of an image")).string();
        shadow.to_world = read_matrix(node.get("camera_to_world"));
        return shadow;
    }
    const char *const extent = parallel ? "orthographic_width" : "vertical_fov";
    if (parallel)
        node.allow_only({"file", "camera_to_world", extent, "depth"});
    else
        node.allow_only({"file", "camera_to_world", extent, "depth", "projection"});
    shadow.kind = parallel ? BRUME_SHADOW_ORTHOGRAPHIC : BRUME_SHADOW_PERSPECTIVE;
    shadow.file = (folder / node.get("file").string("the name of an image")).string();
    shadow.to_world = read_matrix(node.get("camera_to_world"));
    shadow.extent = parallel ? read_number(node.get(extent), ranges::positive)
                             : in_radians(read_number(node.get(extent), ranges::field_of_view));
    if (const auto depth = node.find("depth")) {
        const std::string what = "\"planar\" or \"ray\"";
        const std::string &kind = depth->string(what);
        if (kind != "planar" && kind != "ray")
            depth->expected(what);
        shadow.depth = kind == "ray" ? BRUME_DEPTH_RAY : BRUME_DEPTH_PLANAR;
    }
    return shadow;
}

Light read_light(const JsonNode &node, const std::filesystem::path &folder)
{
    const JsonNode type = node.get("type");
    const std::string what = "\"point\", \"spot\" or \"directional\"";
    const std::string &name = type.string(what);
    Light light;
    if (name == "point") {
        node.allow_only({"type", "intensity", "position", "radius", "shadow", "surfaces", "group"});
    } else if (name == "spot") {
        light.type = BRUME_LIGHT_SPOT;
        node.allow_only(
            {"type", "intensity", "position", "radius", "direction", "angle", "penumbra", "shadow", "surfaces", "group"});
    } else if (name == "directional") {
        light.type = BRUME_LIGHT_DIRECTIONAL;
        node.allow_only({"type", "intensity", "direction", "distance", "shadow", "surfaces", "group"});
    } else {
        type.expected(what);
    }
    light.intensity = read_rgb(node.get("intensity"), ranges::not_negative);
    if (light.type != BRUME_LIGHT_DIRECTIONAL)
        light.position = read_vector(node.get("position"), ranges::any);
    if (light.type != BRUME_LIGHT_POINT)
        light.direction = read_direction(node.get("direction"));
    if (const auto radius = node.find("radius"))
        light.radius = read_number(*radius, ranges::not_negative);
    if (const auto angle = node.find("angle"))
        light.angle = in_radians(read_number(*angle, ranges::spot_degrees));
    if (const auto penumbra = node.find("penumbra"))
        light.penumbra = read_number(*penumbra, ranges::fraction);
    if (const auto distance = node.find("distance"))
        light.distance = read_number(*distance, ranges::not_negative);
    if (const auto shadow = node.find("shadow"))
        light.shadow = read_shadow(*shadow, light.type == BRUME_LIGHT_DIRECTIONAL, folder);
    if (const auto surfaces = node.find("surfaces"))
        light.surfaces = surfaces->boolean() ? BRUME_SURFACES_LIT : BRUME_SURFACES_UNLIT;
    if (const auto group = node.find("group")) {
        light.group = group->string("the name of a layer");
        if (light.group.empty())
            group->expected("the name of a layer");
        if (light.surfaces == BRUME_SURFACES_UNLIT)
            group->expected("no group, since surfaces is false");
    }
    return light;
}

// Whose a pixel's light is would be known of all of them together only.
void expect_own_groups(const JsonNode &node, const std::vector<Light> &lights)
{
    for (size_t i = 0; i < lights.size(); ++i)
        for (size_t j = 0; j < i && !lights[i].group.empty(); ++j)
            if (lights[i].group == lights[j].group)
                node.item(i).get("group").expected(fmt::format("a group of its own: lights[{}] has this one", j));
}

}  // namespace

std::vector<Light> read_lights(const JsonNode &node, const std::filesystem::path &folder)
{
    const size_t count = node.array_size("an array of lights");
    if (count > BRUME_MAX_LIGHTS)
        node.expected(fmt::format("at most {} lights", BRUME_MAX_LIGHTS));
    std::vector<Light> lights;
    for (size_t i = 0; i < count; ++i)
        lights.push_back(read_light(node.item(i), folder));
    expect_own_groups(node, lights);
    return lights;
}

Environment read_environment(const JsonNode &node, const std::filesystem::path &folder)
{
    node.allow_only({"sh", "file", "up"});
    node.refuse_both("sh", "file");
    Environment environment;
    if (const auto file = node.find("file")) {
        environment.file = (folder / file->string("the name of an image")).string();
        if (const auto up = node.find("up")) {
            const std::string &axis = up->string("\"y\" or \"z\"");
            if (axis != "y" && axis != "z")
                up->expected("\"y\" or \"z\"");
            environment.file_up = axis == "z" ? BRUME_UP_Z : BRUME_UP_Y;
        }
        return environment;
    }
    const JsonNode list = node.get("sh");
    node.allow_only({"sh"});
    const std::string what = "1, 4, 9, 16, 25 or 36 [r, g, b] triples";
    const size_t count = list.array_size(what);
    if (!is_environment_count(count))
        list.expected(what);
    for (size_t i = 0; i < count; ++i) {
        const JsonNode triple = list.item(i);
        triple.check_array_size(3, "an [r, g, b] triple");
        environment.coefficients.push_back({read_constant(triple.item(0), ranges::any),
                                            read_constant(triple.item(1), ranges::any),
                                            read_constant(triple.item(2), ranges::any)});
    }
    return environment;
}

}  // namespace brume
