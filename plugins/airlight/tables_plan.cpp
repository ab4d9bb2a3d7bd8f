#include "state.h"
#include "tables.h"
#include "uploads.h"

namespace airlight {

brume_status plan_tables(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state)
{
    if (state.parameters.tier == Tier::sun || state.parameters.tier == Tier::fogshop)
        if (brume_status s = upload(services, host, upload_sun_table, 1, brume::airlight::sun_table(), state.sun_table))
            return s;
    if (!state.environment_scatters)
        return BRUME_OK;
    state.environment_order = brume::maths_float::environment_order(scene);
    return upload(services, host, upload_environment_table, 4, brume::airlight::environment_table(),
                  state.environment_table);
}

}  // namespace airlight
