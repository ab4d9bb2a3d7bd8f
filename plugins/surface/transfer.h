#pragma once
#include <vector>

#include <brume/brume_plugin.h>

namespace surface {

// The environment's coefficients, as environment_of() has them, in the camera's axes. Degrees above those of transfers stay
// away.
std::vector<float> environment_in_camera(const brume_plugin_scene &scene);

}  // namespace surface
