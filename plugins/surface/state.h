#pragma once
#include <algorithm>
#include <vector>

#include <brume/brume_plugin.h>

#include "parameters.h"

namespace surface {

// In the order of the effect's tables.
enum Layer {
    layer_normal,
    layer_light_group,
    layer_albedo,
    layer_specular,
    layer_roughness,
    layer_transfer,  // the first of them
    layer_last_transfer = layer_transfer + 5,
    layer_shadow,
    layer_surface,
    layer_count
};
enum Product { product_lights, product_light_gaussians, product_density_rgb, product_light_shadows, product_count };

// Of the data images.
enum Upload : uint32_t { upload_ungrouped, upload_environment, upload_turned, upload_table };

// A pass for what scenes of the plan are without (SurfaceSettings::without), from the most to what fits all.
struct Variants {
    struct Variant {
        int without;
        brume_pass pass;
    };
    std::vector<Variant> all;

    const Variant &fitting(int without) const
    {
        return *std::find_if(all.begin(), all.end(), [&](const Variant &v) { return (v.without & ~without) == 0; });
    }
};

// What one plan of this effect holds. Images and passes that a plan does not need are NULL.
struct State {
    int width = 0;
    int height = 0;
    Method method = Method::calibrated;
    float ground = 0;                      // albedo
    brume_plugin_image normals = nullptr;  // from depth
    // Before and after one lamp's own layer, by turns.
    brume_plugin_image rest[2] = {};
    brume_plugin_image lit[2] = {};
    int transfer = 0;  // degrees that frames bring of the surfaces' transfer

    bool shadowed = false;         // some light has a shadow map
    int material = 0;              // as SurfaceSettings has it
    bool sky = false;              // the scene has an environment
    bool composes_groups = false;  // the last pass takes layers of lights, too

    brume_plugin_image table = nullptr;  // the method's
    brume_plugin_image ungrouped = nullptr, environment = nullptr;
    brume_plugin_image turned = nullptr;                            // the environment in the transfer's axes
    std::vector<float> ungrouped_values, environment_values, axes;  // as they were uploaded, and the camera's

    brume_pass normals_pass = nullptr;
    Variants transfer_pass, group_pass, compose_pass;
};

// At planning, when the entries are there.
brume_status create_passes(const brume_services &services, brume_host host, const brume_plugin_request &request,
                           State &state);

// One frame's passes, in order.
brume_status run_passes(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state);

}  // namespace surface
