#pragma once

namespace brume::tool {

/// The first SIGINT or SIGTERM asks for a stop: frames under way are finished or discarded. The second ends the process at
/// once; either way no half-written file is left.
void catch_interrupts();
bool interrupted();

}  // namespace brume::tool
