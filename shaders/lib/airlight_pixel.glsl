// The bodies of the effect's passes. Needs tiles.glsl, upsample.glsl, environment.glsl and the tiers' files.

#define AIRLIGHT_PIXEL_IMAGES sampler2D depth, sampler2D gaussian_density, sampler2D tiles, AIRLIGHT_IMAGES, \
                              sampler2D environment, sampler2D environment_table, sampler2D lamp_order
#define AIRLIGHT_PIXEL_PASSED depth, gaussian_density, tiles, AIRLIGHT_PASSED, environment, environment_table, lamp_order

// One pixel's airlight of some lights, and of the environment. ordered: lights in each tile's order (lamp_order.glsl); 0: none.
// GLSL passes a constant for the tier: compilers then leave out the others, of which software GL would take seconds to compile.

PURE Airlight airlight_at(int tier, IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_PIXEL_IMAGES,
                          ivec2 pixel, ivec2 size, int ordered, ivec2 light_range)
{
    Ray ray = pixel_ray(camera, vec2(pixel) + R(0.5), texelFetch(depth, pixel, 0).x);
    if (ray.keep)
        return Airlight(vec3(R(0.0)), vec3(R(0.0)));
    ivec2 range = settings.gaussian_count > 0 ? tile_range(tiles, size.x, pixel) : ivec2(0);
    Sight sight = Sight(ray.direction, ray.distance, range.x, range.y);
    int order = ordered > 0 ? ordered * tile_index(size.x, pixel) : -1;
    Airlight a = airlight_of_tier(tier, medium, camera, settings, AIRLIGHT_PASSED, sight, lamp_order, order, light_range.x, light_range.y);
    if (settings.environment_order > 0) {
        float gaussian_part = settings.gaussian_count > 0 ? texelFetch(gaussian_density, pixel, 0).x : R(0.0);
        a.radiance += environment_airlight(medium, camera, environment, environment_table, settings.environment_order,
                                           settings.orders == orders_all ? 1 : 0, ray.direction, density_to(medium, ray, gaussian_part));
    }
    return a;
}
