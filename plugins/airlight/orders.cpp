#include "orders.h"

#include <algorithm>
#include <cmath>

#include "scene_maths.hpp"

namespace airlight {
namespace {

using namespace brume::maths_double;

constexpr int rays_a_side = 8;
constexpr uint32_t most_tried = 4096;  // Gaussians
constexpr uint32_t most_lights = 64;

double gaussians_depth(const brume_plugin_scene &scene, vec3 from, vec3 direction, double distance)
{
    const uint32_t step = 1 + scene.gaussian_count / most_tried;
    double sum = 0;
    for (uint32_t i = 0; i < scene.gaussian_count; i += step)
        sum += step * profile_depth(profile_along(gaussian_of(scene.gaussians[i]), from, direction), 0, distance);
    return sum;
}

// Where lamps stand beside Gaussians and not in them, the depth between them and the camera says nothing.
double deepest_gaussians(const brume_plugin_scene &scene, int width, int height)
{
    const auto &c = *scene.camera;
    double deepest = 0;
    for (int i = 0; scene.gaussian_count > 0 && i < rays_a_side * rays_a_side; ++i) {
        const double x = (i % rays_a_side + 0.5) / rays_a_side * width, y = (i / rays_a_side + 0.5) / rays_a_side * height;
        const vec3 direction =
            normalize(vec3((x - c.center[0]) * c.tangent_scale[0], (y - c.center[1]) * c.tangent_scale[1], -1));
        deepest = std::max(deepest, gaussians_depth(scene, vec3(0), direction, far_away));
    }
    return deepest;
}

}  // namespace

double scattered_on_the_way(const brume_plugin_scene &scene, int width, int height)
{
    if (!scene.has_medium || scene.light_count == 0)
        return 0;
    if (scene.gaussian_count > 0 && !scene.gaussians)
        return 1;
    const Medium medium = medium_of(scene);
    const Data data = lights_of(scene);
    const double least = deepest_gaussians(scene, width, height);
    double share = 0;
    for (int l = 0; l < int(scene.light_count); l += 1 + int(scene.light_count / most_lights)) {
        const Light light = light_at(data.texture(), l);
        if (light.type == light_directional)
            continue;
        const double distance = length(light.position);
        const vec3 direction = light.position / std::max(distance, 1e-20);
        const double depth = std::min(
            std::max(terms_to_light(medium, light, vec3(0)) + gaussians_depth(scene, vec3(0), direction, distance), least),
            1e9);
        for (int c = 0; c < 3; ++c) {
            const double s = medium.scattering[c] * depth, a = medium.absorption[c] * depth;
            const double scattered = rescattered(s, a, medium.asymmetry).fluence;
            if (scattered > 0)
                share = std::max(share, scattered / (scattered + std::exp(-s - a)));
        }
    }
    return share;
}

}  // namespace airlight
