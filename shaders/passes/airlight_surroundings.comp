// Where surfaces are around each lamp.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "noise.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "shadow.glsl"
#include "value.glsl"
#include "shadow_lit.glsl"
#include "shadow_map.glsl"
#include "surroundings.glsl"
#include "airlight.glsl"

uniform Camera brume_camera;
uniform SurroundingsSettings around;
uniform ivec2 size;  // of the full images
uniform AirlightSettings airlight;
uniform sampler2D depth;
uniform sampler2D lights;
writeonly uniform image2D surroundings;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    int i = p.y * 1024 + p.x;
    if (p.x >= brume_grid.x || p.y >= brume_grid.y || i >= sides * airlight.light_count)
        return;
    int lamp = i / sides;
    imageStore(surroundings, p,
               surroundings_texel(around, brume_camera, depth, size, light_at(lights, lamp), i - sides * lamp));
}
