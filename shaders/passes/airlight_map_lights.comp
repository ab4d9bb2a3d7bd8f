#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "value.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "lit.glsl"
#include "octahedral.glsl"
#include "attenuation.glsl"
#include "grid_settings.glsl"
#include "airlight_step.glsl"
#include "grid_lights.glsl"

uniform Medium brume_medium;
uniform Camera brume_camera;
uniform GridSettings grid;
uniform ivec2 light_range;
uniform sampler2D attenuation;
uniform sampler2D attenuation_frames;
uniform sampler2D lights;
uniform sampler2D slices;
uniform sampler2D grid_density;
writeonly uniform image2D result;

void main()
{
    ivec2 corner = ivec2(gl_GlobalInvocationID.xy);
    if (corner.x >= brume_grid.x || corner.y >= brume_grid.y)
        return;
    vec3 direction = grid_direction(brume_camera, grid, vec2(corner));
    if (grid.summed == 0) {
        for (int k = 0; k <= grid.slices; ++k)
            imageStore(result, grid_corner(grid, k) + corner,
                       grid_depths(grid, attenuation, attenuation_frames, lights, light_range.x, light_range.y, direction,
                                   data_texel(slices, k).x));
        return;
    }
    float from = 0.0;
    float before = 0.0;
    for (int k = 0; k < grid.slices; ++k) {
        float to = data_texel(slices, k + 1).x;
        float behind = texelFetch(grid_density, grid_corner(grid, k + 1) + corner, 0).x +
                       density_integral(brume_medium, direction, to);
        GridSum sum = GridSum(vec3(0.0), 0.0);
        for (int i = light_range.x; i < light_range.y; ++i) {
            Light light = light_at(lights, i);
            AttenuationFrame frame = attenuation_frame(attenuation_frames, i);
            Aspect aspect = aspect_to(light, direction);
            bool is_smooth = smooth_across(brume_medium, brume_camera, grid, light, aspect, direction, from, to);
            vec3 sent = vec3(0.0);
            if (is_smooth) {
                int index = i - grid.mapped;
                float density_a = attenuation_density(frame, attenuation, grid.side, grid.nodes, index, light, from * direction);
                float density_b = attenuation_density(frame, attenuation, grid.side, grid.nodes, index, light, to * direction);
                float mass = max(behind - before, 0.0);
                sent = light_of_step(brume_medium, grid, light, aspect, direction, from, to, mass, density_a, density_b);
            }
            sum = with_light(sum, i - light_range.x, sent, is_smooth);
        }
        imageStore(result, grid_corner(grid, k) + corner, grid_sum(sum));
        from = to;
        before = behind;
    }
}
