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
uniform Level finer;
uniform Level own;
uniform sampler2D table;
uniform sampler2D finer_radiance;
uniform sampler2D finer_coverage;
uniform sampler2D finer_ambient;
writeonly uniform image2D radiance;
writeonly uniform image2D coverage;
writeonly uniform image2D ambient;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    Spreading s = spreading_texel(brume_medium, calibrated, table, finer_radiance, finer_coverage, finer, p, level);
    ivec2 to = ivec2(p.x, p.y + own.row);
    imageStore(radiance, to, s.radiance);
    imageStore(coverage, to, vec4(s.coverage, 1.0));
    imageStore(ambient, to, ambient_texel(calibrated, finer_radiance, finer_coverage, finer_ambient, finer, p, level));
}
