#include "run/depth_count.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brume::tool {
namespace {

bool is_far(double z, const DepthKind &kind, double far)
{
    switch (kind.type) {
    case DepthKind::kInverse:
        return !(z > 0) || 1 / z >= far;
    case DepthKind::kNormalized:
        return !(z >= 0) || z >= 1 || kind.near + z * (kind.far - kind.near) >= far;
    default:
        return !(z > 0 || (kind.zero_is_near && z <= 0)) || z >= far;
    }
}

}  // namespace

DepthCount count_depth(const std::vector<float> &depth, const DepthKind &kind, double far)
{
    DepthCount count;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const float z : depth) {
        count.nan += std::isnan(z);
        if (is_far(z, kind, far) || std::isinf(z)) {
            ++count.far;
            continue;
        }
        low = std::min(low, double(z));
        high = std::max(high, double(z));
    }
    if (low <= high) {
        count.nearest = low;
        count.farthest = high;
    }
    return count;
}

}  // namespace brume::tool
