#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "gaussians/gaussian_tiles.h"
#include "gaussians/light_gaussians.h"
#include "plan/layers.h"
#include "plan/products.h"
#include "plan/shadow_maps.h"

namespace brume {

// Of the host's data images.
enum HostUpload : uint32_t {
    upload_of_gaussians,
    upload_of_tiles,
    upload_of_tile_gaussians,
    upload_of_lights,
    upload_of_light_shadows,
    upload_of_visible_lights,
    upload_of_light_gaussians
};

// What the host makes of the scene for effects, as brume_plugin_product lists it: made only where something uses it. Its
// passes are services' like an effect's.
class HostProducts {
public:
    static bool makes(std::string_view product);

    // uses: names of the products that running effects use. Throws Error.
    void plan(brume_host_t &host, const std::vector<std::string> &uses, const brume_plugin_scene &scene,
              const FrameLayers &layers, int32_t width, int32_t height);
    // Throws Error.
    void execute(brume_host_t &host, const brume_plugin_scene &scene, brume_plugin_image depth, const FrameLayers &layers);

private:
    void upload(brume_host_t &host, const brume_plugin_scene &scene);
    void upload_gaussians(brume_host_t &host, const brume_plugin_scene &scene);
    void upload_light_gaussians(brume_host_t &host, const brume_plugin_scene &scene, bool moved);
    void upload_lights(brume_host_t &host, const brume_plugin_scene &scene);
    void upload_visible_lights(brume_host_t &host, const brume_plugin_scene &scene);
    float longest_list() const;

    int32_t width_ = 0, height_ = 0;
    bool lights_ = false, visible_lights_ = false, light_gaussians_ = false, camera_gaussians_ = false;
    int layer_ = 0;  // what the caller gives in place of the scene's density: 0 nothing, 1 optical depth, 2 transmittance
    brume_plugin_image density_ = nullptr, density_rgb_ = nullptr, gaussian_density_ = nullptr;  // null: not made
    brume_pass density_pass_ = nullptr, gaussian_pass_ = nullptr;
    brume_plugin_image gaussians_ = nullptr, tiles_ = nullptr, tile_gaussians_ = nullptr;
    GaussianTiles lists_;
    LightGaussians directions_;
    ShadowMaps shadow_maps_;
    std::vector<float> texels_, spheres_;  // kept from frame to frame, as the others

    // What was uploaded.
    bool uploaded_ = false;
    uint64_t revision_ = 0, uploads_ = 0;
    brume_plugin_camera camera_{};
    double position_[3] = {};
};

}  // namespace brume
