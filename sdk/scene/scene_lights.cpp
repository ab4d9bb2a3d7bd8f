#include <algorithm>

#include "scene/frame_values.h"

namespace brume {
namespace {

// So that the square of a length is finite in float.
float length_in_float(double metres)
{
    return float(std::clamp(metres, -1e18, 1e18));
}

void copy(const std::array<double, 3> &from, float (&to)[3])
{
    std::transform(from.begin(), from.end(), to, [](double x) { return float(x); });
}

void evaluate_shadow(const LightShadow &shadow, const Pose &pose, const FrameValues &values, const ValueName &name,
                     brume_plugin_light &out)
{
    if (shadow.kind == BRUME_SHADOW_NONE)
        return;
    const bool perspective = shadow.kind == BRUME_SHADOW_PERSPECTIVE;
    const bool around = shadow.kind == BRUME_SHADOW_LATLONG;
    const double extent =
        around ? 1.0
               : values.get(shadow.extent, perspective ? ranges::shadow_angle : ranges::positive, name.of(".shadow_extent"));
    std::array<double, 16> to_world;
    for (size_t i = 0; i < 16; ++i)
        to_world[i] = values.get(shadow.to_world[i], ranges::any, name.of(".shadow_to_world"));
    // Axis by axis of the map's camera. Positions are subtracted before anything is rounded: both may be far from the
    // origin.
    for (size_t axis = 0; axis < 3; ++axis) {
        std::array<double, 3> along;
        double from_map = 0;
        for (size_t i = 0; i < 3; ++i) {
            along[i] = to_world[4 * i + axis];
            from_map += along[i] * (pose.position[i] - to_world[4 * i + 3] * pose.metres_per_unit);
        }
        const std::array<double, 3> seen = pose.rotated(along);
        std::transform(seen.begin(), seen.end(), out.shadow_rows[axis], [](double x) { return float(x); });
        out.shadow_rows[axis][3] = length_in_float(from_map);
    }
    out.shadow_kind = float(shadow.kind);
    out.shadow_extent = perspective ? float(std::tan(0.5 * extent)) : length_in_float(0.5 * extent * pose.metres_per_unit);
    out.shadow_depth = float(shadow.depth);
}

brume_plugin_light evaluate(const Light &light, const Pose &pose, const FrameValues &values, const ValueName &name)
{
    brume_plugin_light out{};
    out.type = float(light.type);
    out.surfaces = float(light.surfaces);
    copy(values.get(light.intensity, ranges::not_negative, name.of(".intensity")), out.intensity);
    evaluate_shadow(light.shadow, pose, values, name, out);
    if (light.type != BRUME_LIGHT_POINT)
        copy(pose.rotated(values.unit_vector(light.direction, name.of(".direction"))), out.direction);
    if (light.type == BRUME_LIGHT_DIRECTIONAL) {
        out.distance =
            length_in_float(values.get(light.distance, ranges::not_negative, name.of(".distance")) * pose.metres_per_unit);
        return out;
    }
    const std::array<double, 3> position = pose.seen(values.get(light.position, ranges::any, name.of(".position")));
    std::transform(position.begin(), position.end(), out.position, length_in_float);
    out.radius = length_in_float(values.get(light.radius, ranges::not_negative, name.of(".radius")) * pose.metres_per_unit);
    if (light.type == BRUME_LIGHT_SPOT) {
        const double half_angle = 0.5 * values.get(light.angle, ranges::spot_angle, name.of(".angle"));
        const double penumbra = values.get(light.penumbra, ranges::fraction, name.of(".penumbra"));
        out.cos_outer = float(std::cos(half_angle));
        out.cos_inner = float(std::cos(half_angle * (1.0 - penumbra)));
    }
    return out;
}

}  // namespace

void evaluate_lights(const Scene &scene, double frame, const std::array<double, 16> &camera_to_world,
                     std::vector<brume_plugin_light> &out)
{
    const FrameValues values(frame);
    const Pose pose(camera_to_world, scene.metres_per_unit, values);
    out.clear();
    for (size_t i = 0; i < scene.lights.size(); ++i)
        out.push_back(evaluate(scene.lights[i], pose, values, {"lights", int64_t(i)}));
}

}  // namespace brume
