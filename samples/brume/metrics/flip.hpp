#pragma once

#include "metrics/metrics.hpp"

namespace brume::tool {

/// Mean HDR-FLIP of a against the reference, 0 (equal) to 1, at 67 pixels per degree: about a 4K screen .7 m wide seen from
/// .7 m. Written from Andersson et al. 2020 and 2021. What is negative or not finite counts as black. Both must cover the
/// same window and hold RGB of Rec.709 primaries.
double hdr_flip(const Picture &a, const Picture &reference);

}  // namespace brume::tool
