#include "shadow_maps.h"

#include <algorithm>
#include <iterator>

namespace airlight {
namespace {

bool has_shadow(const brume_plugin_light &light)
{
    return light.shadow_kind > 0;
}

}  // namespace

uint32_t shadowed_lights(const brume_plugin_scene &scene)
{
    return uint32_t(std::count_if(scene.lights, scene.lights + scene.light_count, has_shadow));
}

std::string take_shadow_maps(const brume_plugin_frame &frame, State &state)
{
    const brume_plugin_image *given = frame.layers[layer_shadow].of_lights;
    std::fill(std::begin(state.shadow_maps), std::end(state.shadow_maps), ShadowMap{});
    uint32_t slot = 0;
    for (uint32_t l = 0; l < frame.scene->light_count; ++l) {
        const bool wanted = has_shadow(frame.scene->lights[l]), there = given && given[l];
        const std::string light = "inputs: layer shadow of light " + std::to_string(l);
        if (there && !wanted)
            return light + " is given; expected shadow_kind of the light to say where it looks";
        if (wanted && !there)
            return light + " is missing; expected one for each light that has a shadow_kind";
        if (!wanted)
            continue;
        if (slot == most_shadow_maps)
            return light + " is one more than there may be; expected at most " + std::to_string(most_shadow_maps);
        state.shadow_maps[slot++] = {int32_t(l), given[l]};
    }
    return {};
}

}  // namespace airlight
