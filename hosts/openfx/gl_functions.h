#pragma once

namespace openfx {

// Before the first call of OpenGL; false where the host has no library loaded that has all of what the bundle calls.
bool load_gl();

}  // namespace openfx
