#pragma once
#include <array>
#include <complex>
#include <vector>

namespace brume::airlight {

// F(u, v) of Sun et al. 2005 eq. 10 as shaders/lib/airlight_sun.glsl reads it: one channel, row by row of v. Made once.
const std::vector<float> &sun_table();
double sun_function(double u, double v);

// e^z E1(z), Re z >= 0, z != 0: neither over- nor underflows.
std::complex<double> scaled_exponential_integral(std::complex<double> z);

// c_l(T) / (T e^-T) of PSF_T, the spread of a distant light by a homogeneous medium of optical depth T that scatters once
// and alike in all directions (Sun et al. 2005 eq. 12). Zhou et al. have those of T = 1.
std::array<double, 6> psf_coefficients(double depth);

// As shaders/lib/environment.glsl reads it: four channels. Made once.
const std::vector<float> &environment_table();

}  // namespace brume::airlight
