#pragma once
#include <brume/brume_plugin.h>

namespace brume {

// The CPU halves of the host's passes; slots as host_products.cpp lists them.
// Of the Gaussians, for this machine's instructions.
brume_rows_function gaussian_density_rows();

// Of the scene's own density, for this machine's instructions.
brume_rows_function density_rows();

// Of a layer; mode: 1 optical depth, 2 transmittance.
template <int mode> brume_status layer_density_rows(const brume_plugin_rows *call, int32_t first, int32_t last);

}  // namespace brume
