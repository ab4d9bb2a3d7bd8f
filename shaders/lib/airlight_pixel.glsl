// One pixel's airlight in the tier that the plan chose: the body of the effect's gathering pass. Needs tiers.glsl,
// upsample.glsl, environment.glsl and the tiers' files.

#define AIRLIGHT_PIXEL_IMAGES sampler2D depth, sampler2D gaussian_density, sampler2D tiles, AIRLIGHT_IMAGES
#define AIRLIGHT_PIXEL_PASSED depth, gaussian_density, tiles, AIRLIGHT_PASSED

PURE Airlight airlight_at(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_PIXEL_IMAGES,
                          ivec2 pixel, ivec2 size, ivec2 light_range)
{
    Ray ray = pixel_ray(camera, vec2(pixel) + R(0.5), texelFetch(depth, pixel, 0).x);
    if (ray.keep)
        return Airlight(vec3(R(0.0)), vec3(R(0.0)));
    ivec2 range = settings.gaussian_count > 0 ? tile_range(tiles, size.x, pixel) : ivec2(0);
    Sight sight = Sight(ray.direction, ray.distance, range.x, range.y);
    return airlight_by_nodes(medium, camera, settings, AIRLIGHT_PASSED, sight, light_range.x, light_range.y);
}
