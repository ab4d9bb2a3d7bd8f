// The grid of what arrives scattered before.
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
#include "surroundings.glsl"
#include "airlight.glsl"
#include "airlight_parts.glsl"
#include "lamp_field.glsl"
#include "airlight_orders.glsl"
#include "grid_settings.glsl"
#include "grid_fetch.glsl"
#include "airlight_scattered.glsl"
#include "scattered_grid.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform ScatteredSettings settings;
uniform ivec2 light_range;
uniform sampler2D distances;
uniform sampler2D lights;
uniform sampler2D surroundings;
uniform sampler2D light_gaussians;
writeonly uniform image2D result;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int slice = texel.y / settings.rows * settings.across + texel.x / settings.columns;
    if (texel.x >= brume_grid.x || texel.y >= brume_grid.y || slice > settings.slices)
        return;
    imageStore(result, texel,
               scattered_texel(brume_medium, brume_camera, settings, distances, lights, surroundings, light_gaussians, light_range,
                               vec2(texel - scattered_corner(settings, slice)), slice));
}
