#pragma once
#include "scene_maths.hpp"
#include "state.h"

namespace airlight {

// airlight_nodes, ...: the tier as the maths know it.
int tier_of(const State &state);

// How finely the tiers integrate a frame, from the error asked.
brume::maths_float::AirlightSettings settings_of(const State &state, const brume_plugin_scene &scene);

// Where the planes around lamps come from.
brume::maths_float::SurroundingsSettings surroundings_settings(const State &state, const brume_plugin_scene &scene);

}  // namespace airlight
