#include "bench/pareto.hpp"

#include <algorithm>
#include <cmath>

namespace brume::tool {

std::vector<std::size_t> pareto_front(std::span<const Cost> costs)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < costs.size(); ++i)
        if (std::isfinite(costs[i].time) && std::isfinite(costs[i].error))
            order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return costs[a].time != costs[b].time ? costs[a].time < costs[b].time : costs[a].error < costs[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order) {
        const Cost *best = front.empty() ? nullptr : &costs[front.back()];
        if (!best || costs[i].error < best->error || (costs[i].error == best->error && costs[i].time == best->time))
            front.push_back(i);
    }
    return front;
}

}  // namespace brume::tool
