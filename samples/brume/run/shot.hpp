#pragma once

#include <string>

#include <brume/brume.h>

#include "commands/options.hpp"
#include "exr/file.hpp"

namespace brume::tool {

/// A picture as the library is told of it: its windows, and what its depth means. Extra outputs are left to the caller.
brume_format format_of(const Imath::Box2i &data, const Imath::Box2i &display, const PictureOptions &options);

/// What of the camera is known.
brume_camera camera_of(const Camera &camera, const Imath::Box2i &display);

/// What of one picture the plan and the camera depend on.
struct Shot {
    brume_format format = BRUME_FORMAT_INIT;
    brume_camera camera = BRUME_CAMERA_INIT;
    std::string camera_source;  ///< where field of view and pose came from
};

/// `scene_camera`: what the scene gives itself (BRUME_CAMERA_...), which goes before the metadata.
Shot shot_of(const Imf::Header &header, const Imath::Box2i &data, const PictureOptions &options, std::uint32_t scene_camera);

}  // namespace brume::tool
