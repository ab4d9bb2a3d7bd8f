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
#include "calibrated_levels.glsl"

uniform Medium brume_medium;
uniform Calibrated calibrated;
uniform int level;
uniform Level own;
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
    ivec2 to = ivec2(p.x, p.y + own.row);
    Spreading s = stayed(brume_medium, calibrated, table, radiance_stack, coverage_stack, own, p, level);
    imageStore(radiance, to, s.radiance);
    imageStore(coverage, to, vec4(s.coverage, 1.0));
}
