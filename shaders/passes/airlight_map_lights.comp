#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "value.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "attenuation.glsl"
#include "grid_settings.glsl"
#include "grid_lights.glsl"

uniform Camera brume_camera;
uniform GridSettings grid;
uniform ivec2 light_range;
uniform sampler2D attenuation;
uniform sampler2D attenuation_frames;
uniform sampler2D lights;
uniform sampler2D slices;
writeonly uniform image2D result;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int slice = texel.y / grid.rows * grid.across + texel.x / grid.columns;
    if (texel.x >= brume_grid.x || texel.y >= brume_grid.y || slice > grid.slices)
        return;
    vec3 direction = grid_direction(brume_camera, grid, vec2(texel - grid_corner(grid, slice)));
    imageStore(result, texel, grid_lights_texel(grid, attenuation, attenuation_frames, lights, light_range.x,
                                                light_range.y, direction, data_texel(slices, slice).x));
}
