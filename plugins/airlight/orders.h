#pragma once
#include <brume/brume_plugin.h>

namespace airlight {

// Of what arrives of the lamps' light about as far from them as the camera is, the share that was scattered on the way: what
// a picture of single scattering lacks, roughly. 1 where nobody knows the medium yet.
double scattered_on_the_way(const brume_plugin_scene &scene, int width, int height);

}  // namespace airlight
