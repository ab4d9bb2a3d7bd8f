#pragma once

#include <string>
#include <vector>

#include <brume/brume.h>

#include "run/options.hpp"
#include "image/resolve.hpp"

namespace brume::tool {

/// A picture as the library is told of it: its windows, and what its depth means. Extra outputs are left to the caller.
brume_format format_of(const Window &data, const Window &display, const PictureOptions &options);

/// What of the camera is known.
brume_camera camera_of(const Camera &camera, const Window &display);

/// What of one picture the plan and the camera depend on.
struct Shot {
    brume_format format = BRUME_FORMAT_INIT;
    brume_camera camera = BRUME_CAMERA_INIT;
    std::string camera_source;              ///< where field of view and pose came from
    std::vector<std::string> camera_notes;  ///< metadata that was there and could not be used
};

/// Field of view and pose, each from the first that has it: the options, the scene, the file's metadata.
Camera camera_of_picture(const ImageFile &file, const ColorChoice &color, const PictureOptions &options,
                         const CameraBlock &scene, int frame);

Shot shot_of(const ImageFile &file, const ColorChoice &color, const PictureOptions &options, const CameraBlock &scene,
             int frame);

}  // namespace brume::tool
