#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "value.glsl"
#include "erf.glsl"
#include "gaussian.glsl"
#include "noise.glsl"
#include "tiles.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "shadow.glsl"
#include "attenuation.glsl"
#include "grid_settings.glsl"
#include "airlight_map.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform GridSettings grid;
uniform sampler2D light_gaussians;
uniform sampler2D attenuation_frames;
uniform sampler2D lights;
writeonly uniform image2D result;

// Of a ray's nodes so many at once: the Gaussians are looked at anew for the next.
const int together = 8;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    int index = grid.mapped + p.y / grid.side;
    Light light = light_at(lights, index);
    AttenuationFrame frame = attenuation_frame(attenuation_frames, index);
    AttenuationRay ray =
        attenuation_ray(brume_camera, frame, light, light_gaussians, index, grid.side, ivec2(p.x, p.y % grid.side));
    for (int k = 0; k < grid.nodes; k += together) {
        float distance[together];
        float sum[together];
        for (int j = 0; j < together; ++j) {
            distance[j] = attenuation_distance(frame, grid.nodes, min(k + j, grid.nodes - 1));
            sum[j] = 0.0;
        }
        for (int i = 0; i < ray.count; ++i) {
            Gaussian g = listed_gaussian(light_gaussians, ray.first, i);
            Profile q = attenuation_profile(ray, light, g);
            if (passed_by(brume_medium, g, q) || q.scale * (q.middle - distance[together - 1]) > 4.0)
                continue;
            float before = erf(max(q.scale * (ray.start - q.middle), -gaussian_limit));
            float depth = 0.886226925453 * profile_length(q);
            for (int j = 0; j < together; ++j)
                sum[j] += column_part(depth, q.scale, q.middle, before, distance[j]);
        }
        for (int j = 0; j < together; ++j)
            if (k + j < grid.nodes)
                imageStore(result, ivec2((k + j) * grid.side + p.x, p.y), vec4(clamp(sum[j], 0.0, density_limit), 0.0, 0.0, 1.0));
    }
}
