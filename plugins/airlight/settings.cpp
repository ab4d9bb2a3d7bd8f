#include "settings.h"

#include "quality.h"

namespace airlight {

using namespace brume::maths_float;

int tier_of(const State &state)
{
    // Of maps, light by light where none scatters: nothing.
    constexpr int tiers[] = {airlight_nodes,     airlight_fogshop, airlight_sun,
                             airlight_reference, airlight_nodes,   airlight_nodes};
    return tiers[int(state.parameters.tier)];
}

AirlightSettings settings_of(const State &state, const brume_plugin_scene &scene)
{
    AirlightSettings s{};
    // Beside the grid its orders are added, too.
    s.environment_order = state.scattered.used ? 0 : state.environment_order;
    s.light_count = int(scene.light_count);
    s.gaussian_count = int(scene.gaussian_count);
    // Of one Gaussian reach_share at most; of all that light a pixel, measured (tests AirlightErrorEstimate).
    s.culled = scene.gaussian_count > 0 ? 0.3f * reach_share : 0.0f;
    brume::airlight::set_quality(s, state.parameters.max_error);
    s.orders = gathers_orders(state) ? orders_all : orders_single;
    s.shadowed = state.shadowed;
    return s;
}

bool gathers_orders(const State &state)
{
    return state.parameters.orders == Orders::all && !state.scattered.used;
}

SurroundingsSettings surroundings_settings(const State &state, const brume_plugin_scene &scene)
{
    const Ground ground = state.parameters.ground;
    if (ground == Ground::none)
        return {surroundings_open, 0, 0};
    if (ground == Ground::automatic)
        return {surroundings_seen, 0, 0};
    const int axis = ground == Ground::y ? 1 : 2;
    return {surroundings_ground, axis, float(scene.position[axis] - state.parameters.ground_height)};
}

}  // namespace airlight
