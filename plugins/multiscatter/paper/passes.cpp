// Kernel `paper`: its passes and their order.
#include "paper/passes.h"

#include <string>

namespace multiscatter {

using namespace brume::maths_float;
using namespace brume_passes;

brume_status plan_paper_passes(const brume_services &services, brume_host host, State &state)
{
    auto pass = [&](const char *entry, const char *file, const auto &slots, const std::string &defines,
                    brume_rows_function half, brume_pass &out) {
        return create(services, host, described(entry, slots, paper_constants, sizeof(PaperConstants)), file,
                      pass_text(file), defines, half, out);
    };
    const std::string layered = define("LAYERED", state.layered);
    if (state.top > 0) {
        if (brume_status s = pass("scatter", "multiscatter_scatter.comp", scatter_pass::slots, layered, paper_scatter_rows,
                                  state.scatter))
            return s;
        if (brume_status s = pass("downsample", "multiscatter_downsample.comp", downsample_pass::slots,
                                  define("TAPS", state.parameters.taps) + define("BLURRING", state.spread_stack != nullptr) +
                                      define("SEPARATION", state.separated != nullptr),
                                  paper_downsample_rows, state.downsample))
            return s;
    }
    return pass("compose", "multiscatter_compose.comp", paper_compose_pass::slots,
                layered + define("PYRAMID", state.top > 0) + define("REDUCTION", 1) + define("SKY", 0) +
                    define("OUTPUTS", int(state.outputs)),
                paper_compose_rows, state.compose);
}

brume_status execute_paper(const brume_services &services, brume_host host, const State &state,
                           const brume_plugin_frame &frame)
{
    const brume_plugin_image density = image_of(frame, use_density), density_rgb = image_of(frame, use_density_rgb),
                             gaussian_density = image_of(frame, use_gaussian_density),
                             lights = image_of(frame, use_visible_lights);
    const uint32_t visible = brume::products_in(frame)[use_visible_lights].count;
    PaperConstants constants{filter_of(state, *frame.scene, visible), 0, {}, {}, 0, state.parameters.taps};
    if (state.top == 0)
        constants.multiscatter.top = 0;
    auto run = [&](brume_pass pass, const auto &images, ivec2 grid) {
        return services.run(host, pass, images, &constants, grid.x, grid.y, nullptr);
    };
    const ivec2 base = state.size();
    if (state.top > 0) {
        const brume_plugin_image scatter[] = {frame.color, density,        density_rgb,    gaussian_density,
                                              lights,      state.radiance, state.separated};
        if (brume_status s = run(state.scatter, scatter, base))
            return s;
    }
    for (int level = 1; state.top > 0 && level <= constants.multiscatter.top; ++level) {
        const bool first = level == 1;
        constants.level = level;
        constants.finer_size = level_size(base, level - 1);
        constants.rows = ivec2(first ? 0 : level_row(base, level - 1), level_row(base, level));
        constants.spread_channel = first ? 3 : 0;
        const brume_plugin_image downsample[] = {first ? state.radiance : state.radiance_stack,
                                                 first ? state.radiance : state.spread_stack,
                                                 first ? state.separated : state.separated_stack,
                                                 state.radiance_stack,
                                                 state.spread_stack,
                                                 state.separated_stack};
        if (brume_status s = run(state.downsample, downsample, level_size(base, level)))
            return s;
    }
    const brume_plugin_image compose[] = {frame.color,
                                          density,
                                          density_rgb,
                                          gaussian_density,
                                          state.radiance,
                                          state.radiance_stack,
                                          state.spread_stack,
                                          state.separated,
                                          state.separated_stack,
                                          frame.output,
                                          frame.layers[layer_transmittance].image,
                                          frame.layers[layer_optical_depth].image,
                                          frame.layers[layer_scattered].image,
                                          frame.layers[layer_blur_radius].image};
    return run(state.compose, compose, base);
}

}  // namespace multiscatter
