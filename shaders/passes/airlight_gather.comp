// TIER, SHADOWED, whether some light may have a map, and ORDERS, whether orders beyond the first are gathered here, are set by the plan.
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
uniform ivec2 size;  // of the full images
uniform int reduction;
uniform ivec2 light_range;
uniform int ordered;
uniform sampler2D depth;
uniform sampler2D gaussian_density;
uniform sampler2D tiles;
uniform sampler2D gaussians;
uniform sampler2D lights;
uniform sampler2D tile_gaussians;
uniform sampler2D light_gaussians;
uniform sampler2D blob_density;
uniform sampler2D sun_table;
uniform sampler2D surroundings;
uniform sampler2D environment;
uniform sampler2D environment_table;
uniform sampler2D light_shadows;
uniform sampler2D shadow_maps;
uniform sampler2D lamp_order;
writeonly uniform image2D radiance;
writeonly uniform image2D error;
writeonly uniform image2D distances;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    ivec2 pixel = representative(p, reduction, size);
    AirlightSettings settings = airlight;
    if (SHADOWED == 0)
        settings.shadowed = 0;
    if (ORDERS == 0)
        settings.orders = orders_single;
    Airlight a = airlight_at(TIER, brume_medium, brume_camera, settings, AIRLIGHT_PIXEL_PASSED, pixel, size,
                             ordered, light_range);
    imageStore(radiance, p, vec4(a.radiance, 1.0));
    imageStore(error, p, vec4(a.error, 1.0));
    Ray ray = pixel_ray(brume_camera, vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
    imageStore(distances, p, vec4(ray.distance, 0.0, 0.0, 1.0));
}
