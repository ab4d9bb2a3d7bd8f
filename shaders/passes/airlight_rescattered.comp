// Adds what arrives scattered before, by its grid.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "noise.glsl"
#include "tiles.glsl"
#include "corners.glsl"
#include "upsample.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
#include "lit.glsl"
#include "grid_settings.glsl"
#include "grid_fetch.glsl"
#include "airlight_scattered.glsl"
#include "environment.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform ScatteredSettings settings;
uniform GridSettings grid;
uniform int reduction;
uniform int environment_order;
uniform sampler2D depth;
uniform sampler2D gaussian_density;
uniform sampler2D tiles;
uniform sampler2D gaussians;
uniform sampler2D tile_gaussians;
uniform sampler2D lights;
uniform sampler2D distances;
uniform sampler2D scattered;
uniform sampler2D grid_density;
uniform sampler2D environment;
uniform sampler2D environment_table;
uniform sampler2D previous;
uniform sampler2D previous_error;
writeonly uniform image2D radiance;
writeonly uniform image2D error;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    ivec2 pixel = representative(p, reduction, settings.size);
    Ray ray = pixel_ray(brume_camera, vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
    float gaussian_part = settings.gaussians > 0 ? texelFetch(gaussian_density, pixel, 0).x : 0.0;
    vec3 sum = vec3(0.0);
    if (!ray.keep)
        sum = scattered_along(brume_medium, brume_camera, settings, grid, SCATTERED_PASSED,
                              settings.gaussians > 0 ? tile_range(tiles, settings.size.x, pixel) : ivec2(0), vec2(pixel) + 0.5,
                              ray.direction, ray.distance, gaussian_part);
    vec3 around = vec3(0.0);
    if (environment_order > 0 && !ray.keep)
        around = environment_airlight(brume_medium, brume_camera, environment, environment_table, environment_order, 1, ray.direction,
                                      density_to(brume_medium, ray, gaussian_part));
    imageStore(radiance, p, vec4(min(texelFetch(previous, p, 0).rgb + sum + around, vec3(radiance_limit)), 1.0));
    imageStore(error, p,
               vec4(min(texelFetch(previous_error, p, 0).rgb + scattered_doubt * sum, vec3(radiance_limit)), 1.0));
}
