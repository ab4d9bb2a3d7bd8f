#pragma once
#include <vector>

namespace surface {

// What a lobe of Phong of this exponent, 1 / sr in all, sees of a lamp's light that was scattered once, over T e^-T times
// the lamp's irradiance in clear air; theta: between its axis and the lamp. By quadrature of (n + 1) / (2 pi) PSF_T cos^n
// over the lobe's hemisphere (Sun et al. 2005 par. 4.1, whose tables are G_n = 4 pi^2 / (n + 1) / T times this times T
// e^-T).
double lobe_of_scattered(double depth, double exponent, double theta);

// Its logarithm to base 2 as shaders/lib/surface_published.glsl reads it: one channel. Made once.
const std::vector<float> &lobe_table();

// Mean over all directions of int exp(-|u + t w|^2) dt at this distance |u| (Zhou et al. 2007 par. 4.2).
double mean_depth_of_gaussian(double distance);

// What method psf reads: environment_table() and the former, four channels. Made once.
const std::vector<float> &psf_table();

}  // namespace surface
