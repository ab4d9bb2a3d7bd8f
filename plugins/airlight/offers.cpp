// Settings of tier `nodes`, or `maps` where the plan takes those unasked, by what they cost, each with the error that 95 of
// 100 random scenes keep below against tier `reference` (quality_bench). The published tiers know too little of media to be
// offered.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "state.h"

namespace airlight {
namespace {

struct Setting {
    Tier tier;
    double max_error;
    int reduction;
    double error;  // in images of 32 pixels
};

constexpr Setting settings[] = {{Tier::nodes, 0.5, 4, 0.20},   {Tier::nodes, 0.1, 2, 0.10},
                                {Tier::nodes, 0.1, 1, 0.01},   {Tier::nodes, 0.01, 1, 0.0025},
                                {Tier::nodes, 0.001, 1, 8e-4}, {Tier::reference, 0.01, 1, 0}};

}  // namespace

uint32_t offer(const brume_services *, brume_host, const brume_plugin_request *request, uint32_t index, double *parameters,
               double *error)
{
    if (index >= std::size(settings) || (settings[index].tier == Tier::reference && request->backend != BRUME_BACKEND_CPU))
        return 0;
    const Setting &s = settings[index];
    const bool many = s.tier == Tier::nodes && request->scene->gaussian_count > 0;
    choose(parameters, many ? Tier::automatic : s.tier, s.max_error, s.reduction);
    // What is interpolated is as far apart as the images are small.
    const double size = std::max(8, std::min(request->width, request->height));
    *error = s.error * (s.reduction > 1 ? std::sqrt(32 / size) : 1);
    return 1;
}

}  // namespace airlight
