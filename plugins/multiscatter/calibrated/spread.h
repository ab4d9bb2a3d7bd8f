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
    int step = 2;          // light stays at every step-th level

    bool operator==(const SpreadSource &) const = default;
};

inline constexpr double first_depth = 1.0 / 512;  // tau at place 0 of the table; the last is 90

// The light of a source behind `depth` (scattering optical depth) that appears between two angles from it: 2 pi gamma
// F(gamma) dgamma, apart from a factor. Nothing beyond .87.
double light_between(const SpreadSource &source, double depth, double from, double to);

// The share of what a source at distance 1 scatters toward the camera, once and at an angle, that is scattered in front of
// something at distance `ratio` there, relative to that in front of something as far as the source. asymmetry: g of
// Henyey-Greenstein; below 0 as 0.
double visible(double asymmetry, double angle, double ratio);

// log2 of P [m at unit density] at place 0 of the table.
double first_place(const SpreadSource &source);

// The table of shaders/lib/calibrated.glsl, levels 0 to K.
std::vector<float> spread_values(const SpreadSource &source);

}  // namespace multiscatter
