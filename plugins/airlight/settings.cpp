#include "settings.h"

namespace airlight {

using namespace brume::maths_float;

int tier_of(const State &state)
{
    constexpr int tiers[] = {airlight_nodes, airlight_fogshop, airlight_sun, airlight_reference};
    return tiers[int(state.parameters.tier)];
}

AirlightSettings settings_of(const State &state, const brume_plugin_scene &scene)
{
    const double e = state.parameters.max_error;
    AirlightSettings s{};
    s.environment_order = state.environment_order;
    s.light_count = int(scene.light_count);
    s.gaussian_count = int(scene.gaussian_count);
    s.tolerance = float(0.1 * e);
    s.panels = e > 0.05 ? 8 : 32;
    s.dense_from = 24;
    s.cells = e > 0.05 ? 16 : 32;
    s.near_radii = 2;
    return s;
}

}  // namespace airlight
