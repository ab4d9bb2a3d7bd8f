#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/scene_check.h"
#include "scene_file/scene_file.h"

namespace brume {
namespace {

struct Projection {
    const char *name;
    uint32_t kind;
    bool parallel;
    uint32_t map, buffer;  // of shadow_fields
};

// The first that suits a light goes without saying.
constexpr Projection projections[] = {{"perspective", BRUME_SHADOW_PERSPECTIVE, false, flat_map, flat_buffer},
                                      {"latlong", BRUME_SHADOW_LATLONG, false, latlong_map, latlong_map},
                                      {"orthographic", BRUME_SHADOW_ORTHOGRAPHIC, true, parallel_map, parallel_buffer}};

const Projection &read_projection(const JsonNode &node, bool parallel)
{
    const auto given = node.find("projection");
    const std::string what = parallel ? "\"orthographic\"" : "\"perspective\" or \"latlong\"";
    const std::string name = given ? given->string(what) : "";
    for (const Projection &projection : projections)
        if (projection.parallel == parallel && (!given || name == projection.name))
            return projection;
    given->expected(what);
}

uint32_t read_depth(const JsonNode &node, bool around)
{
    const auto depth = node.find("depth");
    if (!depth)
        return around ? BRUME_DEPTH_RAY : BRUME_DEPTH_PLANAR;
    const std::string what = around ? "\"ray\"" : "\"planar\", \"ray\" or \"device\"";
    const std::string &kind = depth->string(what);
    if (kind != "ray" && (around || (kind != "planar" && kind != "device")))
        depth->expected(what);
    return kind == "ray" ? BRUME_DEPTH_RAY : kind == "planar" ? BRUME_DEPTH_PLANAR : BRUME_DEPTH_DEVICE;
}

LightShadow read_shadow(const JsonNode &node, bool parallel, const std::filesystem::path &folder)
{
    ShadowText shadow;
    if (const std::string *name = node.value().as<std::string>()) {
        if (parallel || *name != "screen")
            node.expected(parallel ? "an object" : "an object, or \"screen\"");
        shadow.kind = BRUME_SHADOW_SCREEN;
        return shadow;
    }
    const Projection &projection = read_projection(node, parallel);
    allow_fields<ShadowText>(node, shadow_fields, projection.map | projection.buffer);
    shadow.kind = projection.kind;
    shadow.depth = read_depth(node, shadow.kind == BRUME_SHADOW_LATLONG);
    const bool device = shadow.depth == BRUME_DEPTH_DEVICE;
    for (const char *key : {"near", "far", "reversed"})
        if (const auto unread = node.find(key); unread && !device)
            unread->expected("none: depth is not device");
    read_fields<ShadowText>(node, folder, shadow_fields, device ? projection.buffer : projection.map, shadow, nothing_more);
    if (!device)
        return shadow;
    if (!(shadow.near < shadow.far))
        node.get("far").expected(fmt::format("a number above near, {}", shadow.near));
    shadow.range = {shadow.near, shadow.far};
    if (shadow.reversed)
        std::swap(shadow.range[0], shadow.range[1]);
    return shadow;
}

Light read_light(const JsonNode &node, const std::filesystem::path &folder)
{
    const JsonNode type = node.get("type");
    const std::string what = "\"point\", \"spot\" or \"directional\"";
    const std::string &name = type.string(what);
    const auto found = std::find(std::begin(light_names), std::end(light_names), name);
    if (found == std::end(light_names))
        type.expected(what);
    Light light;
    light.type = uint32_t(found - std::begin(light_names));
    read_fields<Light>(node, folder, light_fields, 1u << light.type, light,
                       [&](std::string_view key, const JsonNode &value) {
                           if (key == "shadow")
                               light.shadow = read_shadow(value, light.type == BRUME_LIGHT_DIRECTIONAL, folder);
                           else if (key == "surfaces")
                               light.surfaces = value.boolean() ? BRUME_SURFACES_LIT : BRUME_SURFACES_UNLIT;
                           else if (key == "group" && (light.group = value.string("the name of a layer")).empty())
                               value.expected("the name of a layer");
                       });
    if (light.surfaces == BRUME_SURFACES_UNLIT && !light.group.empty())
        node.get("group").expected("no group, since surfaces is false");
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

void read_coefficients(const JsonNode &list, Environment &environment)
{
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
    allow_fields<Environment>(node, environment_fields, ~0u);
    Environment environment;
    if (node.find("file")) {
        const auto up = [&](std::string_view, const JsonNode &value) {
            const std::string &axis = value.string("\"y\" or \"z\"");
            if (axis != "y" && axis != "z")
                value.expected("\"y\" or \"z\"");
            environment.file_up = axis == "z" ? BRUME_UP_Z : BRUME_UP_Y;
        };
        read_fields<Environment>(node, folder, environment_fields, picture_kind, environment, up);
        return environment;
    }
    read_fields<Environment>(node, folder, environment_fields, coefficients_kind, environment,
                             [&](std::string_view, const JsonNode &list) { read_coefficients(list, environment); });
    return environment;
}

}  // namespace brume
