// Kernel `calibrated`: its plan and the order of its passes.
#include "calibrated/passes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace multiscatter {

using namespace brume::maths_float;

namespace {

enum Slot : uint32_t { slot_table, slot_sky };

brume_status refresh_table(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state)
{
    const SpreadSource source = source_of(state, scene);
    if (source == state.tabled)
        return BRUME_OK;
    const std::vector<float> values = spread_values(source);
    if (brume_status s = services.upload(host, slot_table, 1, values.data(), values.size(), &state.table))
        return s;
    state.tabled = source;
    return BRUME_OK;
}

brume_status refresh_sky(const brume_services &services, brume_host host, const brume_plugin_scene &scene, State &state)
{
    if (!state.surrounded || !state.sky.follow(scene, state.size()))
        return BRUME_OK;
    const std::vector<float> &values = state.sky.values();
    return services.upload(host, slot_sky, 4, values.data(), values.size() / 4, &state.sky_image);
}

brume_status plan_passes(const brume_services &services, brume_host host, State &state)
{
    using namespace brume_passes;
    const CalibratedRows &rows = calibrated_rows_of_this_machine();
    auto pass = [&](const char *entry, const char *file, const auto &slots, const std::string &defines,
                    brume_rows_function half, brume_pass &out) {
        return create(services, host, described(entry, slots, calibrated_constants, sizeof(CalibratedConstants)), file,
                      pass_text(file), defines, half, out);
    };
    const std::string layered = define("LAYERED", state.layered);
    for (brume_status s :
         {pass("scatter", "multiscatter_spread.comp", spread_pass::slots, layered, rows.spread, state.spread),
          pass("downsample", "multiscatter_share.comp", share_pass::slots, "", rows.share, state.share),
          pass("smooth", "multiscatter_smooth.comp", smooth_pass::slots, "", rows.smooth, state.smooth),
          state.reduction > 1
              ? pass("collect", "multiscatter_collect.comp", collect_pass::slots, "", rows.collect, state.collect)
              : BRUME_OK,
          pass("compose", "multiscatter_compose.comp", calibrated_compose_pass::slots,
               layered + define("PYRAMID", 2) + define("REDUCTION", state.reduction) + define("SKY", state.surrounded) +
                   define("OUTPUTS", int(state.outputs)),
               rows.compose, state.compose)})
        if (s)
            return s;
    return BRUME_OK;
}

bool grey(const float (&v)[3])
{
    return v[0] == v[1] && v[1] == v[2];
}

}  // namespace

SpreadSource source_of(const State &state, const brume_plugin_scene &scene)
{
    const brume_plugin_medium &m = *scene.medium;
    auto mean = [&](const float(&v)[3]) {
        return double(v[0]) * m.luminance[0] + double(v[1]) * m.luminance[1] + double(v[2]) * m.luminance[2];
    };
    return {std::max(mean(m.scattering), 1e-30),
            std::max(mean(m.absorption), 0.0),
            m.asymmetry,
            std::sqrt(std::max(double(scene.camera->focal[0]) * scene.camera->focal[1], 1e-30)) / state.reduction,
            state.top,
            state.parameters.step};
}

Level level_at(ivec2 size, int reduction, int level)
{
    const ivec2 base = reduced_size(size, reduction);
    const float texel = float(reduction) * float(1 << level);
    return {level_size(base, level), vec2(float(size.x), float(size.y)) / texel, level == 0 ? 0 : level_row(base, level)};
}

Calibrated calibrated_of(const State &state, const brume_plugin_scene &scene, const SpreadSource &tabled,
                         uint32_t visible_lights)
{
    const brume_plugin_medium &m = *scene.medium;
    vec3 detour;
    for (int c = 0; c < 3; ++c)
        detour[c] = float(0.45 * std::pow((1 - double(m.asymmetry)) * m.scattering[c], 1.2));
    return {state.top,
            state.parameters.step,
            state.coverage_channels,
            state.beside_lights ? int(visible_lights) : 0,
            state.beside_all_orders,
            state.surrounded,
            first_sky(scene),
            float(first_place(tabled)),
            float(std::exp2(-first_place(tabled))),
            detour};
}

