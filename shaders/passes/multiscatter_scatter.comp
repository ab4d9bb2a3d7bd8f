// LAYERED (each colour has a density of its own) is set by the plan.
#include "scene.glsl"
#include "ray.glsl"
#include "data.glsl"
#include "density.glsl"
#include "moment.glsl"
#include "radiance.glsl"
#include "spread.glsl"
#include "pyramid.glsl"
#include "fetch.glsl"
#include "pixel.glsl"
#include "multiscatter.glsl"
#include "beside_lights.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform Filter multiscatter;
uniform sampler2D color;
uniform sampler2D density;
#if LAYERED
uniform sampler2D density_rgb;
#endif
uniform sampler2D gaussian_density;
uniform sampler2D lights;
writeonly uniform image2D radiance;
writeonly uniform image2D separated;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec2 centre = vec2(p) + 0.5;
    vec2 texel = texelFetch(density, p, 0).rg;
#if LAYERED
    Pixel pixel = pixel_in_layer(brume_medium, brume_camera, texel, texelFetch(density_rgb, p, 0).rgb);
#else
    Pixel pixel = pixel_in_medium(brume_medium, brume_camera, texel);
#endif
    pixel = placed_pixel(pixel, brume_medium, brume_camera, multiscatter, centre, texel, texelFetch(gaussian_density, p, 0).g);
    pixel.share = share_beside_lights(lights, multiscatter.lights, multiscatter.all_orders, brume_medium, brume_camera, centre, pixel);
    Sources s = scattered_sources(brume_medium, multiscatter, pixel, texelFetch(color, p, 0).rgb);
    imageStore(radiance, p, s.spread);
    if (multiscatter.separation != 0)
        imageStore(separated, p, s.separated);
}
