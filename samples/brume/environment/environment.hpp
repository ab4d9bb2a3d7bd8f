#pragma once

#include "support/sdk.hpp"

namespace brume::tool {

/// Gives a scene whose text names an environment image the image's coefficients. Throws RequestError where it cannot be
/// read.
void resolve_environment(const Context &context, Scene &scene);

}  // namespace brume::tool
