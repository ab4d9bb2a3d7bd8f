// The passes, described once for every backend.
#pragma once
#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

namespace airlight {

struct State;

// Of all passes; each reads what concerns it.
struct Constants {
    brume::maths_float::AirlightSettings airlight;
    brume::maths_float::SurroundingsSettings around;
    brume::maths_float::ivec2 size;         // of the full images
    brume::maths_float::ivec2 light_range;  // the lights [x, y) that are gathered
    int32_t reduction;
    int32_t ordered;  // lights in each tile's order; 0: there is none
    // What shaders have as defines.
    int32_t tier;
    int32_t lit;
    int32_t attenuates;
};

// The slots of each pass, by index.
namespace blobs {
enum Slot { gaussians, lights, light_gaussians, density, slot_count };
}

namespace around {
enum Slot { depth, lights, surroundings, slot_count };
}

namespace gather {
enum Slot {
    depth,
    gaussian_density,
    tiles,
    gaussians,
    lights,
    tile_gaussians,
    light_gaussians,
    blob_density,
    sun_table,
    surroundings,
    environment,
    environment_table,
    light_shadows,
    shadow_maps,
    lamp_order,
    radiance,
    error,
    distances,
    slot_count
};
}

namespace compose {
enum Slot {
    color,
    density,
    density_rgb,
    radiance,
    error,
    distances,
    result,
    transmittance_out,
    optical_depth_out,
    airlight_out,
    airlight_error_out,
    slot_count
};
}

brume_status blobs_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status around_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status gather_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
// The same, of tier nodes.
brume_status gather_nodes_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
// Of tier reference, in double; it has no shader.
brume_status gather_reference_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
// layered: each colour has its own density.
template <bool layered> brume_status compose_rows(const brume_plugin_rows *call, int32_t first, int32_t last);

// At planning, when the entries are there: the passes that the state needs. outputs: bits by the order of the layers table.
brume_status create_passes(const brume_services &services, brume_host host, uint32_t outputs, State &state);

// One frame's passes, in order.
brume_status run_passes(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state);

}  // namespace airlight
