#include "plan/combinations.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace brume {

std::vector<Combination> with_each(const std::vector<Combination> &combinations, const std::vector<Option> &options)
{
    std::vector<Combination> all;
    for (const Combination &combination : combinations)
        for (const Option &option : options) {
            Combination &next = all.emplace_back(combination);
            next.options.push_back(&option);
            next.error = std::hypot(combination.error, option.offer.error);
            next.operations += option.operations;
            next.ms += option.ms;
        }
    // In this order whatever is no worse than one stands before it.
    std::stable_sort(all.begin(), all.end(), [](const Combination &a, const Combination &b) {
        return std::tie(a.operations, a.error, a.ms) < std::tie(b.operations, b.error, b.ms);
    });
    std::vector<Combination> front;
    for (Combination &c : all)
        if (std::none_of(front.begin(), front.end(), [&](const Combination &f) {
                return f.operations <= c.operations && f.error <= c.error && f.ms <= c.ms;
            }))
            front.push_back(std::move(c));
    return front;
}

}  // namespace brume
