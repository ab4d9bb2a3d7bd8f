#pragma once
#include "state.h"

namespace airlight {

// At planning: the tables that the tier reads.
brume_status plan_tables(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state);
brume_status compile_programs(const brume_services &services, brume_host host, uint32_t outputs, State &state);

// Per frame, both backends: which Gaussians shadow what, refreshed when something moved.
brume_status refresh_lists(const brume_services &services, brume_host host, const brume_plugin_frame &frame, State &state);

brume_status execute_cpu(const brume_services &services, brume_host host, State &state, const brume_plugin_frame &frame);
brume_status execute_gl(const brume_services &services, brume_host host, State &state, const brume_plugin_frame &frame);

}  // namespace airlight