brume_status plan_calibrated(const brume_services &services, brume_host host, const brume_plugin_request &request,
                             State &state)
{
    const brume_plugin_medium &medium = *request.scene->medium;
    state.coverage_channels = !request.animated && grey(medium.scattering) && grey(medium.absorption) ? 1 : 4;
    const ivec2 base = state.base();
    const int stack_w = level_size(base, 1).x, stack_h = stack_height(base.x, base.y, state.top);
    auto image = [&](const char *label, int width, int height, int channels, brume_plugin_image &out) {
        return services.create_image(host, label, width, height, channels, &out);
    };
    const int channels = state.coverage_channels;
    for (brume_status s : {image("radiance", base.x, base.y, 4, state.radiance),
                           image("radiance levels", stack_w, stack_h, 4, state.radiance_stack),
                           image("coverage", base.x, base.y, channels, state.coverage),
                           image("coverage levels", stack_w, stack_h, channels, state.coverage_stack),
                           image("smooth radiance", stack_w, stack_h, 4, state.smooth_radiance),
                           image("smooth coverage", stack_w, stack_h, channels, state.smooth_coverage),
                           image("surroundings", stack_w, stack_h, 4, state.ambient_stack)})
        if (s)
            return s;
    const double pixels = double(state.width) * state.height, texels = double(base.x) * base.y,
                 texel = 16.0 + 4.0 * channels, colours = channels == 1 ? 1 : 1.3,
                 collecting = colours * 45.0 * (state.top / state.parameters.step),
                 square = 16.0 * state.reduction * state.reduction;
    auto entry = [&](const char *name, const std::string &reason, double bytes, double alike) {
        brume_plugin_entry e{sizeof e, 1, name, reason.c_str(), uint64_t(bytes), 0, uint64_t(alike), 0};
        return services.add_entry(host, &e);
    };
    const std::string levels = "levels 1 to " + std::to_string(state.top),
                      collects = "collects all levels as far as they lie in front of the pixel";
    for (brume_status s : {entry("scatter", "what of each pixel's light arrives scattered", texels * (4 + square + texel),
                                 texels * (110 + square / 4)),
                           entry("downsample", levels + ": what spreads as far stays, the rest goes on",
                                 texels * texel * 5 / 3, texels * 50 * colours),
                           entry("smooth", levels + ": no creases between texels", texels * texel / 3,
                                 texels * 20 / (1 << (2 * state.parameters.step - 2)))})
        if (s)
            return s;
    if (channels == 1) {
        const brume_plugin_entry grey{sizeof grey, 0, "coverage", "grey medium: one channel serves all three", 0, 0, 0, 0};
        if (brume_status s = services.add_entry(host, &grey))
            return s;
    }
    if (state.surrounded) {
        const brume_plugin_entry mean{
            sizeof mean, 0, "surroundings", "the scene's environment is what surrounds the picture", 0, 0, 0, 0};
        if (brume_status s = services.add_entry(host, &mean))
            return s;
    }
    if (state.reduction > 1) {
        if (brume_status s = entry("collect", collects, texels * (4 + texel * 4 / 3), texels * (60 + collecting)))
            return s;
        if (brume_status s = entry("compose", "brings that to every pixel, adds what arrives straight",
                                   pixels * 36 + texels * texel, pixels * 190 * colours))
            return s;
    } else if (brume_status s = entry("compose", collects + ", adds what arrives straight", pixels * (36 + texel / 3),
                                      pixels * (110 + collecting))) {
        return s;
    }
    if (brume_status s = refresh_table(services, host, *request.scene, state))
        return s;
    if (brume_status s = refresh_sky(services, host, *request.scene, state))
        return s;
    return plan_passes(services, host, state);
}

brume_status execute_calibrated(const brume_services &services, brume_host host, State &state,
                                const brume_plugin_frame &frame)
{
    if (brume_status s = refresh_table(services, host, *frame.scene, state))
        return s;
    if (brume_status s = refresh_sky(services, host, *frame.scene, state))
        return s;
    const brume_plugin_product &visible = brume::products_in(frame)[use_visible_lights];
    const brume_plugin_image density = image_of(frame, use_density), density_rgb = image_of(frame, use_density_rgb),
                             lights = image_of(frame, use_visible_lights);
    CalibratedConstants constants{
        calibrated_of(state, *frame.scene, state.tabled, visible.count), state.reduction, state.size(), 0, {}, {}};
    auto run = [&](brume_pass pass, const auto &images, ivec2 grid) {
        return services.run(host, pass, images, &constants, grid.x, grid.y, nullptr);
    };
    auto at_level = [&](int level) {
        constants.level = level;
        constants.own = level_at(state.size(), state.reduction, level);
        constants.finer = level_at(state.size(), state.reduction, level - 1);
    };

    const brume_plugin_image spread[] = {frame.color, density,        density_rgb,   lights,
                                         state.table, state.radiance, state.coverage};
    if (brume_status s = run(state.spread, spread, state.base()))
        return s;
    for (int level = 1; level <= state.top; ++level) {
        at_level(level);
        const bool first = level == 1;
        const brume_plugin_image share[] = {first ? state.radiance : state.radiance_stack,
                                            first ? state.coverage : state.coverage_stack,
                                            state.ambient_stack,
                                            state.table,
                                            state.radiance_stack,
                                            state.coverage_stack,
                                            state.ambient_stack};
        if (brume_status s = run(state.share, share, constants.own.size))
            return s;
    }
    const int step = state.parameters.step;
    for (int level = state.top; level >= std::min(step, state.top); level -= step) {
        at_level(level);
        const brume_plugin_image smooth[] = {state.radiance_stack, state.coverage_stack, state.table, state.smooth_radiance,
                                             state.smooth_coverage};
        if (brume_status s = run(state.smooth, smooth, constants.own.size))
            return s;
    }
    if (state.reduction > 1) {
        // Into the pyramid's level 0, which is not needed any more.
        const brume_plugin_image collect[] = {density,        state.table,   state.smooth_radiance, state.smooth_coverage,
                                              state.radiance, state.coverage};
        if (brume_status s = run(state.collect, collect, state.base()))
            return s;
    }
    const brume_plugin_image compose[] = {frame.color,
                                          density,
                                          density_rgb,
                                          lights,
                                          state.table,
                                          state.radiance,
                                          state.coverage,
                                          state.smooth_radiance,
                                          state.smooth_coverage,
                                          state.ambient_stack,
                                          state.sky_image,
                                          frame.output,
                                          frame.layers[layer_transmittance].image,
                                          frame.layers[layer_optical_depth].image,
                                          frame.layers[layer_scattered].image,
                                          frame.layers[layer_blur_radius].image};
    return run(state.compose, compose, state.size());
}

}  // namespace multiscatter
