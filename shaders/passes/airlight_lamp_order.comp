// Puts the lights of each tile in order: a row of the grid is a tile.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "noise.glsl"
#include "tiles.glsl"
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
#include "airlight_parts.glsl"
#include "lamp_bound.glsl"
#include "lamp_order.glsl"

uniform int ordered;
uniform sampler2D bounds;
writeonly uniform image2D lamp_order;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    int first = p.y * ordered;
    vec2 place = lamp_place(bounds, first, ordered, p.x);
    int i = first + int(place.x);
    imageStore(lamp_order, ivec2(i & 1023, i >> 10), vec4(float(p.x), place.y, 0.0, 1.0));
}
