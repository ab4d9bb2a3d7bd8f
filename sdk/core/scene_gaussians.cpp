#include "core/scene.h"

namespace brume {

void evaluate_gaussians(const Scene &, double, const std::array<double, 16> &, std::vector<brume_plugin_gaussian> &out)
{
    out.clear();
}

}  // namespace brume
