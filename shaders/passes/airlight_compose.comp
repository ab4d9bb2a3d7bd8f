// LIT, ATTENUATES, REDUCTION and OUTPUTS (BRUME_OUTPUT_... flags) are set by the plan.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "corners.glsl"
#include "upsample.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform float brume_output_limit;
uniform int outputs;  // those of this frame
uniform sampler2D color;
uniform sampler2D depth;
uniform sampler2D gaussian_density;
uniform sampler2D radiance;
uniform sampler2D error;
uniform sampler2D distances;
writeonly uniform image2D result;
#if OUTPUTS != 0
writeonly uniform image2D transmittance_out;
writeonly uniform image2D optical_depth_out;
writeonly uniform image2D airlight_out;
writeonly uniform image2D airlight_error_out;
#endif

#if REDUCTION > 1
#define AT_PIXEL(image) upsampled(image, distances, REDUCTION, brume_grid, p, ray.distance).rgb
#else
#define AT_PIXEL(image) texelFetch(image, p, 0).rgb
#endif

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec4 source = texelFetch(color, p, 0);
    Ray ray = pixel_ray(brume_camera, vec2(p) + 0.5, texelFetch(depth, p, 0).r);
    float density = density_to(brume_medium, ray, texelFetch(gaussian_density, p, 0).r);
    vec3 t = shares_of(brume_medium, density).straight;  // as other effects have it, bit for bit
    vec3 added = vec3(0.0);
    vec3 airlight = vec3(0.0);
#if LIT
    airlight = ray.keep ? vec3(0.0) : AT_PIXEL(radiance);
    added += airlight;
#endif
#if ATTENUATES
    added += emitted(brume_medium, density);
    imageStore(result, p, vec4(compose_radiance(source.rgb, t, added, brume_output_limit), source.a));
#else
    imageStore(result, p, vec4(compose_radiance(source.rgb, vec3(1.0), added, brume_output_limit), source.a));
#endif
#if OUTPUTS != 0
    if ((outputs & 1) != 0)
        imageStore(transmittance_out, p, vec4(t, 1.0));
    if ((outputs & 2) != 0)
        imageStore(optical_depth_out, p, vec4(optical_depth(brume_medium, density), 1.0));
    if ((outputs & 16) != 0)
        imageStore(airlight_out, p, vec4(airlight, 1.0));
#if LIT
    if ((outputs & 32) != 0)
        imageStore(airlight_error_out, p, vec4(ray.keep ? vec3(0.0) : AT_PIXEL(error), 1.0));
#endif
#endif
}
