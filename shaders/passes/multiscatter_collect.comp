#include "scene.glsl"
#include "ray.glsl"
#include "data.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "spread.glsl"
#include "pyramid.glsl"
#include "fetch.glsl"
#include "pixel.glsl"
#include "corners.glsl"
#include "upsample.glsl"
#include "calibrated.glsl"

uniform Medium brume_medium;
uniform Calibrated calibrated;
uniform int reduction;
uniform ivec2 image_size;
uniform sampler2D density;
uniform sampler2D table;
uniform sampler2D radiance_stack;
uniform sampler2D coverage_stack;
writeonly uniform image2D radiance;
writeonly uniform image2D coverage;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    ivec2 at = representative(p, reduction, image_size);
    vec2 texel = texelFetch(density, at, 0).rg;
    Collected c = collected(brume_medium, calibrated, table, radiance_stack, coverage_stack,
                            Pyramid(brume_grid, calibrated.top), (vec2(at) + 0.5) / float(reduction), texel.x);
    imageStore(radiance, p, vec4(c.radiance, abs(texel.y)));
    imageStore(coverage, p, vec4(c.coverage, 1.0));
}
