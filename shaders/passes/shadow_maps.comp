// One light's shadow map into its rectangle of the image of all.
#include "scene.glsl"
#include "ray.glsl"
#include "data.glsl"
#include "phase.glsl"
#include "value.glsl"
#include "shadow_lit.glsl"
#include "shadow_map.glsl"

uniform ShadowDepth depth;
uniform ivec2 corner;
uniform sampler2D map;
writeonly uniform image2D shadow_maps;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    imageStore(shadow_maps, corner + p, vec4(shadow_distance(depth, texelFetch(map, p, 0).r), 0.0, 0.0, 1.0));
}
