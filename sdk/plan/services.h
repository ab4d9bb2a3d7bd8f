#pragma once
#include <brume/brume_plugin.h>

namespace brume {

// The table that effects call; each function catches what the plan throws, so nothing crosses a plugin's C frames.
const brume_services &services();

}  // namespace brume
