#pragma once
#include <vector>

#include "effects/offer.h"

namespace brume {

// One offer of one effect, and what the effect's passes cost with it.
struct Option {
    Offer offer;
    double operations = 0;
    double ms = 0;
};

// An option of each effect so far. Their errors add as independent ones do.
struct Combination {
    std::vector<const Option *> options;
    double error = 0, operations = 0, ms = 0;
};

// Each combination with each option of one more effect, without those that another is no worse than in error, operations and
// milliseconds: what comes after adds the same to both. Of equals the first stays. The options are referred to.
std::vector<Combination> with_each(const std::vector<Combination> &combinations, const std::vector<Option> &options);

}  // namespace brume
