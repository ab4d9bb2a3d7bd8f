// The passes of light that has been scattered before, described once for every backend.
#pragma once
#include <brume/brume_plugin.h>

#include "scattered/maths.h"

namespace airlight::scattered {

// Of both passes; each reads what concerns it.
struct Constants {
    brume::maths_float::ScatteredSettings settings;
    brume::maths_float::GridSettings grid;  // of tier maps
    brume::maths_float::ivec2 light_range;  // the lights [x, y)
    int32_t reduction;
    int32_t environment_order;
};

namespace make {
enum Slot { distances, lights, surroundings, light_gaussians, result, slot_count };
}

namespace add {
enum Slot {
    depth,
    gaussian_density,
    tiles,
    gaussians,
    tile_gaussians,
    lights,
    distances,
    scattered,
    grid_density,
    environment,
    environment_table,
    previous,
    previous_error,
    radiance,
    error,
    slot_count
};
}

brume_status make_rows(const brume_plugin_rows *call, int32_t first, int32_t last);
brume_rows_function add_rows_of_this_machine();

}  // namespace airlight::scattered
