#pragma once
#include <cstdint>
#include <vector>

#include <brume/brume_plugin.h>

namespace brume {

// Which Gaussians matter in which tiles of the screen: as product "gaussians" has them.
struct GaussianTiles {
    int32_t columns = 0;
    int32_t rows = 0;
    std::vector<float> ranges;   // 4 per tile, row by row: first, count, 0, 0
    std::vector<float> indices;  // of the Gaussians, ascending distance within a tile
    uint64_t seen = 0;           // Gaussians that are in some tile
};

// What the lists will come to, without building them.
struct TileEstimate {
    uint64_t seen = 0;  // Gaussians that are in some tile; a few beside the image's corners are counted as if they were
    double length = 0;  // of a tile's list, in the mean
};
TileEstimate estimate_tiles(const brume_plugin_scene &scene, int32_t width, int32_t height);

// Throws Error(BRUME_ERROR_UNSUPPORTED) if the lists grow beyond what a float can count.
void build_tiles(const brume_plugin_scene &scene, int32_t width, int32_t height, GaussianTiles &out);

}  // namespace brume
