#include <algorithm>
#include <cmath>

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

// Rows of the map, whose camera is there in the world [m] with these axes. Positions are subtracted before anything is
// rounded: both may be far from the origin.
void place_shadow(const Pose &pose, const std::array<double, 3> &position, const std::array<std::array<double, 3>, 3> &axes,
                  brume_plugin_light &out)
{
    for (size_t axis = 0; axis < 3; ++axis) {
        double from_map = 0;
        for (size_t i = 0; i < 3; ++i)
            from_map += axes[axis][i] * (pose.position[i] - position[i]);
        const std::array<double, 3> seen = pose.rotated(axes[axis]);
        std::transform(seen.begin(), seen.end(), out.shadow_rows[axis], [](double x) { return float(x); });
        out.shadow_rows[axis][3] = length_in_float(from_map);
    }
}

// Of the widest cones a flat map would be too coarse in the middle.
constexpr double widest_flat_map = 2.1;  // [rad]

// By the picture's depth: around the light, or as wide as its cone.
void evaluate_screen_shadow(const Light &light, const Pose &pose, const FrameValues &values, const ValueName &name,
                            brume_plugin_light &out)
{
    std::array<std::array<double, 3>, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    out.shadow_kind = float(BRUME_SHADOW_LATLONG);
    if (light.type == BRUME_LIGHT_SPOT) {
        const double angle = values.get(light.angle, ranges::spot_angle, name.of(".angle"));
        if (angle < widest_flat_map) {
            out.shadow_kind = float(BRUME_SHADOW_PERSPECTIVE);
            // The cone's rim is within the map.
            out.shadow_extent = float(1.02 * std::tan(0.5 * std::max(angle, 1e-3)));
        }
        const std::array<double, 3> to = values.unit_vector(light.direction, name.of(".direction"));
        const size_t least =
            size_t(std::min_element(to.begin(), to.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
                   to.begin());
        std::array<double, 3> right{};
        for (size_t i = 0; i < 3; ++i)
            right[i] = (i == least ? 1.0 : 0.0) - to[least] * to[i];
        const double length = std::sqrt(right[0] * right[0] + right[1] * right[1] + right[2] * right[2]);
        for (size_t i = 0; i < 3; ++i) {
            axes[0][i] = right[i] / length;
            axes[2][i] = -to[i];
        }
        for (size_t i = 0; i < 3; ++i)
            axes[1][i] = axes[2][(i + 1) % 3] * axes[0][(i + 2) % 3] - axes[2][(i + 2) % 3] * axes[0][(i + 1) % 3];
    }
    std::array<double, 3> position = values.get(light.position, ranges::any, name.of(".position"));
    for (double &x : position)
        x *= pose.metres_per_unit;
    place_shadow(pose, position, axes, out);
    out.shadow_depth = float(BRUME_DEPTH_RAY);
    out.shadow_screen = 1;
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
    std::array<std::array<double, 3>, 3> axes;
    std::array<double, 3> position;
    for (size_t i = 0; i < 3; ++i) {
        position[i] = to_world[4 * i + 3] * pose.metres_per_unit;
        for (size_t axis = 0; axis < 3; ++axis)
            axes[axis][i] = to_world[4 * i + axis];
    }
    place_shadow(pose, position, axes, out);
    out.shadow_kind = float(shadow.kind);
    out.shadow_extent = perspective ? float(std::tan(0.5 * extent)) : length_in_float(0.5 * extent * pose.metres_per_unit);
    out.shadow_depth = float(shadow.depth);
    for (size_t i = 0; i < 2 && shadow.depth == BRUME_DEPTH_DEVICE; ++i) {
        const double plane = shadow.range[i] * pose.metres_per_unit;
        out.shadow_range[i] = perspective ? length_in_float(1 / plane) : length_in_float(plane);
    }
}

brume_plugin_light evaluate(const Light &light, const Pose &pose, const FrameValues &values, const ValueName &name)
{
    brume_plugin_light out{};
    out.type = float(light.type);
    out.surfaces = float(light.surfaces);
    copy(values.get(light.intensity, ranges::not_negative, name.of(".intensity")), out.intensity);
    if (light.shadow.kind == BRUME_SHADOW_SCREEN)
        evaluate_screen_shadow(light, pose, values, name, out);
    else
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
