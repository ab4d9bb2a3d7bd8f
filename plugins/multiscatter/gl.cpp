// Kernel `paper` on GL: the passes of shaders/passes/multiscatter_*.comp.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrated.h"
#include "common/uniforms.hpp"

namespace multiscatter {

using namespace brume::maths_float;
using namespace brume_uniforms;

namespace {

// `uniform Filter multiscatter`, member by member.
std::vector<brume_plugin_uniform> filter_uniforms(const Filter &f)
{
    return {integer("multiscatter.top", f.top),
            integer("multiscatter.fetch", f.fetch),
            integer("multiscatter.masking", f.masking),
            integer("multiscatter.density_blurring", f.density_blurring),
            integer("multiscatter.separation", f.separation),
            integer("multiscatter.placement", f.placement),
            integer("multiscatter.lights", f.lights),
            number("multiscatter.scale", f.scale),
            number("multiscatter.mask_width", f.mask_width),
            number("multiscatter.bright", f.bright),
            number("multiscatter.bright_width", f.bright_width),
            number("multiscatter.dense", f.dense),
            number("multiscatter.dense_width", f.dense_width),
            number("multiscatter.separation_level", f.separation_level)};
}

class Frame {
public:
    Frame(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state), frame_(frame), filter_(filter_of(state, *frame.scene))
    {
    }

    brume_status execute()
    {
        if (state_.top > 0) {
            if (brume_status s = scatter())
                return s;
            for (int level = 1; level <= filter_.top; ++level)
                if (brume_status s = downsample(level))
                    return s;
        }
        return compose();
    }

private:
    brume_status run(const char *name, brume_program program, std::vector<brume_plugin_binding> bindings,
                     std::vector<brume_plugin_uniform> uniforms, ivec2 grid)
    {
        auto filter = filter_uniforms(filter_);
        uniforms.insert(uniforms.end(), filter.begin(), filter.end());
        return run_pass(services_, host_, name, program, std::move(bindings), uniforms, grid.x, grid.y);
    }

    brume_status scatter()
    {
        return run("scatter", state_.scatter,
                   {{"color", frame_.color, BRUME_ACCESS_FETCH, 0},
                    {"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"lights", frame_.lights, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance, BRUME_ACCESS_WRITE, 0},
                    {"separated", state_.separated, BRUME_ACCESS_WRITE, 0}},
                   {}, {state_.width, state_.height});
    }

    brume_status downsample(int level)
    {
        ivec2 base(state_.width, state_.height);
        ivec2 size = level_size(base, level), finer_size = level_size(base, level - 1);
        int32_t rows[2] = {level == 1 ? 0 : level_row(base, level - 1), level_row(base, level)};
        int32_t channel = level == 1 ? 3 : 0;
        bool first = level == 1;
        return run("downsample", state_.downsample,
                   {{"finer_radiance", first ? state_.radiance : state_.radiance_stack, BRUME_ACCESS_FETCH, 0},
                    {"finer_spread", first ? state_.radiance : state_.spread_stack, BRUME_ACCESS_FETCH, 0},
                    {"finer_separated", first ? state_.separated : state_.separated_stack, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance_stack, BRUME_ACCESS_WRITE, 0},
                    {"spread", state_.spread_stack, BRUME_ACCESS_WRITE, 0},
                    {"separated", state_.separated_stack, BRUME_ACCESS_WRITE, 0}},
                   {integer("level", level),
                    {"finer_size", BRUME_UNIFORM_INT, 2, 1, 0, &finer_size},
                    {"rows", BRUME_UNIFORM_INT, 2, 1, 0, rows},
                    integer("spread_channel", channel)},
                   size);
    }

    brume_status compose()
    {
        int32_t outputs = int32_t(frame_.outputs);
        return run("compose", state_.compose,
                   {{"color", frame_.color, BRUME_ACCESS_FETCH, 0},
                    {"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance, BRUME_ACCESS_LINEAR, 0},
                    {"radiance_stack", state_.radiance_stack, BRUME_ACCESS_LINEAR, 0},
                    {"spread_stack", state_.spread_stack, BRUME_ACCESS_LINEAR, 0},
                    {"separated", state_.separated, BRUME_ACCESS_LINEAR, 0},
                    {"separated_stack", state_.separated_stack, BRUME_ACCESS_LINEAR, 0},
                    {"result", frame_.output, BRUME_ACCESS_WRITE, 0},
                    {"transmittance_out", frame_.transmittance, BRUME_ACCESS_WRITE, 0},
                    {"optical_depth_out", frame_.optical_depth, BRUME_ACCESS_WRITE, 0},
                    {"scattered_out", frame_.scattered, BRUME_ACCESS_WRITE, 0},
                    {"blur_radius_out", frame_.blur_radius, BRUME_ACCESS_WRITE, 0}},
                   {integer("outputs", outputs)}, {state_.width, state_.height});
    }

    const brume_services &services_;
    brume_host host_;
    const State &state_;
    const brume_plugin_frame &frame_;
    Filter filter_;
};

}  // namespace

brume_status compile_programs(const brume_services &services, brume_host host, uint32_t outputs, State &state)
{
    auto compile = [&](const char *name, const std::string &defines, brume_program &out) {
        std::string source(pass_text(name));
        return services.compile(host, name, source.c_str(), defines.c_str(), &out);
    };
    auto define = [](const char *name, uint32_t value) {
        return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
    };
    if (state.table) {
        if (brume_status s = compile_calibrated(services, host, state))
            return s;
    } else if (state.top > 0) {
        if (brume_status s = compile("multiscatter_scatter.comp", "", state.scatter))
            return s;
        if (brume_status s =
                compile("multiscatter_downsample.comp",
                        define("TAPS", uint32_t(state.parameters.taps)) + define("BLURRING", state.spread_stack != nullptr) +
                            define("SEPARATION", state.separated != nullptr),
                        state.downsample))
            return s;
    }
    return compile("multiscatter_compose.comp",
                   define("PYRAMID", state.top == 0 ? 0
                                     : state.table  ? 2
                                                    : 1) +
                       define("REDUCTION", uint32_t(state.reduction)) + define("OUTPUTS", outputs & own_outputs),
                   state.compose);
}

brume_status execute_gl(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
{
    return Frame(services, host, state, frame).execute();
}

}  // namespace multiscatter
