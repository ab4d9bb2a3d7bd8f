#pragma once
#include <vector>

#include "state.h"

namespace airlight {

inline brume_status upload(const brume_services &services, brume_host host, Upload slot, int32_t channels,
                           const std::vector<float> &values, brume_plugin_image &out)
{
    return services.upload(host, slot, channels, values.data(), values.size() / size_t(channels), &out);
}

}  // namespace airlight
