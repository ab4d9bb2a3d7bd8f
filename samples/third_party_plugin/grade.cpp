// grade: exposure and saturation of the picture that the other effects leave. README.md walks through it.
#include <cmath>
#include <new>
#include <string>
#include <string_view>

#include <brume/brume_plugin.h>
#include <brume/maths/pass_tables.hpp>
#include <brume/maths/pixels.hpp>

namespace grade {

std::string_view text(std::string_view file);  // embedded by CMakeLists.txt

namespace {

using namespace brume::maths_float;
using real = float;
#include <brume/maths/formulas_begin.hpp>
#include "grade.glsl"
#include <brume/maths/formulas_end.hpp>

const brume_parameter_info parameters[] = {
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, -20, 20, 0, "exposure", "stops", "Brightens by powers of two", "",
     ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0, 4, 1, "saturation", "",
     "Distance of the colours from their grey: 0 is grey, 1 leaves them", "", ""},
};

// What the shader has as uniforms of these names.
struct Constants {
    float gain, saturation;
};
constexpr brume_constant constants[] = {BRUME_CONSTANT(Constants, gain), BRUME_CONSTANT(Constants, saturation)};

enum { color, result };
constexpr brume_slot slots[] = {brume_passes::fetch("color"), brume_passes::write("result")};

// The CPU's half of the pass. Runs on several threads at once: it writes its own rows and nothing else.
brume_status rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const Constants &c = *static_cast<const Constants *>(call->constants);
    const Medium medium = medium_of(*call->scene);
    return brume_pixels::for_pixels(*call, first, last, [&](int x, int y) {
        const vec4 from = brume_pixels::load(call->slots[color], x, y);
        brume_pixels::store(call->slots[result], x, y,
                            graded(medium, from, c.gain, c.saturation, call->scene->output_limit));
    });
}

// What a plan keeps for its frames.
struct State {
    int32_t width, height;
    Constants constants;
    brume_pass pass;
};

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **out)
{
    const double exposure = request->parameters[0], saturation = request->parameters[1];
    const bool needed = exposure != 0 || saturation != 1;
    const uint64_t pixels = needed ? uint64_t(request->width) * uint64_t(request->height) : 0;
    brume_plugin_entry entry{};
    entry.struct_size = sizeof entry;
    entry.runs = needed;
    entry.name = "grade";
    entry.reason = needed ? "exposure or saturation is set" : "exposure 0 and saturation 1 change nothing";
    entry.bytes = pixels * 2 * 4 * sizeof(float);
    entry.operations = pixels * 20;
    if (const brume_status status = services->add_entry(host, &entry); status || !needed)
        return status;
    State *state =
        new (std::nothrow) State{request->width, request->height, {float(std::exp2(exposure)), float(saturation)}, nullptr};
    if (!state)
        return services->fail(host, BRUME_ERROR_MEMORY, "no memory for the plan's state");
    *out = state;
    const std::string shader =
        "#include \"scene.glsl\"\n" + std::string(text("grade.glsl")) + std::string(text("grade.comp"));
    return brume_passes::create(*services, host, brume_passes::described("grade", slots, constants, sizeof(Constants)),
                                "grade.comp", shader, "", rows, state->pass);
}

brume_status execute(const brume_services *services, brume_host host, void *opaque, const brume_plugin_frame *frame)
{
    const State &state = *static_cast<const State *>(opaque);
    const brume_plugin_image images[] = {frame->color, frame->output};
    return services->run(host, state.pass, images, &state.constants, state.width, state.height, nullptr);
}

void destroy(void *state)
{
    delete static_cast<State *>(state);
}

const brume_effect effect = [] {
    brume_effect table{};
    table.struct_size = sizeof table;
    table.abi = BRUME_PLUGIN_ABI;
    table.name = "grade";
    table.help = "Exposure and saturation of the finished picture";
    table.order = 900;  // after the fog
    table.thread_safety = BRUME_THREADS_SAFE;
    table.wanted = BRUME_WANTED_NEVER;
    table.parameters = parameters;
    table.parameter_count = 2;
    table.plan = plan;
    table.execute = execute;
    table.destroy = destroy;
    return table;
}();

}  // namespace
}  // namespace grade

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    return host_abi == BRUME_PLUGIN_ABI ? &grade::effect : nullptr;
}
