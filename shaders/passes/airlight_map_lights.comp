#include "scene.glsl"
#include "ray.glsl"
#include "density.glsl"
#include "radiance.glsl"
#include "data.glsl"
#include "value.glsl"
#include "phase.glsl"
#include "light.glsl"
#include "light_cone.glsl"
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
uniform int whole;
uniform sampler2D attenuation;
uniform sampler2D attenuation_frames;
uniform sampler2D lights;
uniform sampler2D slices;
uniform sampler2D grid_density;
uniform sampler2D depth;
writeonly uniform image2D result;

// How far pixels see in the cells around a corner.
float reach_around(ivec2 corner)
{
    ivec2 first = max((corner - 1) * grid.cell, ivec2(0));
    ivec2 end = min((corner + 1) * grid.cell, grid.size);
    float reach = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            Ray ray = pixel_ray(brume_camera, vec2(x, y) + 0.5, texelFetch(depth, ivec2(x, y), 0).x);
            reach = max(reach, ray.keep ? 0.0 : ray.distance);
        }
    return reach;
}

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
    float reach = whole != 0 ? far_away : reach_around(corner);
    float first = 0.0;
    float from = 0.0;
    float before = 0.0;
    // One step more than rays go: the part that they end in is read from those around it.
    for (int k = 0; k < grid.slices && (k == 0 || first < reach); ++k) {
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
        first = from;
        from = to;
        before = behind;
    }
}
