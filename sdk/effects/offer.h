#pragma once
#include <vector>

namespace brume {

// Settings of an effect among which quality chooses.
struct Offer {
    std::vector<double> parameters;  // all of the effect's
    double error = 0;                // predicted; 0: the effect's reference
};

}  // namespace brume
