// What the effect reads, fills, makes and uses; the enums of state.h count them.
#pragma once
#include <iterator>

#include "state.h"

namespace airlight {

constexpr brume_layer_info layer_filled(const char *name, const char *help, uint32_t flags = 0)
{
    return {sizeof(brume_layer_info), BRUME_LAYER_OUTPUT | flags, 3, 0, name, help};
}

constexpr brume_layer_info layer_table[] = {
    layer_filled("transmittance", "e^-tau of the medium in front of what each pixel shows"),
    layer_filled("optical_depth",
                 "tau of the medium in front of what each pixel shows; up to 1e30 times sigma where it has no end"),
    layer_filled("airlight", "radiance of the lights and the environment scattered once toward the camera"),
    layer_filled("airlight_error", "estimate of the airlight's error"),
    layer_filled("light_airlight", "airlight of one light", BRUME_LAYER_OF_LIGHT),
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT | BRUME_LAYER_OF_LIGHT | BRUME_LAYER_ANY_SIZE, 1, 0, "shadow",
     "depth as seen from the light, where brume_light.shadow_kind says: what stands in its way throws shadows into the "
     "medium"},
};
static_assert(std::size(layer_table) == layer_count);

constexpr const char *made[] = {"attenuated_radiance", "single_scattering", "all_scattering"};
constexpr const char *used[] = {"density", "density_rgb",   "gaussian_density", "gaussians",
                                "lights",  "light_shadows", "light_gaussians",  "camera_gaussians"};
static_assert(std::size(used) == product_count);

}  // namespace airlight
