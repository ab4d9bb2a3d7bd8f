#include "calibrated/sky.h"

#include <algorithm>
#include <cmath>

namespace multiscatter {

using namespace brume::maths_float;

float first_sky(const brume_plugin_scene &scene)
{
    const float(&s)[3] = scene.medium->scattering;
    return -5 - octaves_of(std::max({s[0], s[1], s[2]}));
}

bool Sky::follow(const brume_plugin_scene &scene, ivec2 size)
{
    const brume_plugin_camera &c = *scene.camera;
    const brume_plugin_medium &m = *scene.medium;
    asked_.clear();
    for (const float *v : {c.right, c.up, c.back, m.scattering})
        asked_.insert(asked_.end(), v, v + 3);
    for (const float *v : {c.center, c.tangent_scale})
        asked_.insert(asked_.end(), v, v + 2);
    asked_.insert(asked_.end(), {float(size.x), float(size.y), m.asymmetry});
    for (uint32_t i = 0; i < scene.environment_count; ++i)
        asked_.insert(asked_.end(), scene.environment[i], scene.environment[i] + 3);
    if (asked_ == made_of_)
        return false;
    made_of_ = asked_;
    const Data environment = environment_of(scene);
    const Medium medium = medium_of(scene);
    const Camera camera = camera_of(scene);
    const int order = environment_order(scene);
    values_.resize(size_t(sky_depths) * sky_nodes * sky_nodes * 4);
    for (int row = 0; row < sky_nodes; ++row)
        for (int column = 0; column < sky_nodes; ++column) {
            const vec2 pixel = vec2(size) * vec2(float(column), float(row)) / float(sky_nodes - 1);
            const vec3 direction = in_world(camera, normalize(ray_through(camera, pixel)));
            const Degrees degrees = environment_degrees(environment.texture(), order, direction);
            for (int depth = 0; depth < sky_depths; ++depth) {
                const vec3 around = environment_around(medium, degrees, order, std::exp2(first_sky(scene) + float(depth)));
                float *to = &values_[size_t((depth * sky_nodes + row) * sky_nodes + column) * 4];
                to[0] = around.x;
                to[1] = around.y;
                to[2] = around.z;
                to[3] = 1;
            }
        }
    return true;
}

}  // namespace multiscatter
