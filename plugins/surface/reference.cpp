// Method `reference`: what the medium scatters once of each lamp's light, with its own phase function, by quadrature in
// double over all directions for each pixel, on the CPU.
#include <cmath>
#include <vector>

#include "hemisphere.h"
#include "passes.h"
#include "pixels.hpp"

namespace surface {

using namespace brume::maths_double;
using brume_pixels::at;
using brume_pixels::store;

namespace {

constexpr double tolerance = 1e-5;

vec3 wide(const brume_plugin_pixels &p, int x, int y)
{
    const float *v = at(p, x, y);
    return vec3(v[0], v[1], v[2]);
}

// What each block of rows converts again is nothing beside what it integrates.
struct World {
    World(const brume_plugin_rows &call)
        : medium(medium_of(*call.scene)), camera(camera_of(*call.scene)),
          around(static_cast<const Constants *>(call.constants)->settings)
    {
        for (const brume_plugin_gaussian &g : brume::gaussians_in(*call.scene))
            gaussians.push_back(gaussian_of(g));
        const Data data = lights_of(*call.scene);
        for (int i = 0; i < around.light_count; ++i)
            lights.push_back(light_at(data.texture(), i));
    }

    Surface surface_of_pixel(const brume_plugin_rows &call, int x, int y) const
    {
        const vec3 normal = wide(call.slots[shared::normals], x, y);
        return surface_at(pixel_ray(camera, vec2(x, y) + 0.5, *at(call.slots[shared::depth], x, y)),
                          around.world_normals ? in_camera(camera, normal) : normal);
    }
    Material material_of_pixel(const brume_plugin_rows &call, int x, int y) const
    {
        if (around.material == 0)
            return unknown_material();
        const bool glossy = around.material > 1;
        return material_of(around.material, wide(call.slots[shared::albedo], x, y),
                           glossy ? wide(call.slots[shared::specular], x, y) : vec3(0),
                           glossy ? *at(call.slots[shared::roughness], x, y) : 1);
    }

    Medium medium;
    Camera camera;
    brume::maths_float::SurfaceSettings around;
    std::vector<Gaussian> gaussians;
    std::vector<Light> lights;
};

// What change_by_light() and becomes() are of the other methods.
vec3 lit_by_quadrature(const World &world, const Surface &surface, Light lamp, const Material &material, vec3 own)
{
    const vec3 way = lamp.position - surface.point;
    const double distance = glm::length(way);
    if (lamp.type == light_directional || !(distance > smallest_light))
        return own;
    const vec3 to_lamp = way / distance, up = surface.normal == vec3(0) ? to_lamp : surface.normal;
    brume::airlight::ReferenceScene seen;
    seen.medium = world.medium;
    // Noise is of view rays.
    seen.medium.noise = vec4(0);
    for (int i = 0; i < seen.medium.term_count; ++i)
        seen.medium.terms[i] = moved_term(seen.medium.terms[i], surface.point);
    double p = terms_to_light(world.medium, lamp, surface.point);
    std::vector<Gaussian> gaussians = world.gaussians;
    for (Gaussian &g : gaussians) {
        p += profile_depth(profile_along(g, surface.point, to_lamp), 0.0, distance);
        g.center -= surface.point;
    }
    const vec3 kept = glm::exp(-(world.medium.scattering + world.medium.absorption) * std::clamp(p, 0.0, density_limit));
    lamp.position = way;
    seen.gaussians = gaussians;
    seen.lights = {&lamp, 1};
    const int fine = gaussians.empty() && seen.medium.term_count == 0 ? 2 : 1;
    const vec3 diffuse =
        finite_or_zero(surface_reference::reflected_once(seen, surface_reference::lambert(up), fine, tolerance));
    vec3 sum = own * kept;
    if (!material.known) {
        const double cosine = std::max(glm::dot(up, to_lamp), least_cosine), strength = fluence(distance, lamp.radius);
        sum +=
            own * glm::min(pi * diffuse / glm::max(strength * cosine * lamp.intensity, vec3(1e-30)), vec3(radiance_limit));
    } else {
        sum += material.albedo * diffuse;
        const Shine shine = shine_of(surface, material);
        if (shine.gloss != vec3(0) && surface.normal != vec3(0))
            sum += shine.gloss * finite_or_zero(surface_reference::reflected_once(
                                     seen, surface_reference::phong(shine.mirrored, material.exponent), fine, tolerance));
    }
    return glm::min(sum, vec3(radiance_limit));
}

// The picture is reduced by the lights' own layers that the pass is given.
Divided divided(const World &world, const brume_plugin_rows &call, const Surface &surface, const Material &material, int x,
                int y)
{
    const Constants &constants = *static_cast<const Constants *>(call.constants);
    const brume_plugin_pixels *slots = call.slots;
    Divided pixel{wide(slots[shared::rest], x, y), constants.first ? vec3(0) : wide(slots[shared::lit], x, y)};
    for (int g = 0; g < constants.groups; ++g) {
        const vec3 own = finite_or_zero(wide(slots[shared::group_0 + g], x, y));
        vec3 becomes = own;
        if (surface.seen)
            becomes = lit_by_quadrature(world, surface, world.lights[size_t(constants.of_lights[g])], material, own);
        pixel = {pixel.rest - own, glm::min(pixel.lit + becomes, vec3(radiance_limit))};
    }
    return pixel;
}

}  // namespace

brume_status group_reference_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const World world(*call);
    const brume_plugin_pixels *slots = call->slots;
    return brume_pixels::for_pixels(*call, first, last, [&](int x, int y) {
        const Divided after =
            divided(world, *call, world.surface_of_pixel(*call, x, y), world.material_of_pixel(*call, x, y), x, y);
        store(slots[group::rest_out], x, y, {vec3(after.rest), 1.0f});
        store(slots[group::lit_out], x, y, {vec3(after.lit), 1.0f});
    });
}

