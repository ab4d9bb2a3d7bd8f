#pragma once
// The table's rows: every condition under which an effect's output must be finite and within range.
#include <string>
#include <vector>

#include "lit_scene.h"

namespace extremes {

using fog::Json;

struct Condition {
    std::string family;  // errors are printed by it
    std::string name;
    Json medium;
    Json lights;
    float depth = 10;  // along the ray
    float radiance = 1;
    bool saturates = false;  // radiance_limit holds nodes where the exact radiance is beyond
    bool dark = false;       // next to nothing of the light arrives, and quadrature may miss it

    std::string describe() const { return family + " " + name; }
    bool isotropic() const;
    bool homogeneous() const;
    bool about_lights() const;
    // A phase function's peak of a thousandth of a radian is as bright as single precision happens to land on it.
    bool peaked() const;
};

std::vector<Condition> conditions();

// A thin constant medium with one Gaussian in it, and a light above the way to a surface.
Json ordinary_medium();
Json ordinary_lights();

}  // namespace extremes
