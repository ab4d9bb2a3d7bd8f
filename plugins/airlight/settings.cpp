#include "settings.h"

namespace airlight {

using namespace brume::maths_float;

AirlightSettings settings_of(const State &state, const brume_plugin_scene &scene)
{
    const double e = state.parameters.max_error;
    AirlightSettings s{};
    constexpr int tiers[] = {airlight_nodes, airlight_fogshop, airlight_sun, airlight_reference};
    s.tier = tiers[int(state.parameters.tier)];
    s.environment_order = state.environment_order;
    s.light_count = int(scene.light_count);
    s.gaussian_count = int(scene.gaussian_count);
    s.smooth_nodes = e > 0.05 ? 4 : e > 0.002 ? 8 : 16;
    s.blob_nodes = e > 0.05 ? 2 : e > 0.002 ? 4 : 8;
    s.near_nodes = e > 0.05 ? 4 : e > 0.002 ? 8 : 16;
    s.dense_nodes = e > 0.05 ? 8 : 16;
    s.dense_from = 32;
    s.near_radii = 2;
    return s;
}

}  // namespace airlight
