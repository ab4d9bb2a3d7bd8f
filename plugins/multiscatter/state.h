#pragma once
#include <string_view>

#include <brume/brume_plugin.h>

#include "calibrated/sky.h"
#include "calibrated/spread.h"
#include "parameters.h"
#include "scene_maths.hpp"

namespace multiscatter {

// The effect's layers and products, in the order of its tables.
enum Layer : uint32_t { layer_transmittance, layer_optical_depth, layer_scattered, layer_blur_radius, layer_count };
enum Use : uint32_t { use_density, use_density_rgb, use_gaussian_density, use_visible_lights, use_count };

// What one plan of this effect holds. Images and passes that a plan does not need are NULL.
struct State {
    Parameters parameters;
    int width = 0;
    int height = 0;
    int reduction = 1;  // kernel calibrated: side of the square of pixels that is one texel of the pyramid's level 0
    int top = 0;        // K; 0: no pyramid
    bool beside_lights = false;      // another effect adds what the lights scatter once,
    bool beside_all_orders = false;  // or all of it
    bool layered = false;            // each colour has a density of its own: product density_rgb
    uint32_t outputs = 0;            // bits by Layer

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
    SpreadSource tabled;      // what `table` was made of
    bool surrounded = false;  // the scene's environment surrounds the picture, kernel reference's too
    Sky sky;
    brume_plugin_image sky_image = nullptr;

    brume_pass spread = nullptr, share = nullptr, smooth = nullptr, collect = nullptr;  // of kernel calibrated
    brume_pass scatter = nullptr, downsample = nullptr;                                 // of kernel paper
    brume_pass find_sources = nullptr;                                                  // of the references
    brume_pass compose = nullptr;

    brume::maths_float::ivec2 size() const { return {width, height}; }
    brume::maths_float::ivec2 base() const { return brume::maths_float::reduced_size(size(), reduction); }
};

// An image of a product that may have none.
inline brume_plugin_image image_of(const brume_plugin_frame &frame, Use use)
{
    const brume_plugin_product &product = brume::products_in(frame)[use];
    return product.image_count ? product.images[0] : nullptr;
}

std::string_view pass_text(std::string_view name);

// Each kernel's plan adds its passes after its images are there. They return the first failure.
brume_status plan_calibrated(const brume_services &services, brume_host host, const brume_plugin_request &request,
                             State &state);
brume_status execute_calibrated(const brume_services &services, brume_host host, State &state,
                                const brume_plugin_frame &frame);

// Kernel `paper`; also what is left of a plan that has no pyramid.
brume_status plan_paper_passes(const brume_services &services, brume_host host, State &state);
brume_status execute_paper(const brume_services &services, brume_host host, const State &state,
                           const brume_plugin_frame &frame);

// Kernels `reference` and `paper_reference`.
brume_status plan_reference_passes(const brume_services &services, brume_host host, State &state);
brume_status execute_reference(const brume_services &services, brume_host host, const State &state,
                               const brume_plugin_frame &frame);

// As brume_effect.
uint32_t offer(const brume_services *services, brume_host host, const brume_plugin_request *request, uint32_t index,
               double *parameters, double *error);

// The filter of one frame: its K is the plan's, or the level of the widest blur that the frame's medium and camera allow.
// visible_lights: how many.
brume::maths_float::Filter filter_of(const State &state, const brume_plugin_scene &scene, uint32_t visible_lights);

// Rows of the image that holds levels 1 to K.
int stack_height(int width, int height, int top);

}  // namespace multiscatter
