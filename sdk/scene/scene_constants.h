#pragma once
// The members of what effects see of the scene, and the uniforms that they are (shaders/lib/scene.glsl).
#include <cstddef>

#include <brume/brume_plugin.h>

namespace brume {

#define BRUME_MEMBER(type, member, kind, components, count)                                                                 \
    {                                                                                                                       \
#member, kind, components, count, uint32_t(offsetof(type, member))                                                  \
    }
#define BRUME_FLOATS(member, n) BRUME_MEMBER(brume_plugin_medium, member, BRUME_CONSTANT_FLOAT, n, 1)

inline constexpr brume_constant medium_members[] = {
    BRUME_FLOATS(scattering, 3),
    BRUME_FLOATS(absorption, 3),
    BRUME_FLOATS(emission, 3),
    BRUME_FLOATS(luminance, 3),
    BRUME_FLOATS(phase, 4),
    BRUME_FLOATS(noise, 4),
    BRUME_FLOATS(noise_shift, 3),
    BRUME_FLOATS(asymmetry, 1),
    BRUME_FLOATS(constant, 1),
    BRUME_MEMBER(brume_plugin_medium, term_count, BRUME_CONSTANT_INT, 1, 1),
    BRUME_MEMBER(brume_plugin_medium, terms, BRUME_CONSTANT_FLOAT, 4, BRUME_MAX_DENSITY_TERMS),
};
#undef BRUME_FLOATS
#define BRUME_FLOATS(member, n) BRUME_MEMBER(brume_plugin_camera, member, BRUME_CONSTANT_FLOAT, n, 1)
#define BRUME_INT(member) BRUME_MEMBER(brume_plugin_camera, member, BRUME_CONSTANT_INT, 1, 1)

inline constexpr brume_constant camera_members[] = {
    BRUME_FLOATS(focal, 2),
    BRUME_FLOATS(tangent_scale, 2),
    BRUME_FLOATS(center, 2),
    BRUME_INT(depth_kind),
    BRUME_INT(sky),
    BRUME_FLOATS(depth_range, 2),
    BRUME_FLOATS(far_distance, 1),
    BRUME_FLOATS(sky_distance, 1),
    BRUME_FLOATS(metres_per_unit, 1),
    BRUME_INT(nonpositive),
    BRUME_FLOATS(right, 3),
    BRUME_FLOATS(up, 3),
    BRUME_FLOATS(back, 3),
};
#undef BRUME_INT
#undef BRUME_FLOATS
#undef BRUME_MEMBER

}  // namespace brume
