#pragma once

#include "compare/comparison.hpp"

namespace brume::tool {

/// Puts a copy of A in B's place, whole or not at all, and says so in the result; nothing where the bytes are the same
/// already, or where A could not be read. Throws FrameError.
void update_reference(Comparison &comparison);

}  // namespace brume::tool
