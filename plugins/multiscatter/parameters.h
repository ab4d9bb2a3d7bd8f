#pragma once
#include <span>

#include <brume/brume_plugin.h>

#include "maths.hpp"

namespace multiscatter {

enum class Kernel { paper, reference, calibrated };

// The effect's parameters as its passes read them. Those of kernel paper default to the paper's.
struct Parameters {
    Kernel kernel;
    int taps;  // of the pyramid's kernel: 2, 4 or 6
    int levels;
    double separation_fraction;         // k_ssc / K
    brume::maths_float::Filter filter;  // `top` and `separation_level` are the plan's to set
};

std::span<const brume_parameter_info> parameter_table();
Parameters read_parameters(const double *values);

}  // namespace multiscatter
