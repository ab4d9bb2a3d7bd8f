#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "parameters.h"
#include "scene_maths.hpp"
#include "shadow_lists.h"

namespace airlight {

// What of BRUME_OUTPUT_... this effect fills.
constexpr uint32_t own_outputs = BRUME_OUTPUT_TRANSMITTANCE | BRUME_OUTPUT_OPTICAL_DEPTH | BRUME_OUTPUT_AIRLIGHT |
                                 BRUME_OUTPUT_AIRLIGHT_ERROR | BRUME_OUTPUT_LIGHT_AIRLIGHT;

// Slots of the data images.
enum Slot : uint32_t { slot_origins, slot_cells, slot_cell_gaussians, slot_blob_density, slot_sun_table, slot_environment, slot_environment_table };

// What one plan of this effect holds. Images that a plan does not need are NULL.
struct State {
    Parameters parameters;
    int width = 0;
    int height = 0;
    bool lit = false;          // some light or environment scatters in the medium
    bool attenuates = false;   // no effect before this one does
    brume_plugin_image radiance = nullptr;   // airlight of one pixel per square
    brume_plugin_image error = nullptr;      // its estimated error
    brume_plugin_image distances = nullptr;  // of those pixels; where they are fewer than the image's
    brume_plugin_image sun_table = nullptr;
    brume_plugin_image environment = nullptr;  // its coefficients
    brume_plugin_image environment_table = nullptr;
    int environment_order = 0;

    // Refreshed when something moved.
    brume_plugin_image origins = nullptr, cells = nullptr, cell_gaussians = nullptr;
    brume_plugin_image blob_density = nullptr;  // tier fogshop
    bool blobs_pending = false;                 // its pass has to run
    ShadowLists lists;
    uint64_t revision = 0;
    brume_plugin_camera camera{};
    double position[3] = {};
    bool listed = false;

    // GL programs; NULL on the CPU.
    brume_program blobs = nullptr;
    brume_program gather = nullptr;
    brume_program compose = nullptr;
};

// As brume_effect.
uint32_t offer(const brume_plugin_request *request, uint32_t index, double *parameters, double *error);

}  // namespace airlight
