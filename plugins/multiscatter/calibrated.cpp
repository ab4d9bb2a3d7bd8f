// Kernel `calibrated`: its plan and the order of its passes.
#include "calibrated.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace multiscatter {

using namespace brume::maths_float;

namespace {

enum Slot : uint32_t { slot_table };

SpreadSource source_of(const State &state, const brume_plugin_scene &scene)
{
    const auto &m = scene.medium;
    auto mean = [&](const float(&v)[3]) {
        return double(v[0]) * m.luminance[0] + double(v[1]) * m.luminance[1] + double(v[2]) * m.luminance[2];
    };
    return {std::max(mean(m.scattering), 1e-30), std::max(mean(m.absorption), 0.0), m.asymmetry,
            std::sqrt(std::max(double(scene.camera.focal[0]) * scene.camera.focal[1], 1e-30)), state.top};
}

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

bool grey(const float (&v)[3])
{
    return v[0] == v[1] && v[1] == v[2];
}

}  // namespace

LevelRows level_rows(const State &state, int level)
{
    const ivec2 base(state.width, state.height);
    return {level_size(base, level), level_size(base, level - 1), level <= 1 ? 0 : level_row(base, level - 1),
            level_row(base, level)};
}

Calibrated calibrated_of(const State &state, const brume_plugin_scene &scene)
{
    const auto &m = scene.medium;
    vec3 detour;
    for (int c = 0; c < 3; ++c)
        detour[c] = float(0.45 * std::pow((1 - double(m.asymmetry)) * m.scattering[c], 1.2));
    return {state.top, state.coverage_channels, state.beside_lights ? int(scene.light_count) : 0,
            float(first_place(state.tabled)), float(std::exp2(-first_place(state.tabled))), detour};
}

brume_status plan_calibrated(const brume_services &services, brume_host host, const brume_plugin_request &request, State &state)
{
    const auto &medium = request.scene->medium;
    state.coverage_channels = !request.animated && grey(medium.scattering) && grey(medium.absorption) ? 1 : 4;
    const ivec2 base(state.width, state.height);
    const int stack_w = level_size(base, 1).x, stack_h = stack_height(state.width, state.height, state.top);
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
    const double pixels = double(state.width) * state.height, texel = 16.0 + 4.0 * channels;
    auto entry = [&](const char *name, const std::string &reason, double bytes, double operations) {
        brume_plugin_entry e{sizeof e, 1, name, reason.c_str(), uint64_t(pixels * bytes), uint64_t(pixels * operations)};
        return services.add_entry(host, &e);
    };
    const std::string levels = "levels 1 to " + std::to_string(state.top);
    for (brume_status s :
         {entry("scatter", "what of each pixel's light arrives scattered", 20 + texel, 150),
          entry("downsample", levels + ": what spreads as far stays, the rest goes on", texel * 5 / 3, 16.0 / 3 * 14),
          entry("smooth", levels + ": no creases between texels", texel * 2 / 3, 9.0 / 3 * 12),
          entry("compose", "collects all levels as far as they lie in front of the pixel, adds what arrives straight",
                36 + texel / 3, 120 + state.top * 60.0)})
        if (s)
            return s;
    return refresh_table(services, host, *request.scene, state);
}

brume_status execute_calibrated(const brume_services &services, brume_host host, State &state, const brume_plugin_frame &frame)
{
    if (brume_status s = refresh_table(services, host, *frame.scene, state))
        return s;
    brume_status status = BRUME_OK;
    const std::unique_ptr<CalibratedPasses> passes = state.compose ? calibrated_on_gl(services, host, state, frame)
                                                                   : calibrated_on_cpu(services, host, state, frame, status);
    if (!status)
        status = passes->spread();
    for (int level = 1; level <= state.top && !status; ++level)
        status = passes->share(level);
    for (int level = state.top; level > std::min(1, state.top - 1) && !status; level -= 2)
        status = passes->smooth(level);
    return status ? status : passes->compose();
}

}  // namespace multiscatter
