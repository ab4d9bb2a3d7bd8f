// LIT, ATTENUATES, LAYERED (each colour has its own density), REDUCTION and OUTPUTS are set by the plan. Bits of OUTPUTS:
// 1 transmittance, 2 optical depth, 4 airlight, 8 its error.
#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "corners.glsl"
#include "upsample.glsl"

uniform Medium brume_medium;
uniform float brume_output_limit;
uniform sampler2D color;
uniform sampler2D density;
uniform sampler2D density_rgb;
uniform sampler2D radiance;
uniform sampler2D error;
uniform sampler2D distances;
writeonly uniform image2D result;
#if (OUTPUTS & 1) != 0
writeonly uniform image2D transmittance_out;
#endif
#if (OUTPUTS & 2) != 0
writeonly uniform image2D optical_depth_out;
#endif
#if (OUTPUTS & 4) != 0
writeonly uniform image2D airlight_out;
#endif
#if (OUTPUTS & 8) != 0
writeonly uniform image2D airlight_error_out;
#endif

#if !LIT
#define AT_PIXEL(image) vec3(0.0)
#elif REDUCTION > 1
#define AT_PIXEL(image) (keep ? vec3(0.0) : upsampled(image, distances, REDUCTION, brume_grid, p, abs(along.y)).rgb)
#else
#define AT_PIXEL(image) (keep ? vec3(0.0) : texelFetch(image, p, 0).rgb)
#endif

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec4 source = texelFetch(color, p, 0);
    vec2 along = texelFetch(density, p, 0).xy;
    bool keep = along.y < 0.0;
#if LAYERED
    vec3 sum = texelFetch(density_rgb, p, 0).rgb;
#else
    float sum = along.x;
#endif
    vec3 t = shares_of(brume_medium, sum).straight;  // as other effects have it, bit for bit
    vec3 airlight = AT_PIXEL(radiance);
#if ATTENUATES
    vec3 shown = compose_radiance(source.rgb, t, airlight + emitted(brume_medium, sum), brume_output_limit);
#else
    vec3 shown = compose_radiance(source.rgb, vec3(1.0), airlight, brume_output_limit);
#endif
    imageStore(result, p, vec4(shown, source.a));
#if (OUTPUTS & 1) != 0
    imageStore(transmittance_out, p, vec4(t, 1.0));
#endif
#if (OUTPUTS & 2) != 0
    imageStore(optical_depth_out, p, vec4(optical_depth(brume_medium, sum), 1.0));
#endif
#if (OUTPUTS & 4) != 0
    imageStore(airlight_out, p, vec4(airlight, 1.0));
#endif
#if (OUTPUTS & 8) != 0
    imageStore(airlight_error_out, p, vec4(AT_PIXEL(error), 1.0));
#endif
}
