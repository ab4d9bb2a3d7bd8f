#pragma once
// One group out of several pictures' groups: geometric means of errors, medians of times.
#include "bench/measure.hpp"

namespace trade {

// A setting that some picture refuses has no mean over all: it counts as refused. The reference's width is the smallest.
brume::tool::Group aggregated(const std::vector<brume::tool::Group> &groups);

}  // namespace trade
