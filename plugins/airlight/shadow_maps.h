#pragma once
#include <string>

#include "state.h"

namespace airlight {

uint32_t shadowed_lights(const brume_plugin_scene &scene);

// Finds a frame's maps; says what is wrong with them, "" if nothing.
std::string take_shadow_maps(const brume_plugin_frame &frame, State &state);

}  // namespace airlight
