#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "noise.glsl"
#include "tiles.glsl"
#include "tile_density.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform sampler2D depth;
uniform sampler2D gaussians;
uniform sampler2D tiles;
uniform sampler2D tile_gaussians;
writeonly uniform image2D density;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec2 moment = tile_density(brume_medium, brume_camera, gaussians, tiles, tile_gaussians, brume_grid.x, p, texelFetch(depth, p, 0).r);
    imageStore(density, p, vec4(moment, 0.0, 1.0));
}