brume_status compose_reference_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    namespace narrow = brume::maths_float;
    const World world(*call);
    const narrow::Camera camera = narrow::camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const narrow::Texture light_shadows = narrow::texture_of(slots[compose::light_shadows]),
                          shadow_maps = narrow::texture_of(slots[compose::shadow_maps]);
    const brume_plugin_pixels &sky_pixels = slots[compose::environment], &ungrouped = slots[shared::ungrouped];
    const Data environment =
        world.around.environment_order > 0
            ? Data(sky_pixels.data, size_t(sky_pixels.width) * size_t(sky_pixels.height), sky_pixels.channels)
            : Data(nullptr, 0, 4);
    return brume_pixels::for_pixels(*call, first, last, [&](int x, int y) {
        const brume_pixels::vec4 source = brume_pixels::load(slots[compose::color], x, y);
        const Surface surface = world.surface_of_pixel(*call, x, y);
        vec3 shown(source);
        if (surface.seen) {
            const Material material = world.material_of_pixel(*call, x, y);
            const Divided pixel = divided(world, *call, surface, material, x, y);
            const vec3 rest = finite_or_zero(pixel.rest);
            vec3 all(0), sum = rest;
            auto irradiance = [&](size_t l) {
                const narrow::Surface point{true, narrow::vec3(surface.point), narrow::vec3(surface.normal)};
                return double(narrow::lit_by_map(camera, world.around.shadowed, SHADOW_MAP_PASSED, point, int(l))) *
                       clear_irradiance(surface, world.lights[l]);
            };
            auto shares = [&](size_t l) { return at(ungrouped, int(l % 1024), int(l / 1024))[0] == part_ungrouped; };
            for (size_t l = 0; l < world.lights.size(); ++l)
                if (shares(l))
                    all += irradiance(l);
            if (world.around.environment_order > 0)
                all += environment_irradiance(environment.texture(), world.around.environment_order,
                                              in_world(world.camera, surface.normal));
            for (size_t l = 0; l < world.lights.size(); ++l) {
                if (!shares(l))
                    continue;
                const vec3 own = rest * (irradiance(l) / glm::max(all, vec3(1e-30)));
                if (own != vec3(0) || material.known)
                    sum += lit_by_quadrature(world, surface, world.lights[l], material, own) - own;
            }
            sum = glm::max(sum, glm::min(rest, vec3(0)));
            sum += pixel.lit;
            for (int c = 0; c < 3; ++c)
                shown[c] = composed(source[c], 0, sum[c], call->scene->output_limit);
        }
        store(slots[compose::result], x, y, {shown, source.w});
        if (slots[compose::surface_out].data)
            store(slots[compose::surface_out], x, y, {shown, 1.0f});
    });
}

}  // namespace surface
