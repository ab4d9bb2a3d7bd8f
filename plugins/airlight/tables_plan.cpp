#include <cmath>

#include "passes.h"
#include "tables.h"

namespace airlight {

brume_status plan_tables(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state)
{
    auto upload = [&](Slot slot, int32_t channels, const std::vector<float> &values, brume_plugin_image &out) {
        return services.upload(host, slot, channels, values.data(), values.size() / size_t(channels), &out);
    };
    if (state.parameters.tier == Tier::sun || state.parameters.tier == Tier::fogshop)
        if (brume_status s = upload(slot_sun_table, 1, brume::airlight::sun_table(), state.sun_table))
            return s;
    if (scene.environment_count == 0)
        return BRUME_OK;
    state.environment_order = int(std::lround(std::sqrt(double(scene.environment_count))));
    std::vector<float> coefficients;
    for (uint32_t i = 0; i < scene.environment_count; ++i)
        coefficients.insert(coefficients.end(), {scene.environment[i][0], scene.environment[i][1], scene.environment[i][2], 0.0f});
    if (brume_status s = upload(slot_environment, 4, coefficients, state.environment))
        return s;
    return upload(slot_environment_table, 4, brume::airlight::environment_table(), state.environment_table);
}

}  // namespace airlight
