#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/options.hpp"

namespace brume::tool {

struct DepthCount {
    std::uint64_t pixels = 0;
    std::uint64_t nan = 0;  ///< these are far as well
    std::uint64_t far = 0;
    std::uint64_t other_sign = 0;      ///< behind the camera for this kind, and not as far as sky is
    std::uint64_t largest_half = 0;    ///< 65504 exactly
    double nearest = 0, farthest = 0;  ///< of what is not far, as stored; 0 where everything is far
};

/// By the rules the library applies: NaN, infinite, not positive or at least `far` is sky. Of depth as it is stored.
DepthCount count_depth(const std::vector<float> &depth, const DepthKind &kind, double far);

/// What a person should know of depth counted so; each starts with a number.
std::vector<std::string> depth_warnings(const DepthCount &count, const DepthKind &kind, double far, SampleType type);

}  // namespace brume::tool
