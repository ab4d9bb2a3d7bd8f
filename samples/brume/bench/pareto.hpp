#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace brume::tool {

struct Cost {
    double time = 0, error = 0;
};

/// Of those that nothing else beats: none other is as good in both and better in one. By increasing time; costs that are
/// not finite take no part.
std::vector<std::size_t> pareto_front(std::span<const Cost> costs);

}  // namespace brume::tool
