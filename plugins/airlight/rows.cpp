// The passes on the CPU: loops over rows around the functions of shaders/lib/airlight*.glsl.
#include "pixels.hpp"
#include "passes.h"

namespace airlight {

using namespace brume::maths_float;
using namespace brume_pixels;

namespace {

const Constants &constants_of(const brume_plugin_rows &call)
{
    return *static_cast<const Constants *>(call.constants);
}

}  // namespace

brume_status blobs_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const AirlightSettings &settings = constants_of(*call).airlight;
    const Medium medium = medium_of(*call->scene);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture gaussians = texture_of(slots[blobs::gaussians]), lights = texture_of(slots[blobs::lights]),
                  light_gaussians = texture_of(slots[blobs::light_gaussians]);
    const int values = settings.gaussian_count * (1 + settings.light_count);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const int i = y * BRUME_DATA_WIDTH + x;
        if (i < values)
            *at(slots[blobs::density], x, y) = blob_density_at(medium, camera, settings, SHADOW_PASSED, lights, i);
    });
}

brume_status around_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const Constants &constants = constants_of(*call);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture depth = texture_of(slots[around::depth]), lights = texture_of(slots[around::lights]);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const int i = y * BRUME_DATA_WIDTH + x;
        if (i < sides * constants.airlight.light_count)
            store(
                slots[around::surroundings], x, y,
                surroundings_texel(constants.around, camera, depth, constants.size, light_at(lights, i / sides), i % sides));
    });
}

brume_status gather_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const Constants &constants = constants_of(*call);
    const Medium medium = medium_of(*call->scene);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture depth = texture_of(slots[gather::depth]), gaussian_density = texture_of(slots[gather::gaussian_density]),
                  tiles = texture_of(slots[gather::tiles]), gaussians = texture_of(slots[gather::gaussians]),
                  lights = texture_of(slots[gather::lights]), tile_gaussians = texture_of(slots[gather::tile_gaussians]),
                  light_gaussians = texture_of(slots[gather::light_gaussians]),
                  blob_density = texture_of(slots[gather::blob_density]), sun_table = texture_of(slots[gather::sun_table]),
                  surroundings = texture_of(slots[gather::surroundings]),
                  environment = texture_of(slots[gather::environment]),
                  environment_table = texture_of(slots[gather::environment_table]),
                  light_shadows = texture_of(slots[gather::light_shadows]),
                  shadow_maps = texture_of(slots[gather::shadow_maps]), lamp_order = texture_of(slots[gather::lamp_order]);
    const brume_plugin_pixels &error = slots[gather::error], &distances = slots[gather::distances];
    return for_pixels(*call, first, last, [&](int x, int y) {
        const ivec2 pixel = representative(ivec2(x, y), constants.reduction, constants.size);
        const Airlight a = airlight_at(constants.tier, medium, camera, constants.airlight, AIRLIGHT_PIXEL_PASSED, pixel,
                                       constants.size, constants.ordered, constants.light_range);
        store(slots[gather::radiance], x, y, vec4(a.radiance, 1.0f));
        if (error.data)
            store(error, x, y, vec4(a.error, 1.0f));
        if (distances.data)
            *at(distances, x, y) =
                pixel_ray(camera, pixel_centre(pixel.x, pixel.y), *at(slots[gather::depth], pixel.x, pixel.y)).distance;
    });
}

template <bool layered> brume_status compose_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const Constants &constants = constants_of(*call);
    const Medium medium = medium_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture distances = texture_of(slots[compose::distances]);
    const float limit = call->scene->output_limit;
    auto at_pixel = [&](compose::Slot slot, ivec2 pixel, float distance) {
        if (constants.reduction == 1)
            return vec3(load(slots[slot], pixel.x, pixel.y));
        return vec3(upsampled(texture_of(slots[slot]), distances, constants.reduction, constants.size, pixel, distance));
    };
    auto fill = [&](compose::Slot slot, int x, int y, vec3 value) {
        if (slots[slot].data)
            store(slots[slot], x, y, vec4(value, 1.0f));
    };
    auto density_at = [&](int x, int y) {
        if constexpr (layered)
            return vec3(load(slots[compose::density_rgb], x, y));
        else
            return *at(slots[compose::density], x, y);
    };
    return for_pixels(*call, first, last, [&](int x, int y) {
        const vec4 source = load(slots[compose::color], x, y);
        const float along = at(slots[compose::density], x, y)[1], distance = std::abs(along);
        const bool lit = constants.lit && along >= 0;
        const auto density = density_at(x, y);
        const vec3 t = shares_of(medium, density).straight;  // as other effects have it, bit for bit
        const vec3 airlight = lit ? at_pixel(compose::radiance, ivec2(x, y), distance) : vec3(0.0f);
        const vec3 result = constants.attenuates
                                ? compose_radiance(vec3(source), t, airlight + emitted(medium, density), limit)
                                : compose_radiance(vec3(source), vec3(1.0f), airlight, limit);
        store(slots[compose::result], x, y, vec4(result, source.w));
        fill(compose::transmittance_out, x, y, t);
        fill(compose::optical_depth_out, x, y, optical_depth(medium, density));
        fill(compose::airlight_out, x, y, airlight);
        if (slots[compose::airlight_error_out].data)
            fill(compose::airlight_error_out, x, y, lit ? at_pixel(compose::error, ivec2(x, y), distance) : vec3(0.0f));
    });
}

template brume_status compose_rows<false>(const brume_plugin_rows *, int32_t, int32_t);
template brume_status compose_rows<true>(const brume_plugin_rows *, int32_t, int32_t);

}  // namespace airlight
