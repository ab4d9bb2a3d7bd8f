#pragma once

#include <span>
#include <vector>

#include "metrics/metrics.hpp"

namespace brume::tool {

/// What a fog that knows one number a pixel has at hand.
struct BaselineInput {
    Picture image;
    std::vector<float> transmittance;  ///< e^-tau, tau being the mean of the channels' optical depths by luminance
    double focal = 1;                  ///< distance of the image plane, in heights of a pixel
};

struct Baseline {
    const char *name, *what;
    void (*apply)(const BaselineInput &, Picture &out);  ///< `out` is as large as the image
};

/// What is done without this library, as points to compare with. On the CPU.
std::span<const Baseline> baselines();

}  // namespace brume::tool
