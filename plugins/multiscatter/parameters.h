#pragma once
#include <span>

#include <brume/brume_plugin.h>

#include "maths.hpp"

namespace multiscatter {

enum class Kernel { paper, reference, calibrated, paper_reference };

// The effect's parameters as its passes read them. Those of kernel paper default to the paper's.
struct Parameters {
    Kernel kernel;
    int taps;  // of the pyramid's kernel: 2, 4 or 6
    int levels;
    int reduction;               // kernel calibrated: side of the square of pixels that are filtered as one: 1, 2 or 4
    int step;                    // kernel calibrated: light stays at every step-th level
    double separation_fraction;  // k_ssc / K
    brume::maths_float::Filter filter;  // `top` and `separation_level` are the plan's to set
};

std::span<const brume_parameter_info> parameter_table();
Parameters read_parameters(const double *values);

// Sets those of a table's values that decide how kernel `calibrated` and its reference run.
void choose(double *values, Kernel kernel, int step, int reduction);

}  // namespace multiscatter
