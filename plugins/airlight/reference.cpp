// Tier `reference`: adaptive quadrature in double along each pixel's ray, on the CPU.
#include <vector>

#include "pixels.hpp"
#include "passes.h"
#include "reference_ray.h"
#include "settings.h"
#include "state.h"

namespace airlight {

using namespace brume::maths_double;
using brume_pixels::at;
using brume_pixels::store;

namespace {

Data copy_of(const brume_plugin_pixels &p)
{
    return p.data ? Data(p.data, size_t(p.width) * size_t(p.height), p.channels) : Data(nullptr, 0, 4);
}

struct WideMap {
    explicit WideMap(const brume_plugin_pixels &p) : values(size_t(p.data ? p.width : 0) * size_t(p.height))
    {
        for (int y = 0; p.data && y < p.height; ++y)
            for (int x = 0; x < p.width; ++x)
                values[size_t(y) * size_t(p.width) + size_t(x)] = *at(p, x, y);
        texture = {values.data(), p.width, p.width, p.height, 1};
    }
    WideMap(const WideMap &) = delete;

    std::vector<double> values;
    Texture texture;
};

}  // namespace

// What each block of rows converts again is nothing beside what it integrates.
brume_status gather_reference_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const Constants &constants = *static_cast<const Constants *>(call->constants);
    const brume_plugin_scene &scene = *call->scene;
    const brume_plugin_pixels *slots = call->slots;
    const brume_plugin_pixels &depth = slots[gather::depth], &gaussian_density = slots[gather::gaussian_density],
                              &error = slots[gather::error], &distances = slots[gather::distances];
    const Camera camera = camera_of(scene);
    std::vector<Gaussian> gaussians;
    for (const brume_plugin_gaussian &g : brume::gaussians_in(scene))
        gaussians.push_back(gaussian_of(g));
    std::vector<Light> lights;
    const Data light_data = lights_of(scene);
    for (uint32_t i = 0; i < scene.light_count; ++i)
        lights.push_back(light_at(light_data.texture(), int(i)));
    const Data environment = copy_of(slots[gather::environment]);
    const Data environment_table = copy_of(slots[gather::environment_table]);
    const Data light_shadows = copy_of(slots[gather::light_shadows]);
    const Texture shadow_texels = light_shadows.texture();
    const WideMap maps(slots[gather::shadow_maps]);
    const int environment_order = constants.airlight.environment_order;
    const brume::maths_float::AirlightSettings &settings = constants.airlight;
    const Data planes = copy_of(slots[gather::surroundings]);
    std::vector<Surroundings> around;
    for (uint32_t i = 0; i < scene.light_count && settings.orders == orders_all; ++i)
        around.push_back(surroundings_of(planes.texture(), int(i)));
    brume::airlight::ReferenceScene seen{medium_of(scene), gaussians, lights, camera, settings.orders, around};
    seen.shadowed = settings.shadowed;
    seen.light_shadows = &shadow_texels;
    seen.shadow_maps = &maps.texture;
    return brume_pixels::for_pixels(*call, first, last, [&](int x, int y) {
        const ivec2 pixel = representative(ivec2(x, y), constants.reduction, constants.size);
        const Ray ray = pixel_ray(camera, vec2(pixel) + 0.5, *at(depth, pixel.x, pixel.y));
        brume::airlight::ReferenceAirlight a;
        if (!ray.keep)
            a = reference_airlight(seen, ray.direction, ray.distance, constants.light_range.x, constants.light_range.y);
        if (!ray.keep && environment_order > 0)
            a.radiance += environment_airlight(
                seen.medium, camera, environment.texture(), environment_table.texture(), environment_order,
                settings.orders == orders_all ? 1 : 0, ray.direction,
                density_to(seen.medium, ray, gaussian_density.data ? *at(gaussian_density, pixel.x, pixel.y) : 0));
        store(slots[gather::radiance], x, y, {a.radiance, 1.0f});
        if (error.data)
            store(error, x, y, {a.error, 1.0f});
        if (distances.data)
            *at(distances, x, y) = float(ray.distance);
    });
}

}  // namespace airlight
