#include <algorithm>

#include "core/frame_values.h"

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

brume_plugin_light evaluate(const Light &light, const Pose &pose, const FrameValues &values, const ValueName &name)
{
    brume_plugin_light out{};
    out.type = float(light.type);
    copy(values.get(light.intensity, ranges::not_negative, name.of(".intensity")), out.intensity);
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
