// The passes of method `maps`, described once for every backend.
#pragma once
#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

namespace airlight::maps {

// Of all passes; each reads what concerns it.
struct Constants {
    brume::maths_float::GridSettings grid;
    brume::maths_float::AirlightSettings airlight;
    brume::maths_float::ivec2 light_range;  // the lights [x, y), four at most
    int32_t reduction;
    int32_t estimate;  // the error is wanted
};

namespace attenuation {
enum Slot { gaussians, cells, cell_gaussians, shadow_origins, frames, lights, result, slot_count };
}
namespace density {
enum Slot { gaussians, tiles, tile_gaussians, slices, result, slot_count };
}
namespace lights {
enum Slot { attenuation, frames, lights, slices, result, slot_count };
}
namespace gather {
enum Slot {
    depth,
    gaussian_density,
    slices,
    grid_density,
    grid_lights,
    lights,
    environment,
    environment_table,
    surroundings,
    light_shadows,
    shadow_maps,
    previous,
    previous_error,
    radiance,
    error,
    distances,
    slot_count
};
}

struct Rows {
    brume_rows_function attenuation, density, lights, gather;
};
const Rows &rows_of_this_machine();

}  // namespace airlight::maps
