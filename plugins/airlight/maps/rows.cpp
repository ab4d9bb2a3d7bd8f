// Method `maps` on the CPU.
#include <algorithm>
#include <vector>

#include "lanes.hpp"
#include "maps/passes.h"
#include "maps/sizes.h"
#include "pixels.hpp"

namespace airlight::maps {

namespace {

namespace scalar = brume::maths_float;
using scalar::ivec2;

const Constants &constants_of(const brume_plugin_rows &call)
{
    return *static_cast<const Constants *>(call.constants);
}

// Whether the pixels' own ways differ too much for them to go side by side.
bool needs_pixels(const Constants &constants)
{
    return constants.estimate || constants.airlight.orders != scalar::orders_single ||
           constants.grid.cell < 2 * constants.reduction;
}

brume_status gather_pixels(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(*call);
    const Medium medium = medium_of(*call->scene);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture depth = texture_of(slots[gather::depth]), gaussian_density = texture_of(slots[gather::gaussian_density]),
                  slices = texture_of(slots[gather::slices]), grid_density = texture_of(slots[gather::grid_density]),
                  grid_lights = texture_of(slots[gather::grid_lights]), attenuation = texture_of(slots[gather::attenuation]),
                  attenuation_frames = texture_of(slots[gather::frames]), lights = texture_of(slots[gather::lights]),
                  environment = texture_of(slots[gather::environment]),
                  environment_table = texture_of(slots[gather::environment_table]),
                  surroundings = texture_of(slots[gather::surroundings]),
                  light_shadows = texture_of(slots[gather::light_shadows]),
                  shadow_maps = texture_of(slots[gather::shadow_maps]);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const ivec2 pixel = representative(ivec2(x, y), constants.reduction, constants.grid.size);
        const Airlight a = mapped_airlight(constants.estimate, medium, camera, constants.grid, constants.airlight,
                                           MAPPED_PIXEL_PASSED, pixel, constants.light_range);
        auto write = [&](gather::Slot to, gather::Slot before, vec3 value) {
            if (slots[before].data)
                value += vec3(load(slots[before], x, y));
            if (slots[to].data)
                store(slots[to], x, y, vec4(min(value, vec3(radiance_limit)), 1.0f));
        };
        write(gather::radiance, gather::previous, a.radiance);
        write(gather::error, gather::previous_error, a.error);
        if (slots[gather::distances].data)
            *at(slots[gather::distances], x, y) =
                pixel_ray(camera, pixel_centre(pixel.x, pixel.y), *at(slots[gather::depth], pixel.x, pixel.y)).distance;
    });
}

// What gather_rows() leaves: the environment, what other lights gave before, the distances.
void add_rest(const brume_plugin_rows &call, int first, int count, int y)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(call);
    const brume_plugin_pixels *slots = call.slots;
    const brume_plugin_pixels &radiance = slots[gather::radiance], &previous = slots[gather::previous],
                              &distances = slots[gather::distances];
    const bool lit = constants.airlight.environment_order > 0;
    if (!previous.data && !distances.data && !lit)
        return;
    const Camera camera = camera_of(*call.scene);
    const Medium medium = medium_of(*call.scene);
    for (int x = first; x < first + count; ++x) {
        vec3 sum = vec3(load(radiance, x, y));
        const ivec2 pixel = representative(ivec2(x, y), constants.reduction, constants.grid.size);
        const Ray ray = pixel_ray(camera, pixel_centre(pixel.x, pixel.y), *at(slots[gather::depth], pixel.x, pixel.y));
        if (lit && !ray.keep) {
            sum += environment_airlight(medium, camera, texture_of(slots[gather::environment]),
                                        texture_of(slots[gather::environment_table]), constants.airlight.environment_order,
                                        constants.airlight.orders == orders_all ? 1 : 0, ray.direction,
                                        density_to(medium, ray, *at(slots[gather::gaussian_density], pixel.x, pixel.y)));
        }
        if (previous.data)
            sum += vec3(load(previous, x, y));
        store(radiance, x, y, vec4(min(sum, vec3(radiance_limit)), 1.0f));
        if (distances.data)
            *at(distances, x, y) = ray.distance;
    }
}

#define BRUME_LANES_BODY "maps/rows.inc"
#include "lanes_bodies.inc"

}  // namespace

const Rows &rows_of_this_machine()
{
    return BRUME_OF_THIS_MACHINE(rows);
}

}  // namespace airlight::maps
