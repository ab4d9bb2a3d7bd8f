#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/sequence.hpp"

namespace brume::tool {

struct SweepOptions {
    FogOptions fog;
    ColorRequest spaces;
    std::string input, output, output_type, transmittance;
    std::vector<std::string> vary;
    std::uint64_t seed = 1;
    int count = 1;
};

/// One picture in fogs that are drawn by seed, a line of JSON on standard output for each when it is written. Returns the
/// exit status; throws RequestError while nothing has been written.
int run_sweep(const SweepOptions &options);

}  // namespace brume::tool
