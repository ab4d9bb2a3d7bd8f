// The distances at which the grid has its points.
#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "maps/sizes.h"

namespace airlight::maps {

// How many steps the scene would have.
int wanted_slices(const brume_plugin_scene &scene, const Fineness &fineness);

// slices + 1 distances [m], the first 0: as dense as the Gaussians they pass are small, and before and behind those, where
// the medium has constant or exponential terms, in growing steps.
void place_slices(const brume_plugin_scene &scene, int slices, std::vector<float> &distances);

// Beyond this the constant and exponential terms add nothing that shows [m]. gaussians: how far those reach.
double end_of_terms(const brume_plugin_scene &scene, double gaussians);

}  // namespace airlight::maps
