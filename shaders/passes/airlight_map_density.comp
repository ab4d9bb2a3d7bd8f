#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "value.glsl"
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
#include "attenuation.glsl"
#include "grid_settings.glsl"
#include "airlight_map.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform GridSettings grid;
uniform sampler2D gaussians;
uniform sampler2D tiles;
uniform sampler2D tile_gaussians;
uniform sampler2D slices;
writeonly uniform image2D result;

// Of a corner's slices so many at once: the Gaussians are looked at anew for the next.
const int together = 8;

void main()
{
    ivec2 corner = ivec2(gl_GlobalInvocationID.xy);
    if (corner.x >= brume_grid.x || corner.y >= brume_grid.y)
        return;
    vec3 direction = grid_direction(brume_camera, grid, vec2(corner));
    ivec2 range = grid_tile(tiles, grid, corner);
    for (int k = 0; k <= grid.slices; k += together) {
        float distance[together];
        vec4 sum[together];
        for (int j = 0; j < together; ++j) {
            distance[j] = data_texel(slices, min(k + j, grid.slices)).x;
            sum[j] = vec4(0.0);
        }
        for (int i = 0; i < range.y; ++i) {
            Gaussian g = gaussian_at(gaussians, int(data_texel(tile_gaussians, range.x + i).x));
            Profile p = grid_profile(brume_medium, brume_camera, g, grid.cell, direction);
            if (passed_by(brume_medium, g, p) || p.scale * (p.middle - distance[together - 1]) > 4.0)
                continue;
            float before = erf(-p.scale * p.middle);
            float depth = 0.886226925453 * profile_length(p);
            for (int j = 0; j < together; ++j) {
                float part = column_part(depth, p.scale, p.middle, before, distance[j]);
                sum[j] += part * vec4(1.0, g.color);
            }
        }
        for (int j = 0; j < together; ++j)
            if (k + j <= grid.slices)
                imageStore(result, grid_corner(grid, k + j) + corner, min(sum[j], vec4(density_limit)));
    }
}
