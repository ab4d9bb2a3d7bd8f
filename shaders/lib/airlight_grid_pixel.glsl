// The body of the pass that gathers by maps. Needs airlight_grid.glsl, environment.glsl.

#define MAPPED_PIXEL_IMAGES sampler2D depth, sampler2D gaussian_density, GRID_IMAGES, sampler2D environment, \
                            sampler2D environment_table, sampler2D surroundings, SHADOW_MAP_IMAGES
#define MAPPED_PIXEL_PASSED depth, gaussian_density, GRID_PASSED, environment, environment_table, surroundings, SHADOW_MAP_PASSED

// estimate: 1 where the error is wanted.
PURE Airlight mapped_airlight(int estimate, IN(Medium) medium, IN(Camera) camera, IN(GridSettings) s, IN(AirlightSettings) settings,
                              MAPPED_PIXEL_IMAGES, ivec2 pixel, ivec2 light_range)
{
    Ray ray = pixel_ray(camera, vec2(pixel) + R(0.5), texelFetch(depth, pixel, 0).x);
    if (ray.keep)
        return Airlight(vec3(R(0.0)), vec3(R(0.0)));
    vec2 place = (vec2(pixel) + R(0.5)) / float(s.cell);
    Airlight a = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    if (s.summed == 1)
        a.radiance =
            lit_by_sums(medium, camera, s, GRID_PASSED, light_range.x, light_range.y, place, ray.direction, ray.distance);
    else
        a.radiance = lit_by_grid(medium, camera, s, 1, slices, grid_density, grid_lights, lights, MAPPED_PASSED(settings),
                                 light_range.x, light_range.y, place, ray.direction, ray.distance);
    // Not of sums.
    if (estimate == 1) {
        vec3 half_grid = lit_by_grid(medium, camera, s, 2, slices, grid_density, grid_lights, lights, MAPPED_PASSED(settings),
                                     light_range.x, light_range.y, place, ray.direction, ray.distance);
        a.error = R(0.8) * abs(half_grid - a.radiance) + s.doubt * a.radiance;
    }
    if (settings.environment_order > 0)
        a.radiance += environment_airlight(medium, camera, environment, environment_table, settings.environment_order,
                                           settings.orders == orders_all ? 1 : 0, ray.direction,
                                           density_to(medium, ray, texelFetch(gaussian_density, pixel, 0).x));
    return a;
}
