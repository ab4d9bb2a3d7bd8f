#include "encounters.h"

#include <algorithm>
#include <cmath>

namespace airlight {
namespace {

using namespace brume::maths_double;

constexpr int rays_a_side = 8;
constexpr uint32_t most_tried = 4096;  // Gaussians

struct Sphere {
    vec3 center;
    double reach;
};

struct Met {
    double count = 0;
    double distance = 0;  // where they are, in the mean
};

// spread: by how much the ray is wider per metre.
Met met(const std::vector<Sphere> &spheres, vec3 from, vec3 direction, double spread)
{
    Met m;
    for (const Sphere &s : spheres) {
        const vec3 to = s.center - from;
        const double along = dot(to, direction);
        const double reach = s.reach + spread * along;
        if (along > 0 && dot(to, to) - along * along < reach * reach) {
            ++m.count;
            m.distance += along;
        }
    }
    m.distance /= std::max(m.count, 1.0);
    return m;
}

}  // namespace

std::vector<vec3> tried_rays(const brume_plugin_scene &scene, int width, int height)
{
    const auto &c = *scene.camera;
    std::vector<vec3> directions;
    for (int i = 0; i < rays_a_side * rays_a_side; ++i) {
        const double x = (i % rays_a_side + 0.5) / rays_a_side * width, y = (i / rays_a_side + 0.5) / rays_a_side * height;
        directions.push_back(
            normalize(vec3((x - c.center[0]) * c.tangent_scale[0], (y - c.center[1]) * c.tangent_scale[1], -1)));
    }
    return directions;
}

uint32_t tried_step(const brume_plugin_scene &scene)
{
    return 1 + scene.gaussian_count / most_tried;
}

Encounters encounters(const brume_plugin_scene &scene, int width, int height)
{
    if (scene.gaussian_count == 0)
        return {};
    if (!scene.gaussians)
        return {1, 1};
    const Medium medium = medium_of(scene);
    const uint32_t step = tried_step(scene);
    std::vector<Sphere> spheres;
    const auto gaussians = brume::gaussians_in(scene);
    for (size_t i = 0; i < gaussians.size(); i += step) {
        const Gaussian g = gaussian_of(gaussians[i]);
        spheres.push_back({g.center, gaussian_reach(medium, g)});
    }
    const auto &c = *scene.camera;
    const double tile_spread = BRUME_TILE_SIZE * 0.5 * (c.tangent_scale[0] + std::abs(c.tangent_scale[1])) / sqrt(2.0);
    Encounters sum;
    double lit = 0;
    const std::vector<vec3> rays = tried_rays(scene, width, height);
    for (const vec3 &direction : rays) {
        const Met seen = met(spheres, vec3(0), direction, tile_spread);
        sum.of_sight += seen.count;
        if (!(seen.count > 0))
            continue;
        for (const brume_plugin_light &light : brume::lights_in(scene)) {
            const vec3 point = seen.distance * direction, position(light.position[0], light.position[1], light.position[2]);
            const vec3 to_light = light.type == BRUME_LIGHT_DIRECTIONAL
                                      ? -vec3(light.direction[0], light.direction[1], light.direction[2])
                                      : position - point;
            sum.of_light += met(spheres, point, normalize(to_light), 0).count;
            ++lit;
        }
    }
    sum.of_sight *= step / double(rays.size());
    sum.of_light *= step / std::max(lit, 1.0);
    return sum;
}

}  // namespace airlight
