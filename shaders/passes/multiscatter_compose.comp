// PYRAMID (0 none, 1 kernel paper, 2 kernel calibrated), REDUCTION, LAYERED (each colour has a density of its own), SKY (of kernel
// calibrated: an environment surrounds the image) and OUTPUTS
// (1 transmittance, 2 optical depth, 4 scattered, 8 blur radius) are set by the plan.
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
#include "corners.glsl"
#include "upsample.glsl"
#include "calibrated.glsl"
#include "calibrated_levels.glsl"
#include "sky.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform Filter multiscatter;
#if PYRAMID == 2
uniform Calibrated calibrated;
uniform sampler2D lights;
uniform sampler2D table;
uniform sampler2D coverage_stack;
uniform sampler2D ambient_stack;
uniform sampler2D sky;
uniform sampler2D coverage;
#endif
uniform float brume_output_limit;
uniform sampler2D color;
uniform sampler2D density;
uniform sampler2D density_rgb;
uniform sampler2D gaussian_density;
uniform sampler2D radiance;
uniform sampler2D radiance_stack;
uniform sampler2D spread_stack;
uniform sampler2D separated;
uniform sampler2D separated_stack;
writeonly uniform image2D result;
// Those that a frame does not want are not bound.
writeonly uniform image2D transmittance_out;
writeonly uniform image2D optical_depth_out;
writeonly uniform image2D scattered_out;
writeonly uniform image2D blur_radius_out;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec2 centre = vec2(p) + 0.5;
    vec4 source = texelFetch(color, p, 0);
    vec2 texel = texelFetch(density, p, 0).rg;
#if LAYERED
    vec3 each = texelFetch(density_rgb, p, 0).rgb;
    Pixel pixel = pixel_in_layer(brume_medium, brume_camera, texel, each);
#else
    Pixel pixel = pixel_in_medium(brume_medium, brume_camera, texel);
#endif
#if PYRAMID != 2
    pixel = placed_pixel(pixel, brume_medium, brume_camera, multiscatter, centre, texel, texelFetch(gaussian_density, p, 0).g);
#endif
    vec3 added = pixel.emitted;
#if PYRAMID == 2
    vec3 shown = shown_share(lights, calibrated.lights, calibrated.all_orders, brume_medium, brume_camera, centre, pixel);
    Pyramid pyramid = Pyramid(reduced_size(brume_grid, REDUCTION), calibrated.top);
    vec2 position = centre / float(REDUCTION);
#if REDUCTION > 1
    Collected levels = upsampled_collected(calibrated, radiance, coverage, REDUCTION, brume_grid, p, pixel.distance);
#else
    Collected levels =
        collected(brume_medium, calibrated, table, radiance_stack, coverage_stack, pyramid, position, pixel.density);
#endif
#if SKY
    vec3 around = surrounding_sky(calibrated, sky, centre / vec2(brume_grid), pixel.density);
#else
    vec3 around = ambient_radiance(ambient_stack, pyramid, position);
#endif
    added += scattered_light(brume_medium, calibrated, table, pixel.density, pixel.share, source.rgb, shown, around, levels);
#elif PYRAMID == 1
    added += gathered(radiance, radiance_stack, spread_stack, separated, separated_stack,
                      Pyramid(brume_grid, multiscatter.top), multiscatter, centre, pixel.spread);
#else
    added += pixel.share * finite_or_zero(source.rgb);
#endif
    imageStore(result, p, vec4(compose_radiance(source.rgb, pixel.transmittance, added, brume_output_limit), source.a));
#if (OUTPUTS & 1) != 0
    imageStore(transmittance_out, p, vec4(pixel.transmittance, 1.0));
#endif
#if (OUTPUTS & 2) != 0
#if LAYERED
    imageStore(optical_depth_out, p, vec4(optical_depth(brume_medium, each), 1.0));
#else
    imageStore(optical_depth_out, p, vec4(optical_depth(brume_medium, pixel.density), 1.0));
#endif
#endif
#if (OUTPUTS & 4) != 0
    imageStore(scattered_out, p, vec4(added, 1.0));
#endif
#if (OUTPUTS & 8) != 0
    imageStore(blur_radius_out, p, vec4(pixel.spread, 0.0, 0.0, 1.0));
#endif
}
