// The passes, described once for every backend.
#pragma once
#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

namespace surface {

// Of all passes; each reads what concerns it.
struct Constants {
    brume::maths_float::SurfaceSettings settings;
    int32_t light;
    int32_t first;
};

// The slots of each pass, by index.
namespace normals {
enum Slot { depth, normals, slot_count };
}

namespace transfer {
enum Slot {
    depth,
    normals,
    lights,
    ungrouped,
    gaussians,
    environment,
    in_axes,
    table,
    albedo,
    transfer_0,
    transfer_1,
    transfer_2,
    transfer_3,
    transfer_4,
    transfer_5,
    brought,
    slot_count
};
}

namespace group {
enum Slot {
    rest,
    lit,
    group,
    depth,
    normals,
    lights,
    gaussians,
    table,
    albedo,
    specular,
    roughness,
    rest_out,
    lit_out,
    slot_count
};
}

namespace compose {
enum Slot {
    color,
    rest,
    lit,
    depth,
    normals,
    lights,
    ungrouped,
    gaussians,
    environment,
    table,
    albedo,
    specular,
    roughness,
    light_shadows,
    shadow_maps,
    result,
    surface_out,
    slot_count
};
}

brume_status normals_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status transfer_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status group_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status compose_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status group_reference_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_status compose_reference_rows(const brume_plugin_rows *call, int32_t first, int32_t last);

}  // namespace surface
