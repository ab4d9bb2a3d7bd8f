#include "parameters.h"

#include "parameter_info.hpp"

namespace surface {
namespace {

using namespace brume_parameters;

enum Index { method, ground_albedo, count };

constexpr brume_parameter_info table[count] = {
    choice(
        "method", "calibrated|sun|psf|reference", 0,
        "calibrated: light scattered any number of times, fitted to a Monte Carlo; sun: Sun et al. 2005, tables of light "
        "scattered once; psf: Zhou et al. 2007, the same in spherical harmonics, and the environment's; these two scatter "
        "alike in all directions, whatever g; reference: quadrature in double of light scattered once, CPU only, very slow"),
    number(
        "ground_albedo", 0, 1, 0.2, "",
        "what the ground gives back of what falls on it, from which fog under suns and sky is lit again; method calibrated"),
};

}  // namespace

std::span<const brume_parameter_info> parameter_table()
{
    return table;
}

Method read_method(const double *values)
{
    return Method(int(values[method]));
}

float read_ground_albedo(const double *values)
{
    return float(values[ground_albedo]);
}

}  // namespace surface
