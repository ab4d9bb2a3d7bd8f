#pragma once
#include "core/scene.h"

namespace brume {

// A medium that came in structs, held to the same ranges as a scene file's; throws Error(BRUME_ERROR_ARGUMENT).
void check_medium(const Medium &medium);

}  // namespace brume
