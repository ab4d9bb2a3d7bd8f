// Which of the lights' shadow maps let their light onto what a pixel shows: a channel for each map.
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
#include "shadow_map.glsl"
#include "airlight.glsl"
#include "lamp_field.glsl"
#include "environment.glsl"
#include "surface.glsl"
#include "surface_shadows.glsl"

uniform Camera brume_camera;
uniform SurfaceSettings settings;
uniform sampler2D depth;
uniform sampler2D light_shadows;
uniform sampler2D shadow_0;
uniform sampler2D shadow_1;
uniform sampler2D shadow_2;
uniform sampler2D shadow_3;
writeonly uniform image2D shadows;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    Ray ray = pixel_ray(brume_camera, vec2(p) + 0.5, texelFetch(depth, p, 0).r);
    imageStore(shadows, p, lit_by_maps(brume_camera, settings.shadowed, SHADOW_MAP_PASSED, ray));
}
