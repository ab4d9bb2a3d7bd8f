#pragma once
#include <brume/brume.h>

#include "gl/image.h"
#include "gl/state_guard.h"

namespace brume::gl {

// Between host memory and a texture of 1 or 4 channels and the host image's own pixel type; samples move as bits, so
// the only conversions are grey to RGB and a missing alpha to 1 on the way in, and the reverse on the way out. Both
// wait for the memory to be done with.
void upload(const brume_image &from, const GlImage &to, StateGuard &guard);
void download(const GlImage &from, const brume_image &to, StateGuard &guard);

}  // namespace brume::gl
