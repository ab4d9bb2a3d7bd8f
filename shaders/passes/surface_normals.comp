// Normals from depth, where the caller gives none. In camera axes.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "shadow.glsl"
#include "value.glsl"
#include "shadow_lit.glsl"
#include "shadow_map.glsl"
#include "airlight.glsl"
#include "lamp_field.glsl"
#include "environment.glsl"
#include "surface.glsl"

uniform Camera brume_camera;
uniform sampler2D depth;
writeonly uniform image2D normals;

Ray ray_at(ivec2 p)
{
    ivec2 inside = clamp(p, ivec2(0), brume_grid - 1);
    // Beyond the border there is no neighbour: the one on the other side counts.
    float raw = inside == p ? texelFetch(depth, p, 0).r : uintBitsToFloat(0x7f800000u);
    return pixel_ray(brume_camera, vec2(inside) + 0.5, raw);
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec3 normal = normal_by_depth(ray_at(p), ray_at(p - ivec2(1, 0)), ray_at(p + ivec2(1, 0)), ray_at(p - ivec2(0, 1)),
                                  ray_at(p + ivec2(0, 1)));
    imageStore(normals, p, vec4(normal, 1.0));
}
