// The passes of light that has been scattered before on the CPU.
#include <algorithm>

#include "lanes.hpp"
#include "pixels.hpp"
#include "scattered/passes.h"

namespace airlight::scattered {
namespace {

namespace scalar = brume::maths_float;

const Constants &constants_of(const brume_plugin_rows &call)
{
    return *static_cast<const Constants *>(call.constants);
}

// Whether the pixels' own ways differ too much for them to go side by side.
bool needs_pixels(const Constants &constants, const brume_plugin_medium &medium)
{
    const auto &s = constants.settings;
    return s.cell < 2 * float(constants.reduction) ||
           (s.mapped ? constants.grid.cell < 2 * constants.reduction
                     : s.gaussians > 0 && (constants.reduction > 2 || medium.noise[0] > 0));
}

// All orders of the environment.
brume::maths_float::vec3 around_pixel(const brume_plugin_rows &call, const brume::maths_float::Medium &medium,
                                      const brume::maths_float::Camera &camera, scalar::ivec2 pixel)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(call);
    const brume_plugin_pixels *slots = call.slots;
    const Ray ray = pixel_ray(camera, pixel_centre(pixel.x, pixel.y), *at(slots[add::depth], pixel.x, pixel.y));
    if (constants.environment_order == 0 || ray.keep)
        return vec3(0);
    const float gaussians = constants.settings.gaussians > 0 ? *at(slots[add::gaussian_density], pixel.x, pixel.y) : 0.0f;
    return environment_airlight(medium, camera, texture_of(slots[add::environment]),
                                texture_of(slots[add::environment_table]), constants.environment_order, 1, ray.direction,
                                density_to(medium, ray, gaussians));
}

brume_status add_pixels(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(*call);
    const ScatteredSettings &s = constants.settings;
    const Medium medium = medium_of(*call->scene);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture distances = texture_of(slots[add::distances]), scattered = texture_of(slots[add::scattered]),
                  lights = texture_of(slots[add::lights]), gaussians = texture_of(slots[add::gaussians]),
                  tiles = texture_of(slots[add::tiles]), tile_gaussians = texture_of(slots[add::tile_gaussians]),
                  grid_density = texture_of(slots[add::grid_density]);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const ivec2 pixel = representative(ivec2(x, y), constants.reduction, s.size);
        const vec2 centre = pixel_centre(pixel.x, pixel.y);
        const Ray ray = pixel_ray(camera, centre, *at(slots[add::depth], pixel.x, pixel.y));
        vec3 sum(0);
        if (!ray.keep)
            sum =
                scattered_along(medium, camera, s, constants.grid, SCATTERED_PASSED,
                                s.gaussians > 0 ? tile_range(tiles, s.size.x, pixel) : ivec2(0), centre, ray.direction,
                                ray.distance, s.gaussians > 0 ? *at(slots[add::gaussian_density], pixel.x, pixel.y) : 0.0f);
        auto write = [&](add::Slot to, add::Slot before, vec3 value) {
            store(slots[to], x, y, vec4(min(vec3(load(slots[before], x, y)) + value, vec3(radiance_limit)), 1.0f));
        };
        write(add::radiance, add::previous, sum + around_pixel(*call, medium, camera, pixel));
        if (slots[add::error].data)
            write(add::error, add::previous_error, scattered_doubt * sum);
    });
}

#define BRUME_LANES_BODY "scattered/rows.inc"
#include "lanes_bodies.inc"

}  // namespace

brume_status make_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(*call);
    const ScatteredSettings &s = constants.settings;
    const Medium medium = medium_of(*call->scene);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture distances = texture_of(slots[make::distances]), lights = texture_of(slots[make::lights]),
                  surroundings = texture_of(slots[make::surroundings]),
                  light_gaussians = texture_of(slots[make::light_gaussians]);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const ivec2 texel(x, y);
        const int slice = y / s.rows * s.across + x / s.columns;
        if (slice <= s.slices)
            store(slots[make::result], x, y,
                  scattered_texel(medium, camera, s, distances, lights, surroundings, light_gaussians, constants.light_range,
                                  vec2(texel - scattered_corner(s, slice)), slice));
    });
}

brume_rows_function add_rows_of_this_machine()
{
    return BRUME_OF_THIS_MACHINE(add_rows);
}

}  // namespace airlight::scattered
