#pragma once
#include <vector>

namespace multiscatter {

// What the table of kernel `calibrated` depends on.
struct SpreadSource {
    double scattering = -1;  // sigma_s and sigma_a at unit density, luminance [1/m]
    double absorption = 0;
    double asymmetry = 0;  // g
    double focal = 0;      // [px]
    int top = 0;           // K

    bool operator==(const SpreadSource &) const = default;
};

// log2 of P [m at unit density] at place 0 of the table.
double first_place(const SpreadSource &source);

// The table of shaders/lib/calibrated.glsl, levels 0 to K.
std::vector<float> spread_values(const SpreadSource &source);

}  // namespace multiscatter
