#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "noise.glsl"
#include "tiles.glsl"
#include "corners.glsl"
#include "upsample.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "shadow.glsl"
#include "value.glsl"
#include "shadow_lit.glsl"
#include "shadow_map.glsl"
#include "surroundings.glsl"
#include "airlight.glsl"
#include "airlight_sun.glsl"
#include "airlight_fogshop.glsl"
#include "airlight_parts.glsl"
#include "lamp_field.glsl"
#include "airlight_orders.glsl"
#include "airlight_cells.glsl"
#include "airlight_nodes.glsl"
#include "airlight_tiers.glsl"
#include "environment.glsl"
#include "airlight_pixel.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform AirlightSettings airlight;
uniform sampler2D gaussians;
uniform sampler2D lights;
uniform sampler2D light_gaussians;
writeonly uniform image2D density;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    int i = p.y * 1024 + p.x;
    if (p.x >= brume_grid.x || i >= airlight.gaussian_count * (1 + airlight.light_count))
        return;
    imageStore(density, p, vec4(blob_density_at(brume_medium, brume_camera, airlight, SHADOW_PASSED, lights, i), 0.0, 0.0, 1.0));
}
