// The passes of method `maps`, described once for every backend.
#pragma once
#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

// The members of a struct's member `grid`, for tables of constants.
#define BRUME_GRID_SETTINGS(Struct)                                                                                         \
    BRUME_CONSTANT_OF(Struct, grid, size), BRUME_CONSTANT_OF(Struct, grid, columns), BRUME_CONSTANT_OF(Struct, grid, rows), \
        BRUME_CONSTANT_OF(Struct, grid, cell), BRUME_CONSTANT_OF(Struct, grid, slices),                                     \
        BRUME_CONSTANT_OF(Struct, grid, across), BRUME_CONSTANT_OF(Struct, grid, side),                                     \
        BRUME_CONSTANT_OF(Struct, grid, nodes), BRUME_CONSTANT_OF(Struct, grid, mapped),                                    \
        BRUME_CONSTANT_OF(Struct, grid, gaussians), BRUME_CONSTANT_OF(Struct, grid, summed),                                \
        BRUME_CONSTANT_OF(Struct, grid, grey), BRUME_CONSTANT_OF(Struct, grid, angle),                                      \
        BRUME_CONSTANT_OF(Struct, grid, depth), BRUME_CONSTANT_OF(Struct, grid, bend),                                      \
        BRUME_CONSTANT_OF(Struct, grid, doubt)

namespace airlight::maps {

// Of all passes; each reads what concerns it.
struct Constants {
    brume::maths_float::GridSettings grid;
    brume::maths_float::AirlightSettings airlight;
    brume::maths_float::ivec2 light_range;  // the lights [x, y); four at most where the grid has no sums
    int32_t reduction;
    int32_t estimate;  // the error is wanted
    int32_t whole;     // the lights' sums go beyond what the picture shows
};

namespace attenuation {
enum Slot { light_gaussians, frames, lights, result, slot_count };
}
namespace density {
enum Slot { gaussians, tiles, tile_gaussians, slices, result, slot_count };
}
namespace lights {
enum Slot { attenuation, frames, lights, slices, grid_density, depth, result, slot_count };
}
namespace gather {
enum Slot {
    depth,
    gaussian_density,
    slices,
    grid_density,
    grid_lights,
    attenuation,
    frames,
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
