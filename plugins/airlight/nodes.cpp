// Pass `gather` by tier `nodes`: airlight_parts.glsl with the nodes of a panel side by side. They suit lanes better than
// pixels do: there are as many, and how often a pixel halves its panels is its own affair, so that no neighbour waits.
#include <algorithm>

#include "lanes.hpp"
#include "passes.h"
#include "pixels.hpp"

namespace airlight {
namespace {

namespace scalar = brume::maths_float;

struct Pass {
    const Constants &constants;
    const scalar::AirlightSettings &settings;
    scalar::Medium medium;
    scalar::Camera camera;
    scalar::ivec2 light_range;
    scalar::Texture depth, gaussian_density, tiles, gaussians, lights, tile_gaussians, light_gaussians, blob_density,
        sun_table, surroundings, environment, environment_table, light_shadows, shadow_maps, lamp_order;
    bool green_as_red, blue_as_green;

    explicit Pass(const brume_plugin_rows &call)
        : constants(*static_cast<const Constants *>(call.constants)), settings(constants.airlight),
          medium(scalar::medium_of(*call.scene)), camera(scalar::camera_of(*call.scene)), light_range(constants.light_range)
    {
        scalar::Texture *const textures[] = {&depth,         &gaussian_density, &tiles,           &gaussians,
                                             &lights,        &tile_gaussians,   &light_gaussians, &blob_density,
                                             &sun_table,     &surroundings,     &environment,     &environment_table,
                                             &light_shadows, &shadow_maps,      &lamp_order};
        static_assert(gather::depth == 0 && gather::lamp_order + 1 == std::size(textures));
        for (size_t i = 0; i < std::size(textures); ++i)
            *textures[i] = scalar::texture_of(call.slots[i]);
        const scalar::vec3 extinction = medium.scattering + medium.absorption;
        green_as_red = extinction.y == extinction.x;
        blue_as_green = extinction.z == extinction.y;
    }
};

[[gnu::noinline]] float shadow_at(const Pass &pass, int index, const scalar::Light &light, const scalar::vec3 &point)
{
    return scalar::shadow_density(pass.light_gaussians, pass.camera, index, light, point);
}

[[gnu::noinline]] scalar::ShadowRay shadow_of(const Pass &pass, int light, const scalar::Sight &sight, float reach)
{
    return scalar::shadow_ray(pass.camera, pass.light_shadows, pass.shadow_maps, pass.settings.shadowed, light,
                              sight.direction, reach);
}

[[gnu::noinline]] scalar::LitWalk next_part(const Pass &pass, const scalar::ShadowRay &ray, const scalar::LitWalk &walk,
                                            float end)
{
    return scalar::next_lit(pass.shadow_maps, ray, walk, end);
}

[[gnu::noinline]] scalar::Span span_of(const Pass &pass, const scalar::Sight &sight, const scalar::Light &light,
                                       const scalar::Aspect &aspect, int part, const scalar::vec3 &terms,
                                       const scalar::vec2 &lit)
{
    return scalar::span_of(pass.medium, pass.camera, pass.settings, pass.gaussians, pass.tile_gaussians, sight, light,
                           aspect, part, terms, lit);
}

// airlight_at() where the nodes of panels are no matter: many Gaussians.
[[gnu::noinline]] scalar::Airlight dense_at(const Pass &pass, const scalar::Sight &sight)
{
    using namespace brume::maths_float;
    const Texture &gaussians = pass.gaussians, &light_gaussians = pass.light_gaussians, &lights = pass.lights,
                  &tile_gaussians = pass.tile_gaussians, &blob_density = pass.blob_density, &sun_table = pass.sun_table,
                  &surroundings = pass.surroundings, &light_shadows = pass.light_shadows, &shadow_maps = pass.shadow_maps;
    return airlight_by_cells(pass.medium, pass.camera, pass.settings, AIRLIGHT_PASSED, sight, pass.light_range.x,
                             pass.light_range.y);
}

// What airlight_by_nodes() and airlight_at() do after airlight_by_parts().
[[gnu::noinline]] scalar::Airlight finished(const Pass &pass, const scalar::Ray &ray, scalar::ivec2 pixel,
                                            const scalar::Sight &sight, scalar::Airlight total)
{
    using namespace brume::maths_float;
    const AirlightSettings &settings = pass.settings;
    const Texture &gaussians = pass.gaussians, &light_gaussians = pass.light_gaussians, &lights = pass.lights,
                  &tile_gaussians = pass.tile_gaussians, &blob_density = pass.blob_density, &sun_table = pass.sun_table,
                  &surroundings = pass.surroundings, &light_shadows = pass.light_shadows, &shadow_maps = pass.shadow_maps;
    if (settings.orders == orders_all && sight.count <= settings.dense_from) {
        const Airlight again = orders_by_parts(pass.medium, pass.camera, settings, AIRLIGHT_PASSED, sight,
                                               pass.light_range.x, pass.light_range.y, total.radiance);
        total.radiance += again.radiance;
        total.error += again.error;
    }
    total.radiance = min(total.radiance, vec3(radiance_limit));
    total.error = min(total.error + settings.culled * total.radiance, vec3(radiance_limit));
    if (settings.environment_order > 0) {
        const float gaussian_part = settings.gaussian_count > 0 ? texelFetch(pass.gaussian_density, pixel, 0).x : 0.0f;
        total.radiance += environment_airlight(pass.medium, pass.camera, pass.environment, pass.environment_table,
                                               settings.environment_order, settings.orders == orders_all ? 1 : 0,
                                               ray.direction, density_to(pass.medium, ray, gaussian_part));
    }
    return total;
}

template <class Function>
brume_status for_sights(const Pass &pass, const brume_plugin_rows &call, int32_t first, int32_t last, Function by_nodes)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const brume_plugin_pixels &radiance = call.slots[gather::radiance], &error = call.slots[gather::error],
                              &distances = call.slots[gather::distances];
    const ivec2 size = pass.constants.size;
    return for_pixels(call, first, last, [&](int x, int y) {
        const ivec2 pixel = representative(ivec2(x, y), pass.constants.reduction, size);
        const Ray ray = pixel_ray(pass.camera, pixel_centre(pixel.x, pixel.y), texelFetch(pass.depth, pixel, 0).x);
        const int ordered = pass.constants.ordered, order = ordered > 0 ? ordered * tile_index(size.x, pixel) : -1;
        Airlight a{vec3(0), vec3(0)};
        if (!ray.keep) {
            const ivec2 range = pass.settings.gaussian_count > 0 ? tile_range(pass.tiles, size.x, pixel) : ivec2(0);
            const Sight sight{ray.direction, ray.distance, range.x, range.y};
            a = finished(pass, ray, pixel, sight,
                         sight.count <= pass.settings.dense_from ? by_nodes(sight, order) : dense_at(pass, sight));
        }
        store(radiance, x, y, vec4(a.radiance, 1.0f));
        if (error.data)
            store(error, x, y, vec4(a.error, 1.0f));
        if (distances.data)
            *at(distances, x, y) = ray.distance;
    });
}

#define BRUME_LANES_BODY "nodes.inc"
#include "lanes_bodies.inc"

}  // namespace

brume_status gather_nodes_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return BRUME_OF_THIS_MACHINE(gather)(call, first, last);
}

}  // namespace airlight
