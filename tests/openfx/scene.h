// A picture with lamps, distances, and what the C ABI of the library makes of them by itself.
#pragma once
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <brume/brume.hpp>

#include "host.h"

namespace scene {

// Lamps before a dark pattern; alpha differs from pixel to pixel.
void paint(host::Picture &picture);
// Distances from 4 to 90, and sky above.
void paint_depth(host::Picture &picture, int channel = 0);

// What the plugin's defaults say, for changes.
struct World {
    brume_medium medium;
    brume_density_term term = BRUME_DENSITY_TERM_INIT;  // counts where it has a falloff
    brume_camera camera;
    brume_format format = BRUME_FORMAT_INIT;
    uint32_t preset = BRUME_PRESET_NONE;
    double metres = 1;
    const char *text = nullptr;  // a scene file's, which replaces the medium
    double frame = 0;
    World();
};

// Packed and from the top left; the depth is one channel of `depth`. Then the bits are those of the output, or a failure
// names the first pixel that differs.
void expect_fogged(const host::Picture &output, const host::Picture &source, const host::Picture &depth, int channel,
                   const World &world = {});

}  // namespace scene
