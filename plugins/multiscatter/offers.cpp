// Settings of kernel `calibrated` by what they cost (more lobes cost more and are not reliably better), each with the error
// that 95 of 100 random scenes keep below against kernel `reference` (quality_bench).
#include <algorithm>
#include <cmath>

#include "state.h"

namespace multiscatter {
namespace {

struct Setting {
    Kernel kernel;
    int step, reduction;
    double error;  // of a dense isotropic medium and an image of 64 pixels of detail 1
};

constexpr Setting settings[] = {{Kernel::calibrated, 2, 4, 0.25},
                                {Kernel::calibrated, 2, 2, 0.19},
                                {Kernel::calibrated, 2, 1, 0.12},
                                {Kernel::reference, 2, 1, 0}};

// What rounding leaves where nothing is approximated.
constexpr double rounding = 1e-6;

bool scatters(const brume_plugin_medium &m)
{
    return m.scattering[0] > 0 || m.scattering[1] > 0 || m.scattering[2] > 0;
}

}  // namespace

uint32_t offer(const brume_services *services, brume_host host, const brume_plugin_request *request, uint32_t index,
               double *parameters, double *error)
{
    const brume_plugin_medium &medium = *request->scene->medium;
    if (!scatters(medium)) {
        *error = rounding;
        return index == 0;
    }
    if (index >= std::size(settings) ||
        (settings[index].kernel == Kernel::reference && request->backend != BRUME_BACKEND_CPU))
        return 0;
    const Setting &s = settings[index];
    choose(parameters, s.kernel, s.step, s.reduction);
    // Less is scattered in thin media, and forward-scattering ones keep it where levels follow it less well; smooth images
    // hide what large ones have room for.
    const double scattered = 1 - std::clamp(request->transmittance, 0.0, 1.0),
                 size = std::max(8, std::min(request->width, request->height)),
                 detail = request->detail > 0 ? request->detail : 5;
    *error = s.error * std::pow(scattered + 0.003, 0.75) * std::sqrt(detail * 64 / size) *
             std::pow(1.2 - std::max(0.0f, medium.asymmetry), -0.2);
    // Part of what would be scattered is another effect's.
    if (services->made(host, "single_scattering") != BRUME_MADE_NOWHERE && request->scene->light_count > 0)
        *error *= 0.7;
    return 1;
}

}  // namespace multiscatter
