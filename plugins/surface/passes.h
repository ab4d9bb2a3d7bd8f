// The passes, described once for every backend.
#pragma once
#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

namespace surface {

// Lights' own layers that one run of a pass takes.
constexpr int groups_at_once = 4;

// Of all passes; each reads what concerns it.
struct Constants {
    brume::maths_float::SurfaceSettings settings;
    brume::maths_float::ivec4 of_lights;  // whose layers they are
    int32_t groups;
    int32_t first;
};

// The slots of each pass, by index.
namespace normals {
enum Slot { depth, normals, slot_count };
}

// What passes that go through lights begin with: the first `of_all`, and but for surfaces' transfer the others. Programs
// leave out what they do not read.
namespace shared {
enum Slot {
    depth,
    normals,
    lights,
    ungrouped,
    light_gaussians,
    table,
    albedo,
    of_all,
    specular = of_all,
    roughness,
    rest,
    lit,
    group_0,
    slot_count = group_0 + groups_at_once
};
}

namespace transfer {
enum Slot { environment = shared::of_all, in_axes, transfer_0, brought = transfer_0 + 6, slot_count };
}

namespace group {
enum Slot { rest_out = shared::slot_count, lit_out, slot_count };
}

// Where there is a sky or a shadow map, these come in the place of lights' own layers: passes have 16 images to read.
namespace compose {
enum Slot {
    environment = shared::group_0,
    light_shadows,
    shadow_maps,
    color = shared::slot_count,
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
