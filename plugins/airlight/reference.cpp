// Tier `reference`: adaptive quadrature in double along each pixel's ray, on the CPU.
#include "common/pixels.hpp"
#include "passes.h"
#include "reference_ray.h"
#include "settings.h"

namespace airlight {

using namespace brume::maths_double;
using brume_pixels::at;
using brume_pixels::store;

namespace {

Data copy_of(const brume_services &services, brume_host host, brume_plugin_image image)
{
    brume_plugin_pixels p{};
    if (!image || services.pixels(host, image, &p))
        return Data(nullptr, 0, 4);
    return Data(p.data, size_t(p.width) * size_t(p.height), p.channels);
}

}  // namespace

brume_status gather_reference(const brume_services &services, brume_host host, const State &state,
                              const brume_plugin_frame &frame, const Gathering &to)
{
    const brume_plugin_scene &scene = *frame.scene;
    brume_plugin_pixels depth{}, gaussian_density{}, radiance{}, error{}, distances{};
    const std::pair<brume_plugin_image, brume_plugin_pixels *> images[] = {
        {frame.depth, &depth}, {frame.gaussian_density, &gaussian_density}, {to.radiance, &radiance}, {to.error, &error}, {to.distances, &distances}};
    for (auto &[image, pixels] : images)
        if (image)
            if (brume_status s = services.pixels(host, image, pixels))
                return s;
    const Camera camera = camera_of(scene);
    const brume::maths_float::AirlightSettings settings = settings_of(state, scene);
    std::vector<Gaussian> gaussians;
    for (uint32_t i = 0; i < scene.gaussian_count; ++i)
        gaussians.push_back(gaussian_of(scene.gaussians[i]));
    std::vector<Light> lights;
    const Data light_data = lights_of(scene);
    for (uint32_t i = 0; i < scene.light_count; ++i)
        lights.push_back(light_at(light_data.texture(), int(i)));
    const bool lit_around = to.environment && state.environment_order > 0;
    const Data environment = copy_of(services, host, lit_around ? state.environment : nullptr);
    const Data environment_table = copy_of(services, host, lit_around ? state.environment_table : nullptr);
    const brume::airlight::ReferenceScene seen{medium_of(scene), gaussians, lights, camera, settings.orders, vec4(settings.ground)};
    const ivec2 size(state.width, state.height);
    return brume_pixels::for_rows(services, host, "gather", radiance.height, 1, [&](int y) {
        for (int x = 0; x < radiance.width; ++x) {
            const ivec2 pixel = representative(ivec2(x, y), to.reduction, size);
            const Ray ray = pixel_ray(camera, vec2(pixel) + 0.5, *at(depth, pixel.x, pixel.y));
            brume::airlight::ReferenceAirlight a;
            if (!ray.keep)
                a = reference_airlight(seen, ray.direction, ray.distance, to.first_light, to.last_light);
            if (!ray.keep && lit_around)
                a.radiance += environment_airlight(
                    seen.medium, camera, environment.texture(), environment_table.texture(), state.environment_order,
                    ray.direction, density_to(seen.medium, ray, gaussian_density.data ? *at(gaussian_density, pixel.x, pixel.y) : 0));
            store(radiance, x, y, {a.radiance, 1.0f});
            if (error.data)
                store(error, x, y, {a.error, 1.0f});
            if (distances.data)
                *at(distances, x, y) = float(ray.distance);
        }
    });
}

}  // namespace airlight
