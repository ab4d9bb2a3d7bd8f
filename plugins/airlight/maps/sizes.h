// How fine the grid and the maps are for the error asked of them.
#pragma once
#include <cstdint>

#include <brume/brume_plugin.h>

namespace airlight::maps {

constexpr int most_slices = 384;

struct Fineness {
    double cell;   // of a Gaussian's deviation
    double steps;  // per radius of a Gaussian
    int least_slices;
    int side, nodes;  // of the attenuation maps
    double angle;     // [rad]
    double depth;     // optical
    double doubt;     // see shaders/lib/grid_settings.glsl; measured by maps_bench and tests/effects/maps_test.cpp
};
Fineness fineness_of(double max_error);

struct Sizes {
    int cell;  // [px]
    int slices;
    uint64_t bytes;
    bool fine;  // as fine as the Gaussians want it
};
// most_bytes: of the grid. scene.gaussians may be NULL: then of a usual medium.
Sizes sizes_of(const brume_plugin_scene &scene, int width, int height, int least_cell, const Fineness &fineness,
               uint64_t most_bytes);

}  // namespace airlight::maps
