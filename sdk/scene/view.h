#pragma once
#include <array>

#include "scene/scene.h"

namespace brume {

// The camera of one frame: the frame's own goes before the scene's.
struct View {
    uint32_t given = 0;  // BRUME_CAMERA_... flags
    double vertical_fov = 0;
    double pixel_aspect = 1;
    std::array<double, 2> center{0.5, 0.5};
    std::array<double, 16> camera_to_world{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

View view_of(const Scene &scene, const brume_camera *frame_camera, double frame, const brume_format &format);

// The effects' camera: projection of this image (whose rows start at `origin`) and how its depth reads.
void fill_camera(const Scene &scene, const View &view, const brume_format &format, uint32_t origin,
                 brume_plugin_camera &out);

// Throws Error(BRUME_ERROR_ARGUMENT) unless the camera's numbers make sense.
void check_camera(const brume_camera &camera);

}  // namespace brume
