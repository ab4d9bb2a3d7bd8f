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
uniform sampler2D depth;
uniform sampler2D gaussian_density;
uniform sampler2D lights;
writeonly uniform image2D radiance;
writeonly uniform image2D separated;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    Pixel pixel = placed_pixel(brume_medium, brume_camera, multiscatter, vec2(p) + 0.5, texelFetch(depth, p, 0).r,
                               texelFetch(gaussian_density, p, 0).rg);
    pixel.share = share_beside_lights(lights, multiscatter.lights, brume_medium, brume_camera, vec2(p) + 0.5,
                                      texelFetch(depth, p, 0).r, pixel);
    Sources s = scattered_sources(brume_medium, multiscatter, pixel, texelFetch(color, p, 0).rgb);
    imageStore(radiance, p, s.spread);
    if (multiscatter.separation != 0)
        imageStore(separated, p, s.separated);
}
