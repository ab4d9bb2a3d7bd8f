#include "orders.h"

#include <algorithm>
#include <cmath>

#include "encounters.h"

namespace airlight {
namespace {

using namespace brume::maths_double;

constexpr uint32_t most_lights = 64;
constexpr double most_radii = 6;  // from a ray: e^-36 of its density. Plans ask for many of these, and few are nearer.

// Along a ray from the camera.
double gaussians_depth(const brume_plugin_scene &scene, vec3 direction, double distance)
{
    const uint32_t step = tried_step(scene);
    double sum = 0;
    const auto gaussians = brume::gaussians_in(scene);
    for (size_t i = 0; i < gaussians.size(); i += step) {
        const Gaussian g = gaussian_of(gaussians[i]);
        if (g.scale * length(cross(direction, g.center)) < most_radii)
            sum += step * profile_depth(profile_along(g, vec3(0), direction), 0, distance);
    }
    return sum;
}

// Where lamps stand beside Gaussians and not in them, the depth between them and the camera says nothing.
double deepest_gaussians(const brume_plugin_scene &scene, int width, int height)
{
    if (scene.gaussian_count == 0)
        return 0;
    double deepest = 0;
    for (const vec3 &direction : tried_rays(scene, width, height))
        deepest = std::max(deepest, gaussians_depth(scene, direction, far_away));
    return deepest;
}

// Of a sun's fluence at the camera, as if that stood on the ground.
double scattered_of_sun(const Medium &medium, const Light &sun, double gaussians, int c)
{
    const SunSlant slant = sun_slant(medium, sun.direction, vec3(0));
    const double depth = std::min(terms_to_light(medium, sun, vec3(0)) + gaussians, 1e9);
    const double s = medium.scattering[c] * depth, a = medium.absorption[c] * depth;
    const SlabField field = slab_field(vec2(s * slant.cosine), vec2(a * slant.cosine), medium.asymmetry, 1, slant.cosine, 0);
    const double straight = std::exp(-s - a), again = 2 * (field.down + field.up) + field.straight - straight;
    return again > 0 ? again / (again + straight) : 0;
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
        if (light.type == light_directional) {
            for (int c = 0; c < 3; ++c)
                share = std::max(share, scattered_of_sun(medium, light, least, c));
            continue;
        }
        const double distance = length(light.position);
        const vec3 direction = light.position / std::max(distance, 1e-20);
        const double depth = std::min(
            std::max(terms_to_light(medium, light, vec3(0)) + gaussians_depth(scene, direction, distance), least), 1e9);
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
