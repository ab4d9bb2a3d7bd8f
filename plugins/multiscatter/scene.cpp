#include "state.h"

#include <algorithm>

namespace multiscatter {

using namespace brume::maths_float;

Medium medium_of(const brume_plugin_scene &scene)
{
    const auto &m = scene.medium;
    Medium medium{};
    auto rgb = [](const float(&v)[3]) { return vec3(v[0], v[1], v[2]); };
    medium.scattering = rgb(m.scattering);
    medium.absorption = rgb(m.absorption);
    medium.emission = rgb(m.emission);
    medium.luminance = rgb(m.luminance);
    medium.asymmetry = m.asymmetry;
    medium.constant = m.constant;
    medium.term_count = m.term_count;
    for (int i = 0; i < m.term_count; ++i)
        medium.terms[i] = vec4(m.terms[i][0], m.terms[i][1], m.terms[i][2], m.terms[i][3]);
    return medium;
}

Camera camera_of(const brume_plugin_scene &scene)
{
    const auto &c = scene.camera;
    auto pair = [](const float(&v)[2]) { return vec2(v[0], v[1]); };
    return Camera{pair(c.focal),       pair(c.tangent_scale), pair(c.center), c.depth_kind,     c.sky,
                  pair(c.depth_range), c.far_distance,        c.sky_distance, c.metres_per_unit};
}

}  // namespace multiscatter
