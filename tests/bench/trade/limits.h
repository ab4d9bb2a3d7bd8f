#pragma once
// Where the models stop being valid, on the path-traced scenes.
#include "sets.h"

namespace trade {

struct Limit {
    std::string scene;
    double optical_depth = 0, g = 0;     // the depth's median over the picture
    double without_fog = 0, filter = 0;  // errors against truth, kernel calibrated
    double lights_once = 0, both = 0;    // airlight of the scene's spheres without the filter, and both effects
    // Half of the picture against truth: cut out of the fogged picture, and fogged without the other half.
    double half_of_whole = 0, half_alone = 0;
};

std::vector<Limit> measure_limits(const brume::Context &cpu, const Options &options, const std::vector<Case> &truths);

}  // namespace trade
