#pragma once
#include "fog.h"

namespace fog {

// The metrics of the tool's `compare` are of this: 2 x 2 box averages, then a 3 x 3 box filter.
Picture smoothed(const Picture &p);

double rel_mse(const Picture &a, const Picture &b);

// As brume_quality.max_error counts.
double error_of(const Picture &a, const Picture &reference);

// As brume_quality.detail.
double detail_of(const Picture &p);

}  // namespace fog
