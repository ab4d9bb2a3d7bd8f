#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/scene_check.h"
#include "scene_file/scene_file.h"
#include "scene/scene_numbers.h"

namespace brume {
namespace {

struct Projection {
    const char *name;
    uint32_t kind;
    bool parallel;
    const char *extent;  // the key of how much the map sees; NULL: all
};

// The first that suits a light goes without saying.
constexpr Projection projections[] = {{"perspective", BRUME_SHADOW_PERSPECTIVE, false, "vertical_fov"},
                                      {"latlong", BRUME_SHADOW_LATLONG, false, nullptr},
                                      {"orthographic", BRUME_SHADOW_ORTHOGRAPHIC, true, "orthographic_width"}};

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

void read_depth(const JsonNode &node, const Projection &projection, LightShadow &shadow)
{
    const bool around = projection.kind == BRUME_SHADOW_LATLONG;
    shadow.depth = around ? BRUME_DEPTH_RAY : BRUME_DEPTH_PLANAR;
    const auto depth = node.find("depth");
    const std::string what = around ? "\"ray\"" : "\"planar\", \"ray\" or \"device\"";
    if (depth) {
        const std::string &kind = depth->string(what);
        if (kind != "ray" && (around || (kind != "planar" && kind != "device")))
            depth->expected(what);
        shadow.depth = kind == "ray" ? BRUME_DEPTH_RAY : kind == "planar" ? BRUME_DEPTH_PLANAR : BRUME_DEPTH_DEVICE;
    }
    if (shadow.depth != BRUME_DEPTH_DEVICE) {
        for (const char *key : {"near", "far", "reversed"})
            if (const auto unread = node.find(key))
                unread->expected("none: depth is not device");
        return;
    }
    const bool parallel = projection.parallel;
    const double near = read_constant(node.get("near"), parallel ? ranges::any : ranges::positive);
    double far = std::numeric_limits<double>::infinity();
    if (const auto given = node.find("far"))
        far = read_constant(*given, parallel ? ranges::any : ranges::positive);
    else if (parallel)
        node.get("far");
    if (!(near < far))
        node.get("far").expected(fmt::format("a number above near, {}", near));
    shadow.range = {near, far};
    if (const auto reversed = node.find("reversed"); reversed && reversed->boolean())
        std::swap(shadow.range[0], shadow.range[1]);
}

LightShadow read_shadow(const JsonNode &node, bool parallel, const std::filesystem::path &folder)
{
    LightShadow shadow;
    if (const std::string *name = node.value().as<std::string>()) {
        if (parallel || *name != "screen")
            node.expected(parallel ? "an object" : "an object, or \"screen\"");
        shadow.kind = BRUME_SHADOW_SCREEN;
        return shadow;
    }
    const Projection &projection = read_projection(node, parallel);
    std::vector<std::string> keys{"file", "camera_to_world", "projection", "depth", "near", "far", "reversed"};
    if (projection.extent)
        keys.push_back(projection.extent);
    node.allow_only(keys);
    shadow.kind = projection.kind;
    shadow.file = (folder / node.get("file").string("the name of an image")).string();
    shadow.to_world = read_matrix(node.get("camera_to_world"));
    if (projection.extent)
        shadow.extent = parallel ? read_number(node.get(projection.extent), ranges::positive)
                                 : in_radians(read_number(node.get(projection.extent), ranges::field_of_view));
    read_depth(node, projection, shadow);
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
