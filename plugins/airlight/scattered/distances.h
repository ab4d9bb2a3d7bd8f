// Where the grid has its points, and the peaks that it has apart.
#pragma once
#include <vector>

#include <brume/brume_plugin.h>

namespace airlight::scattered {

// steps + 1 distances [m], the first 0: dense where the view has lamps and Gaussians, and before the end in growing steps.
// angle: between the grid's rays.
std::vector<float> place_distances(const brume_plugin_scene &scene, int width, int height, int steps, double angle);

// w_0 and those of the lights, of shaders/lib/airlight_scattered.glsl.
std::vector<float> peaks_of(const brume_plugin_scene &scene);

}  // namespace airlight::scattered
