#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "maps/maps.h"
#include "parameters.h"
#include "scattered/scattered.h"

namespace airlight {

// In the order of the effect's tables.
enum Layer {
    layer_transmittance,
    layer_optical_depth,
    layer_airlight,
    layer_airlight_error,
    layer_light_airlight,
    layer_shadow,
    layer_count
};
enum Product {
    product_density,
    product_density_rgb,
    product_gaussian_density,
    product_gaussians,
    product_lights,
    product_light_shadows,
    product_light_gaussians,
    product_camera_gaussians,
    product_count
};

// Of the data images.
enum Upload : uint32_t {
    upload_blob_density,
    upload_sun_table,
    upload_environment,
    upload_environment_table,
    upload_slices,
    upload_attenuation_frames,
    upload_distances
};

// What one plan of this effect holds. Images that a plan does not need are NULL.
struct State {
    Parameters parameters;
    int width = 0;
    int height = 0;
    bool environment_scatters = false;       // there is one, and no other effect takes it for what surrounds the picture
    bool lit = false;                        // some light or environment scatters in the medium
    bool attenuates = false;                 // no effect before this one does
    bool layered = false;                    // a layer of the caller's stands for the medium's density
    bool shadowed = false;                   // some light has a shadow map
    bool has_blobs = false;                  // tier fogshop, in a medium with Gaussians
    brume_plugin_image radiance = nullptr;   // airlight of one pixel per square
    brume_plugin_image error = nullptr;      // its estimated error
    brume_plugin_image distances = nullptr;  // of those pixels; where they are fewer than the image's
    brume_plugin_image sun_table = nullptr;
    brume_plugin_image environment_table = nullptr;
    int environment_order = 0;
    brume_plugin_image surroundings = nullptr;  // with Orders::all
    brume_plugin_image lamp_bounds = nullptr;
    brume_plugin_image lamp_order = nullptr;
    int64_t order_texels = 0;  // that those hold

    // Refreshed when something moved.
    brume_plugin_image environment = nullptr;  // its coefficients
    brume_plugin_image blob_density = nullptr;
    bool blobs_pending = false;  // its pass has to run
    std::vector<float> values;   // on their way to an image
    uint64_t revision = 0;
    brume_plugin_camera camera{};
    double position[3] = {};
    bool fresh = false;

    Maps maps;
    Scattered scattered;

    // NULL: not needed.
    brume_pass blobs = nullptr;
    brume_pass around = nullptr;
    brume_pass bounds = nullptr;
    brume_pass order = nullptr;
    brume_pass gather = nullptr;
    brume_pass compose = nullptr;
};

// At planning: the tables that the tier reads.
brume_status plan_tables(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state);

// What follows the scene, made again when something moved.
brume_status refresh(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state);

// As brume_effect.
uint32_t offer(const brume_services *services, brume_host host, const brume_plugin_request *request, uint32_t index,
               double *parameters, double *error);

}  // namespace airlight
