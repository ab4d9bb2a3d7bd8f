#include "core/scene.h"

namespace brume {

void evaluate_lights(const Scene &, double, const std::array<double, 16> &, std::vector<brume_plugin_light> &out)
{
    out.clear();
}

}  // namespace brume
