// LAYERED (each colour has a density of its own) is set by the plan.
#include "scene.glsl"
#include "ray.glsl"
#include "data.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "spread.glsl"
#include "pyramid.glsl"
#include "fetch.glsl"
#include "pixel.glsl"
#include "beside_lights.glsl"
#include "corners.glsl"
#include "upsample.glsl"
#include "calibrated.glsl"
#include "calibrated_levels.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform Calibrated calibrated;
uniform int reduction;
uniform ivec2 image_size;
uniform sampler2D color;
uniform sampler2D density;
#if LAYERED
uniform sampler2D density_rgb;
#endif
uniform sampler2D lights;
uniform sampler2D table;
writeonly uniform image2D radiance;
writeonly uniform image2D coverage;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    Square square = square_of(brume_medium, color, density, p, reduction, image_size);
    ivec2 at = square.brightest;
    vec2 centre = vec2(at) + 0.5;
    vec2 texel = texelFetch(density, at, 0).rg;
#if LAYERED
    Pixel pixel = pixel_in_layer(brume_medium, brume_camera, texel, texelFetch(density_rgb, at, 0).rgb);
#else
    Pixel pixel = pixel_in_medium(brume_medium, brume_camera, texel);
#endif
    Spreading s = spreading_source(brume_medium, calibrated, table, pixel.density, pixel.share, square.color,
                                   shown_share(lights, calibrated.lights, calibrated.all_orders, brume_medium, brume_camera, centre, pixel));
    imageStore(radiance, p, square.share * s.radiance);
    imageStore(coverage, p, vec4(square.share * s.coverage, 1.0));
}
