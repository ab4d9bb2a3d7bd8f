#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "core/gaussian_tiles.h"

namespace brume {

// What the host makes of the scene's lights and Gaussians for its effects: data images, the tiles' lists, and the Gaussians'
// density along each pixel's ray. Its passes are services' like an effect's.
class SceneImages {
public:
    // Throws Error. Nothing is made of what the scene lacks.
    void plan(brume_host_t &host, const brume_plugin_scene &scene, const brume_format &format, uint32_t backend);
    // Fills the frame's images; the host remembers the message of a failure.
    brume_status execute(brume_host_t &host, brume_plugin_frame &frame);

private:
    float longest_list() const;
    brume_status density_cpu(brume_host_t &host, const brume_plugin_frame &frame);
    brume_status density_gl(brume_host_t &host, const brume_plugin_frame &frame);

    bool planned_ = false;
    int32_t width_ = 0, height_ = 0;
    brume_plugin_image density_ = nullptr;  // null: no Gaussians
    brume_program program_ = nullptr;       // null on the CPU
    brume_plugin_image gaussians_ = nullptr, tiles_ = nullptr, tile_gaussians_ = nullptr, lights_ = nullptr;
    GaussianTiles lists_;

    // What the uploaded images were made of.
    uint64_t revision_ = 0;
    brume_plugin_camera camera_{};
    double position_[3] = {};
    bool uploaded_ = false;
};

}  // namespace brume
