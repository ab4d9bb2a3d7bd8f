#pragma once

#include <cstdint>
#include <vector>

#include "commands/options.hpp"

namespace brume::tool {

struct DepthCount {
    std::uint64_t nan = 0;  ///< these are far as well
    std::uint64_t far = 0;
    double nearest = 0, farthest = 0;  ///< of what is not far, as stored; 0 where everything is far
};

/// By the rules the library applies: NaN, infinite, not positive or at least `far` is sky.
DepthCount count_depth(const std::vector<float> &depth, const DepthKind &kind, double far);

}  // namespace brume::tool
