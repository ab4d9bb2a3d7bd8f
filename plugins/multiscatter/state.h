#pragma once
#include <memory>
#include <vector>

#include <brume/brume_plugin.h>

#include "parameters.h"
#include "scene_maths.hpp"
#include "spread.h"

namespace multiscatter {

// What one plan of this effect holds. Images that a plan does not need are NULL.
struct State {
    Parameters parameters;
    int width = 0;
    int height = 0;
    int reduction = 1;  // kernel calibrated: side of the square of pixels that is one texel of the pyramid's level 0
    int top = 0;        // K; 0: no pyramid
    bool beside_lights = false;  // another effect adds what the lights scatter once

    // Level 0 of a pyramid and, stacked, its levels 1 to K.
    brume_plugin_image radiance = nullptr;  // RGB: L_sc, A: W
    brume_plugin_image radiance_stack = nullptr;
    brume_plugin_image spread_stack = nullptr;  // W blurred; its level 0 is radiance's A
    brume_plugin_image separated = nullptr;     // RGB: L_ssc, A: W
    brume_plugin_image separated_stack = nullptr;

    // Kernel `calibrated` (shaders/lib/calibrated.glsl), beside radiance and radiance_stack.
    int coverage_channels = 0;
    brume_plugin_image coverage = nullptr;
    brume_plugin_image coverage_stack = nullptr;
    brume_plugin_image smooth_radiance = nullptr;  // levels 1 to K, smoothed
    brume_plugin_image smooth_coverage = nullptr;
    brume_plugin_image ambient_stack = nullptr;  // the surroundings, levels 1 to K
    brume_plugin_image table = nullptr;
    SpreadSource tabled;  // what `table` was made of

    brume::maths_float::ivec2 base() const { return brume::maths_float::reduced_size({width, height}, reduction); }

    // GL programs; NULL on the CPU.
    brume_program spread = nullptr;
    brume_program share = nullptr;
    brume_program smooth = nullptr;
    brume_program collect = nullptr;  // NULL unless reduction > 1
    brume_program scatter = nullptr;
    brume_program downsample = nullptr;
    brume_program compose = nullptr;
};

// The passes of kernel `paper` on either backend, and of the references on the CPU. They return the first failure.
brume_status execute_cpu(const brume_services &services, brume_host host, const State &state,
                         const brume_plugin_frame &frame);
brume_status execute_gl(const brume_services &services, brume_host host, const State &state,
                        const brume_plugin_frame &frame);
brume_status execute_reference(const brume_services &services, brume_host host, const State &state,
                               const brume_plugin_frame &frame);

// Kernel `calibrated`.
brume_status plan_calibrated(const brume_services &services, brume_host host, const brume_plugin_request &request,
                             State &state);
brume_status execute_calibrated(const brume_services &services, brume_host host, State &state,
                                const brume_plugin_frame &frame);
brume_status compile_calibrated(const brume_services &services, brume_host host, State &state);

// As brume_effect.
uint32_t offer(const brume_plugin_request *request, uint32_t index, double *parameters, double *error);

brume_status compile_programs(const brume_services &services, brume_host host, uint32_t outputs, State &state);

// What of BRUME_OUTPUT_... this effect fills.
constexpr uint32_t own_outputs =
    BRUME_OUTPUT_TRANSMITTANCE | BRUME_OUTPUT_OPTICAL_DEPTH | BRUME_OUTPUT_SCATTERED | BRUME_OUTPUT_BLUR_RADIUS;

// The filter of one frame: its K is the plan's, or the level of the widest blur that the frame's medium and camera allow.
brume::maths_float::Filter filter_of(const State &state, const brume_plugin_scene &scene);

// Rows of the image that holds levels 1 to K.
int stack_height(int width, int height, int top);

}  // namespace multiscatter
