#pragma once
#include "pass_tables.hpp"
#include "scene_maths.hpp"
#include "state.h"

// The members of a struct's member `airlight`, for tables of constants.
#define BRUME_AIRLIGHT_SETTINGS(Struct)                                                                                     \
    BRUME_CONSTANT_OF(Struct, airlight, light_count), BRUME_CONSTANT_OF(Struct, airlight, gaussian_count),                  \
        BRUME_CONSTANT_OF(Struct, airlight, environment_order), BRUME_CONSTANT_OF(Struct, airlight, panels),                \
        BRUME_CONSTANT_OF(Struct, airlight, dense_from), BRUME_CONSTANT_OF(Struct, airlight, cells),                        \
        BRUME_CONSTANT_OF(Struct, airlight, tolerance), BRUME_CONSTANT_OF(Struct, airlight, near_radii),                    \
        BRUME_CONSTANT_OF(Struct, airlight, culled), BRUME_CONSTANT_OF(Struct, airlight, orders),                           \
        BRUME_CONSTANT_OF(Struct, airlight, shadowed), BRUME_CONSTANT_OF(Struct, airlight, spared)

namespace airlight {

// airlight_nodes, ...: the tier as the maths know it.
int tier_of(const State &state);

// How finely the tiers integrate a frame, from the error asked.
brume::maths_float::AirlightSettings settings_of(const State &state, const brume_plugin_scene &scene);

// Whether each pixel gathers orders beyond the first itself.
bool gathers_orders(const State &state);

// Where the planes around lamps come from.
brume::maths_float::SurroundingsSettings surroundings_settings(const State &state, const brume_plugin_scene &scene);

}  // namespace airlight
