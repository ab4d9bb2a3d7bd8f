// The passes on the CPU: loops over rows around the functions of shaders/lib/surface.glsl.
#include <algorithm>
#include <cstring>
#include <limits>

#include "lanes.hpp"
#include "passes.h"
#include "pixels.hpp"

namespace surface {

namespace {

namespace scalar = brume::maths_float;
using brume_pixels::at;

const Constants &constants_of(const brume_plugin_rows &call)
{
    return *static_cast<const Constants *>(call.constants);
}

// Whether it takes more than surface_lamp.glsl has to say what a light gives.
bool needs_pixels(const Constants &constants, const brume_plugin_light *first, const brume_plugin_light *last)
{
    return constants.settings.method != scalar::method_calibrated || constants.settings.environment_order > 0 ||
           constants.settings.shadowed ||
           std::any_of(first, last, [](const brume_plugin_light &l) { return int(l.type) == scalar::light_directional; });
}

brume_status group_pixels(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(*call);
    const Medium medium = medium_of(*call->scene);
    const LampColours colours = lamp_colours(medium);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture gaussians = texture_of(slots[group::gaussians]), table = texture_of(slots[group::table]),
                  albedo = texture_of(slots[group::albedo]), specular = texture_of(slots[group::specular]),
                  roughness = texture_of(slots[group::roughness]);
    const Light light = light_at(texture_of(slots[group::lights]), constants.light);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const Surface surface = surface_of(camera, constants.settings, pixel_centre(x, y), *at(slots[group::depth], x, y),
                                           vec3(load(slots[group::normals], x, y)));
        const Divided before{vec3(load(slots[group::rest], x, y)),
                             constants.first ? vec3(0.0f) : vec3(load(slots[group::lit], x, y))};
        const Divided after =
            divided_by_group(medium, colours, constants.settings, surface, light,
                             material_at(constants.settings.material, albedo, specular, roughness, ivec2(x, y)), gaussians,
                             table, before, vec3(load(slots[group::group], x, y)));
        store(slots[group::rest_out], x, y, vec4(after.rest, 1.0f));
        store(slots[group::lit_out], x, y, vec4(after.lit, 1.0f));
    });
}

brume_status transfer_pixels(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(*call);
    const Medium medium = medium_of(*call->scene);
    const LampColours colours = lamp_colours(medium);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture lights = texture_of(slots[transfer::lights]), ungrouped = texture_of(slots[transfer::ungrouped]),
                  gaussians = texture_of(slots[transfer::gaussians]), environment = texture_of(slots[transfer::environment]),
                  in_axes = texture_of(slots[transfer::in_axes]), table = texture_of(slots[transfer::table]);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const Surface surface = surface_of(camera, constants.settings, pixel_centre(x, y), *at(slots[transfer::depth], x, y),
                                           vec3(load(slots[transfer::normals], x, y)));
        Transfer given{};
        for (int i = 0; i < layers_of_transfer(constants.settings.transfer); ++i)
            given.of[i] = i < 5 ? finite_or_zero(vec3(load(slots[transfer::transfer_0 + i], x, y)))
                                : finite_or_zero(vec3(*at(slots[transfer::transfer_5], x, y)));
        const vec3 brought = brought_by_transfer(medium, colours, camera, constants.settings, SURFACE_PASSED, in_axes,
                                                 surface, vec3(load(slots[transfer::albedo], x, y)), given);
        store(slots[transfer::brought], x, y, vec4(brought, 1.0f));
    });
}

brume_status compose_pixels(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume::maths_float;
    using namespace brume_pixels;
    const Constants &constants = constants_of(*call);
    const Medium medium = medium_of(*call->scene);
    const LampColours colours = lamp_colours(medium);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *slots = call->slots;
    const Texture lights = texture_of(slots[compose::lights]), ungrouped = texture_of(slots[compose::ungrouped]),
                  gaussians = texture_of(slots[compose::gaussians]), environment = texture_of(slots[compose::environment]),
                  table = texture_of(slots[compose::table]), albedo = texture_of(slots[compose::albedo]),
                  specular = texture_of(slots[compose::specular]), roughness = texture_of(slots[compose::roughness]),
                  light_shadows = texture_of(slots[compose::light_shadows]),
                  shadow_maps = texture_of(slots[compose::shadow_maps]);
    return for_pixels(*call, first, last, [&](int x, int y) {
        const vec4 source = load(slots[compose::color], x, y);
        const Surface surface = surface_of(camera, constants.settings, pixel_centre(x, y), *at(slots[compose::depth], x, y),
                                           vec3(load(slots[compose::normals], x, y)));
        const Divided divided = constants.first
                                    ? Divided{vec3(source), vec3(0.0f)}
                                    : Divided{vec3(load(slots[compose::rest], x, y)), vec3(load(slots[compose::lit], x, y))};
        const vec3 shown = relit(medium, colours, camera, constants.settings, SURFACE_PASSED, SHADOW_MAP_PASSED, surface,
                                 material_at(constants.settings.material, albedo, specular, roughness, ivec2(x, y)),
                                 vec3(source), divided, call->scene->output_limit);
        store(slots[compose::result], x, y, vec4(shown, source.w));
        if (slots[compose::surface_out].data)
            store(slots[compose::surface_out], x, y, vec4(shown, 1.0f));
    });
}

struct Rows {
    brume_rows_function normals, transfer, group, compose;
};

#define BRUME_LANES_BODY "rows.inc"
#include "lanes_bodies.inc"

}  // namespace

brume_status normals_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    return BRUME_OF_THIS_MACHINE(rows).normals(call, first, last);
}

brume_status transfer_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const brume_plugin_scene &scene = *call->scene;
    if (needs_pixels(constants_of(*call), scene.lights, scene.lights + scene.light_count))
        return transfer_pixels(call, first, last);
    return BRUME_OF_THIS_MACHINE(rows).transfer(call, first, last);
}

brume_status group_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const brume_plugin_light *light = call->scene->lights + constants_of(*call).light;
    if (needs_pixels(constants_of(*call), light, light + 1))
        return group_pixels(call, first, last);
    return BRUME_OF_THIS_MACHINE(rows).group(call, first, last);
}

brume_status compose_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const brume_plugin_scene &scene = *call->scene;
    if (needs_pixels(constants_of(*call), scene.lights, scene.lights + scene.light_count))
        return compose_pixels(call, first, last);
    return BRUME_OF_THIS_MACHINE(rows).compose(call, first, last);
}

}  // namespace surface
