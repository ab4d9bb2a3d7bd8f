// The effect on GL: the passes of shaders/passes/airlight_*.comp.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/uniforms.hpp"
#include "passes.h"
#include "settings.h"

namespace airlight {

std::string_view pass_text(std::string_view name);

namespace {

using namespace brume::maths_float;
using namespace brume_uniforms;

brume_plugin_uniform pair(const char *name, const ivec2 &value)
{
    return {name, BRUME_UNIFORM_INT, 2, 1, 0, &value};
}

// `uniform AirlightSettings airlight`, member by member.
std::vector<brume_plugin_uniform> settings_uniforms(const AirlightSettings &s)
{
    return {integer("airlight.environment_order", s.environment_order),
            integer("airlight.light_count", s.light_count),
            integer("airlight.gaussian_count", s.gaussian_count),
            integer("airlight.panels", s.panels),
            integer("airlight.dense_from", s.dense_from),
            integer("airlight.cells", s.cells),
            number("airlight.tolerance", s.tolerance),
            number("airlight.near_radii", s.near_radii),
            number("airlight.culled", s.culled),
            integer("airlight.orders", s.orders),
            {"airlight.ground", BRUME_UNIFORM_FLOAT, 4, 1, 0, &s.ground}};
}

class GlPasses : public Passes {
public:
    GlPasses(const brume_services &services, brume_host host, const State &state, const brume_plugin_frame &frame)
        : services_(services), host_(host), state_(state), frame_(frame), settings_(settings_of(state, *frame.scene))
    {
    }

    brume_status blobs() override
    {
        const int values = settings_.gaussian_count * (1 + settings_.light_count);
        return run("blobs", state_.blobs,
                   {{"gaussians", frame_.gaussians, BRUME_ACCESS_FETCH, 0},
                    {"lights", frame_.lights, BRUME_ACCESS_FETCH, 0},
                    {"cells", state_.cells, BRUME_ACCESS_FETCH, 0},
                    {"cell_gaussians", state_.cell_gaussians, BRUME_ACCESS_FETCH, 0},
                    {"shadow_origins", state_.origins, BRUME_ACCESS_FETCH, 0},
                    {"density", state_.blob_density, BRUME_ACCESS_WRITE, 0}},
                   settings_uniforms(settings_), {BRUME_DATA_WIDTH, (values + BRUME_DATA_WIDTH - 1) / BRUME_DATA_WIDTH});
    }

    brume_status gather(const Gathering &to) override
    {
        AirlightSettings settings = settings_;
        if (!to.environment)
            settings.environment_order = 0;
        const ivec2 light_range(to.first_light, to.last_light);
        const int32_t reduction = to.reduction;
        const ivec2 size(state_.width, state_.height);
        auto uniforms = settings_uniforms(settings);
        uniforms.push_back(pair("size", size));
        uniforms.push_back(pair("light_range", light_range));
        uniforms.push_back(integer("reduction", reduction));
        return run("gather", state_.gather,
                   {{"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"tiles", frame_.tiles, BRUME_ACCESS_FETCH, 0},
                    {"gaussians", frame_.gaussians, BRUME_ACCESS_FETCH, 0},
                    {"lights", frame_.lights, BRUME_ACCESS_FETCH, 0},
                    {"tile_gaussians", frame_.tile_gaussians, BRUME_ACCESS_FETCH, 0},
                    {"cells", state_.cells, BRUME_ACCESS_FETCH, 0},
                    {"cell_gaussians", state_.cell_gaussians, BRUME_ACCESS_FETCH, 0},
                    {"shadow_origins", state_.origins, BRUME_ACCESS_FETCH, 0},
                    {"blob_density", state_.blob_density, BRUME_ACCESS_FETCH, 0},
                    {"sun_table", state_.sun_table, BRUME_ACCESS_FETCH, 0},
                    {"environment", state_.environment, BRUME_ACCESS_FETCH, 0},
                    {"environment_table", state_.environment_table, BRUME_ACCESS_FETCH, 0},
                    {"radiance", to.radiance, BRUME_ACCESS_WRITE, 0},
                    {"error", to.error, BRUME_ACCESS_WRITE, 0},
                    {"distances", to.distances, BRUME_ACCESS_WRITE, 0}},
                   std::move(uniforms), (size + reduction - 1) / int(reduction));
    }

    brume_status compose() override
    {
        const int32_t outputs = int32_t(frame_.outputs);
        return run("compose", state_.compose,
                   {{"color", frame_.color, BRUME_ACCESS_FETCH, 0},
                    {"depth", frame_.depth, BRUME_ACCESS_FETCH, 0},
                    {"gaussian_density", frame_.gaussian_density, BRUME_ACCESS_FETCH, 0},
                    {"radiance", state_.radiance, BRUME_ACCESS_FETCH, 0},
                    {"error", state_.error, BRUME_ACCESS_FETCH, 0},
                    {"distances", state_.distances, BRUME_ACCESS_FETCH, 0},
                    {"result", frame_.output, BRUME_ACCESS_WRITE, 0},
                    {"transmittance_out", frame_.transmittance, BRUME_ACCESS_WRITE, 0},
                    {"optical_depth_out", frame_.optical_depth, BRUME_ACCESS_WRITE, 0},
                    {"airlight_out", frame_.airlight, BRUME_ACCESS_WRITE, 0},
                    {"airlight_error_out", frame_.airlight_error, BRUME_ACCESS_WRITE, 0}},
                   {integer("outputs", outputs)}, ivec2(state_.width, state_.height));
    }

private:
    brume_status run(const char *name, brume_program program, std::vector<brume_plugin_binding> bindings,
                     std::vector<brume_plugin_uniform> uniforms, ivec2 grid)
    {
        return run_pass(services_, host_, name, program, std::move(bindings), uniforms, grid.x, grid.y);
    }

    const brume_services &services_;
    brume_host host_;
    const State &state_;
    const brume_plugin_frame &frame_;
    AirlightSettings settings_;
};

}  // namespace

brume_status compile_programs(const brume_services &services, brume_host host, uint32_t outputs, State &state)
{
    auto compile = [&](const char *name, const std::string &defines, brume_program &out) {
        return services.compile(host, name, std::string(pass_text(name)).c_str(), defines.c_str(), &out);
    };
    auto define = [](const char *name, uint32_t value) {
        return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
    };
    if (state.radiance)
        if (brume_status s = compile("airlight_gather.comp", define("TIER", uint32_t(tier_of(state))), state.gather))
            return s;
    if (state.parameters.tier == Tier::fogshop)
        if (brume_status s = compile("airlight_blobs.comp", "", state.blobs))
            return s;
    return compile("airlight_compose.comp",
                   define("LIT", state.lit) + define("ATTENUATES", state.attenuates) +
                       define("REDUCTION", uint32_t(state.parameters.reduction)) + define("OUTPUTS", outputs & own_outputs),
                   state.compose);
}

brume_status make_gl_passes(const brume_services &services, brume_host host, const State &state,
                            const brume_plugin_frame &frame, std::unique_ptr<Passes> &out)
{
    out = std::make_unique<GlPasses>(services, host, state, frame);
    return BRUME_OK;
}

}  // namespace airlight
