#pragma once

#include <brume/brume.h>

namespace brume::tool {

/// Gives a scene whose text names an environment image the image's coefficients. Throws RequestError where it cannot be
/// read.
void resolve_environment(brume_context context, brume_scene scene);

}  // namespace brume::tool
