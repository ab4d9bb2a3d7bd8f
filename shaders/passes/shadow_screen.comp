// A light's shadow map by what the picture itself shows, into its rectangle of the image of all.
#include "scene.glsl"
#include "ray.glsl"
#include "data.glsl"
#include "phase.glsl"
#include "value.glsl"
#include "shadow_lit.glsl"
#include "shadow_map.glsl"
#include "shadow_screen.glsl"

uniform Camera brume_camera;
uniform int light;
uniform float radius;
uniform ivec2 corner;
uniform sampler2D depth;
uniform sampler2D light_shadows;
writeonly uniform image2D shadow_maps;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    imageStore(shadow_maps, corner + p, vec4(screen_shadow(brume_camera, depth, light_shadows, light, radius, p), 0.0, 0.0, 1.0));
}
