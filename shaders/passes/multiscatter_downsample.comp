// TAPS, BLURRING, SEPARATION are set by the plan.
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

uniform Medium brume_medium;
uniform Filter multiscatter;
uniform int level;
uniform ivec2 finer_size;
uniform ivec2 rows;  // first rows of the finer level and of this one in their images
uniform int spread_channel;
uniform sampler2D finer_radiance;
uniform sampler2D finer_spread;
uniform sampler2D finer_separated;
writeonly uniform image2D radiance;
writeonly uniform image2D spread;
writeonly uniform image2D separated;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    ivec2 to = ivec2(p.x, p.y + rows.y);
    imageStore(radiance, to,
               downsampled_radiance(finer_radiance, finer_size, rows.x, p, level, TAPS, multiscatter.masking, multiscatter,
                                    brume_medium.luminance));
#if BLURRING
    imageStore(spread, to,
               vec4(downsampled_spread(finer_spread, finer_size, rows.x, p, TAPS, spread_channel), 0.0, 0.0, 1.0));
#endif
#if SEPARATION
    imageStore(separated, to,
               downsampled_radiance(finer_separated, finer_size, rows.x, p, level, TAPS, 0, multiscatter,
                                    brume_medium.luminance));
#endif
}
