#pragma once
#include <vector>

#include <brume/brume_plugin.h>

#include "scene_maths.hpp"

namespace airlight {

// What estimates over the planned view try of it: the directions of some rays, and one Gaussian of so many.
std::vector<brume::maths_double::vec3> tried_rays(const brume_plugin_scene &scene, int width, int height);
uint32_t tried_step(const brume_plugin_scene &scene);

// How many Gaussians rays come near, in the mean over the planned view.
struct Encounters {
    double of_sight = 0;  // from the camera; the lists of the tiles are as long
    double of_light = 0;  // through what a ray shows of Gaussians, toward a light
};

// Estimated from some rays and some Gaussians; one each where there are Gaussians that planning does not know.
Encounters encounters(const brume_plugin_scene &scene, int width, int height);

}  // namespace airlight
