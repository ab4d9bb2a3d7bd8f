#pragma once

#include <brume/brume.h>

#include "commands/options.hpp"
#include "exr/file.hpp"

namespace brume::tool {

/// A picture as the library is told of it: its windows, and what its depth means. Extra outputs are left to the caller.
brume_format format_of(const Imath::Box2i &data, const Imath::Box2i &display, const PictureOptions &options);

/// What of the camera is known.
brume_camera camera_of(const Camera &camera, const Imath::Box2i &display);

}  // namespace brume::tool
