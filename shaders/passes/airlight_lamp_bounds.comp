// What each light sends to each tile of the screen at most.
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

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform AirlightSettings airlight;
uniform ivec2 size;  // of the full images
uniform int ordered;
uniform sampler2D depth;
uniform sampler2D tiles;
uniform sampler2D lights;
writeonly uniform image2D bounds;

void main()
{
    ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
    if (tile.x >= brume_grid.x || tile.y >= brume_grid.y)
        return;
    ivec2 pixel = tile_size * tile;
    TileRays rays = tile_rays(brume_camera, depth, pixel, size);
    float reach = min(tile_reach(brume_medium, rays), rays.distance);
    bool bounded = airlight.gaussian_count == 0 || tile_range(tiles, size.x, pixel).y == 0;
    int first = ordered * tile_index(size.x, pixel);
    for (int l = 0; l < ordered; ++l) {
        float bound = radiance_limit;
        if (bounded) {
            Light light = light_at(lights, l);
            LampSight lamp = lamp_sight(brume_medium, rays, light);
            float sum = 0.0;
            for (int i = 0; i < tile_pieces; ++i)
                sum += most_of_piece(brume_medium, light, lamp,
                                     ray_piece(brume_medium, rays, piece_end(rays, reach, i), piece_end(rays, reach, i + 1)));
            bound = lamp_bound(brume_medium, light, sum);
        }
        imageStore(bounds, ivec2((first + l) & 1023, (first + l) >> 10), vec4(bound, 0.0, 0.0, 1.0));
    }
}
