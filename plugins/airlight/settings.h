#pragma once
#include "state.h"

namespace airlight {

// How finely the tiers integrate a frame, from the error asked.
brume::maths_float::AirlightSettings settings_of(const State &state, const brume_plugin_scene &scene);

}  // namespace airlight
