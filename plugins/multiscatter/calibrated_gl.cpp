// Kernel `calibrated` on GL: shaders/passes/multiscatter_{spread,share,smooth,collect,compose}.comp.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "calibrated.h"
#include "common/uniforms.hpp"

namespace multiscatter {
namespace {

using namespace brume::maths_float;
using namespace brume_uniforms;

class GlPasses : public CalibratedPasses {
public:
    GlPasses(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state), frame_(frame),
          calibrated_(calibrated_of(state, *frame.scene, state.tabled)), size_(state.width, state.height)
    {
    }

    brume_status spread() override
    {
        return run("scatter", state_.spread,
                   {{"color", frame_.color, BRUME_ACCESS_FETCH, 0},
                    {"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"lights", frame_.lights, BRUME_ACCESS_FETCH, 0},
                    {"table", state_.table, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance, BRUME_ACCESS_WRITE, 0},
                    {"coverage", state_.coverage, BRUME_ACCESS_WRITE, 0}},
                   reduction(), state_.base());
    }

    brume_status share(int level) override
    {
        const Level own = level_at(state_, level), finer = level_at(state_, level - 1);
        return run("downsample", state_.share,
                   {{"finer_radiance", level == 1 ? state_.radiance : state_.radiance_stack, BRUME_ACCESS_FETCH, 0},
                    {"finer_coverage", level == 1 ? state_.coverage : state_.coverage_stack, BRUME_ACCESS_FETCH, 0},
                    {"finer_ambient", state_.ambient_stack, BRUME_ACCESS_FETCH, 0},
                    {"table", state_.table, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance_stack, BRUME_ACCESS_WRITE, 0},
                    {"coverage", state_.coverage_stack, BRUME_ACCESS_WRITE, 0},
                    {"ambient", state_.ambient_stack, BRUME_ACCESS_WRITE, 0}},
                   {integer("level", level),
                    {"finer.size", BRUME_UNIFORM_INT, 2, 1, 0, &finer.size},
                    {"finer.extent", BRUME_UNIFORM_FLOAT, 2, 1, 0, &finer.extent},
                    integer("finer.row", finer.row),
                    integer("row", own.row)},
                   own.size);
    }

    brume_status smooth(int level) override
    {
        const Level own = level_at(state_, level);
        return run("smooth", state_.smooth,
                   {{"radiance_stack", state_.radiance_stack, BRUME_ACCESS_FETCH, 0},
                    {"coverage_stack", state_.coverage_stack, BRUME_ACCESS_FETCH, 0},
                    {"table", state_.table, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.smooth_radiance, BRUME_ACCESS_WRITE, 0},
                    {"coverage", state_.smooth_coverage, BRUME_ACCESS_WRITE, 0}},
                   {integer("level", level),
                    {"own.size", BRUME_UNIFORM_INT, 2, 1, 0, &own.size},
                    {"own.extent", BRUME_UNIFORM_FLOAT, 2, 1, 0, &own.extent},
                    integer("own.row", own.row)},
                   own.size);
    }

    // Into the pyramid's level 0, which is not needed any more.
    brume_status collect() override
    {
        return run("collect", state_.collect,
                   {{"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"table", state_.table, BRUME_ACCESS_FETCH, 0},
                    {"radiance_stack", state_.smooth_radiance, BRUME_ACCESS_LINEAR, 0},
                    {"coverage_stack", state_.smooth_coverage, BRUME_ACCESS_LINEAR, 0},
                    {"radiance", state_.radiance, BRUME_ACCESS_WRITE, 0},
                    {"coverage", state_.coverage, BRUME_ACCESS_WRITE, 0}},
                   reduction(), state_.base());
    }

    brume_status compose() override
    {
        const int32_t outputs = int32_t(frame_.outputs);
        return run("compose", state_.compose,
                   {{"color", frame_.color, BRUME_ACCESS_FETCH, 0},
                    {"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"lights", frame_.lights, BRUME_ACCESS_FETCH, 0},
                    {"table", state_.table, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance, BRUME_ACCESS_FETCH, 0},
                    {"coverage", state_.coverage, BRUME_ACCESS_FETCH, 0},
                    {"radiance_stack", state_.smooth_radiance, BRUME_ACCESS_LINEAR, 0},
                    {"coverage_stack", state_.smooth_coverage, BRUME_ACCESS_LINEAR, 0},
                    {"ambient_stack", state_.ambient_stack, BRUME_ACCESS_LINEAR, 0},
                    {"result", frame_.output, BRUME_ACCESS_WRITE, 0},
                    {"transmittance_out", frame_.transmittance, BRUME_ACCESS_WRITE, 0},
                    {"optical_depth_out", frame_.optical_depth, BRUME_ACCESS_WRITE, 0},
                    {"scattered_out", frame_.scattered, BRUME_ACCESS_WRITE, 0},
                    {"blur_radius_out", frame_.blur_radius, BRUME_ACCESS_WRITE, 0}},
                   {integer("outputs", outputs)}, ivec2(state_.width, state_.height));
    }

private:
    std::vector<brume_plugin_uniform> reduction() const
    {
        return {integer("reduction", state_.reduction), {"image_size", BRUME_UNIFORM_INT, 2, 1, 0, &size_}};
    }

    brume_status run(const char *name, brume_program program, std::vector<brume_plugin_binding> bindings,
                     std::vector<brume_plugin_uniform> uniforms, ivec2 grid)
    {
        uniforms.insert(uniforms.end(), {integer("calibrated.top", calibrated_.top),
                                         integer("calibrated.step", calibrated_.step),
                                         integer("calibrated.coverage", calibrated_.coverage),
                                         integer("calibrated.lights", calibrated_.lights),
                                         number("calibrated.first_place", calibrated_.first_place),
                                         number("calibrated.per_reach", calibrated_.per_reach),
                                         {"calibrated.detour", BRUME_UNIFORM_FLOAT, 3, 1, 0, &calibrated_.detour}});
        return run_pass(services_, host_, name, program, std::move(bindings), uniforms, grid.x, grid.y);
    }

    const brume_services &services_;
    brume_host host_;
    const State &state_;
    const brume_plugin_frame &frame_;
    Calibrated calibrated_;
    ivec2 size_;
};

}  // namespace

std::unique_ptr<CalibratedPasses> calibrated_on_gl(const brume_services &services, brume_host host, const State &state,
                                                   const brume_plugin_frame &frame)
{
    return std::make_unique<GlPasses>(services, host, state, frame);
}

brume_status compile_calibrated(const brume_services &services, brume_host host, State &state)
{
    const std::pair<const char *, brume_program *> programs[] = {{"multiscatter_spread.comp", &state.spread},
                                                                 {"multiscatter_share.comp", &state.share},
                                                                 {"multiscatter_smooth.comp", &state.smooth},
                                                                 {"multiscatter_collect.comp", &state.collect}};
    for (auto &[name, program] : programs)
        if (program == &state.collect && state.reduction == 1)
            continue;
        else if (brume_status s = services.compile(host, name, std::string(pass_text(name)).c_str(), "", program))
            return s;
    return BRUME_OK;
}

}  // namespace multiscatter
