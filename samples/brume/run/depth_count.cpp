#include "run/depth_count.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

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
    count.pixels = depth.size();
    const double sign = kind.type == DepthKind::kNegative ? -1 : 1;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const float stored : depth) {
        const double z = sign * double(stored);
        count.nan += std::isnan(z);
        count.other_sign += z < 0 && z > -far;
        count.largest_half += z == 65504;
        if (is_far(z, kind, far) || std::isinf(z)) {
            ++count.far;
            continue;
        }
        low = std::min(low, z);
        high = std::max(high, z);
    }
    if (low <= high) {
        count.nearest = sign * low;
        count.farthest = sign * high;
    }
    return count;
}

std::vector<std::string> depth_warnings(const DepthCount &count, const DepthKind &kind, double far, SampleType type)
{
    std::vector<std::string> warnings;
    const bool distance =
        kind.type == DepthKind::kPlanar || kind.type == DepthKind::kRay || kind.type == DepthKind::kNegative;
    if (count.nan > 0)
        warnings.push_back(fmt::format("{} pixels have NaN depth and count as far", count.nan));
    if (distance && 2 * count.other_sign > count.pixels)
        warnings.push_back(fmt::format("{} of {} pixels have a {} depth and count as {}: {}", count.other_sign, count.pixels,
                                       kind.type == DepthKind::kNegative ? "positive" : "negative",
                                       kind.zero_is_near ? "near" : "far",
                                       kind.type == DepthKind::kNegative
                                           ? "expected negative ones with --depth-kind negative"
                                           : "where depth runs down from 0, as Fusion's, --depth-kind negative is right"));
    else if (20 * count.far >= 19 * count.pixels && count.far > 0)
        warnings.push_back(fmt::format("{} of {} pixels count as far (sky from {:g} on): is that depth, of this kind?",
                                       count.far, count.pixels, far));
    if (distance && type == SampleType::kHalf && count.largest_half > 0 && far > 65504)
        warnings.push_back(
            fmt::format("{} pixels have the depth 65504, the largest of a half: what is farther is stored so, "
                        "and --far 65504 makes it sky",
                        count.largest_half));
    return warnings;
}

}  // namespace brume::tool
