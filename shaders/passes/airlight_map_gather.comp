// ESTIMATE, whether the error is wanted, and ORDERS, whether orders beyond the first are gathered here, are set by the plan.
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
#include "airlight_parts.glsl"
#include "lamp_field.glsl"
#include "airlight_orders.glsl"
#include "environment.glsl"
#include "attenuation.glsl"
#include "grid_settings.glsl"
#include "grid_fetch.glsl"
#include "airlight_step.glsl"
#include "grid_lights.glsl"
#include "airlight_mapped.glsl"
#include "airlight_grid.glsl"
#include "airlight_grid_pixel.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform GridSettings grid;
uniform AirlightSettings airlight;
uniform ivec2 light_range;
uniform int reduction;
uniform sampler2D depth;
uniform sampler2D gaussian_density;
uniform sampler2D slices;
uniform sampler2D grid_density;
uniform sampler2D grid_lights;
uniform sampler2D attenuation;
uniform sampler2D attenuation_frames;
uniform sampler2D lights;
uniform sampler2D environment;
uniform sampler2D environment_table;
uniform sampler2D surroundings;
uniform sampler2D light_shadows;
uniform sampler2D shadow_maps;
uniform sampler2D previous;
uniform sampler2D previous_error;
writeonly uniform image2D radiance;
writeonly uniform image2D error;
writeonly uniform image2D distances;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    ivec2 pixel = representative(p, reduction, grid.size);
    AirlightSettings settings = airlight;
    if (ORDERS == 0)
        settings.orders = orders_single;
    Airlight a = mapped_airlight(ESTIMATE, brume_medium, brume_camera, grid, settings, MAPPED_PIXEL_PASSED, pixel, light_range);
    imageStore(radiance, p, vec4(min(a.radiance + texelFetch(previous, p, 0).rgb, vec3(radiance_limit)), 1.0));
    imageStore(error, p, vec4(min(a.error + texelFetch(previous_error, p, 0).rgb, vec3(radiance_limit)), 1.0));
    Ray ray = pixel_ray(brume_camera, vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
    imageStore(distances, p, vec4(ray.distance, 0.0, 0.0, 1.0));
}
