// grade: exposure and saturation of the picture that the other effects leave. A whole effect in one file; README.md
// walks through it.
#include <algorithm>
#include <cmath>
#include <new>

#include <brume/brume_plugin.h>

namespace {

const brume_parameter_info parameters[] = {
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, -20, 20, 0, "exposure", "stops", "Brightens by powers of two",
     ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0, 4, 1, "saturation", "",
     "Distance of the colours from their grey: 0 is grey, 1 leaves them", ""},
};

// What a plan keeps for its frames.
struct Grade {
    int32_t width, height;
    float gain, saturation;
    brume_program program;  // GL only
};

// ---- GL --------------------------------------------------------------------------------------------------------------

const char *const shader = R"(
#include "scene.glsl"
uniform Medium brume_medium;
uniform float gain;
uniform float saturation;
uniform float limit;
uniform sampler2D color;
writeonly uniform image2D result;

// All in halves: the difference of two large radiances must not become infinite.
float finite_half(float x)
{
    return is_finite(x) ? 0.5 * x : 0.0;
}

float graded(float x, float grey)
{
    return is_finite(x) ? clamp(2.0 * gain * (grey + saturation * (0.5 * x - grey)), -limit, limit) : x;
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.x >= brume_grid.x || p.y >= brume_grid.y)
        return;
    vec4 x = texelFetch(color, p, 0);
    float grey = dot(vec3(finite_half(x.r), finite_half(x.g), finite_half(x.b)), brume_medium.luminance);
    imageStore(result, p, vec4(graded(x.r, grey), graded(x.g, grey), graded(x.b, grey), x.a));
}
)";

brume_status execute_on_gl(const brume_services *services, brume_host host, const Grade &grade,
                           const brume_plugin_frame &frame)
{
    const brume_plugin_binding bindings[] = {{"color", frame.color, BRUME_ACCESS_FETCH, 0},
                                             {"result", frame.output, BRUME_ACCESS_WRITE, 0}};
    const brume_plugin_uniform uniforms[] = {{"gain", BRUME_UNIFORM_FLOAT, 1, 1, 0, &grade.gain},
                                             {"saturation", BRUME_UNIFORM_FLOAT, 1, 1, 0, &grade.saturation},
                                             {"limit", BRUME_UNIFORM_FLOAT, 1, 1, 0, &frame.scene->output_limit}};
    brume_plugin_pass pass{};
    pass.struct_size = sizeof pass;
    pass.name = "grade";
    pass.program = grade.program;
    pass.bindings = bindings;
    pass.binding_count = 2;
    pass.uniforms = uniforms;
    pass.uniform_count = 3;
    pass.width = grade.width;
    pass.height = grade.height;
    return services->run(host, &pass);
}

// ---- CPU -------------------------------------------------------------------------------------------------------------

struct Rows {
    const Grade &grade;
    const brume_plugin_scene &scene;
    brume_plugin_pixels from, to;
};

float finite_half(float x)
{
    return std::isfinite(x) ? 0.5f * x : 0.0f;
}

// Runs on several threads at once: it writes its own rows and nothing else.
brume_status grade_rows(void *user, int32_t first, int32_t last)
{
    const Rows &rows = *static_cast<const Rows *>(user);
    const float gain = rows.grade.gain, saturation = rows.grade.saturation, limit = rows.scene.output_limit;
    const float *luminance = rows.scene.medium.luminance;
    const auto graded = [&](float x, float grey) {
        return std::isfinite(x) ? std::clamp(2.0f * gain * (grey + saturation * (0.5f * x - grey)), -limit, limit) : x;
    };
    for (int32_t y = first; y < last; ++y) {
        const float *from = rows.from.data + y * rows.from.row_stride;
        float *to = rows.to.data + y * rows.to.row_stride;
        for (int32_t x = 0; x < rows.from.width; ++x, from += 4, to += 4) {
            const float grey = luminance[0] * finite_half(from[0]) + luminance[1] * finite_half(from[1]) +
                               luminance[2] * finite_half(from[2]);
            for (int c = 0; c < 3; ++c)
                to[c] = graded(from[c], grey);
            to[3] = from[3];
        }
    }
    return BRUME_OK;
}

brume_status execute_on_cpu(const brume_services *services, brume_host host, const Grade &grade,
                            const brume_plugin_frame &frame)
{
    Rows rows{grade, *frame.scene, {}, {}};
    if (const brume_status status = services->pixels(host, frame.color, &rows.from))
        return status;
    if (const brume_status status = services->pixels(host, frame.output, &rows.to))
        return status;
    return services->rows(host, "grade", grade.height, 16, grade_rows, &rows);
}

// ---- the table -------------------------------------------------------------------------------------------------------

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state)
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

    brume_program program = nullptr;
    if (request->backend == BRUME_BACKEND_GL)
        if (const brume_status status = services->compile(host, "grade", shader, "", &program))
            return status;
    *state =
        new (std::nothrow) Grade{request->width, request->height, float(std::exp2(exposure)), float(saturation), program};
    return *state ? BRUME_OK : services->fail(host, BRUME_ERROR_MEMORY, "no memory for the plan's state");
}

brume_status execute(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame)
{
    const Grade &grade = *static_cast<const Grade *>(state);
    return grade.program ? execute_on_gl(services, host, grade, *frame) : execute_on_cpu(services, host, grade, *frame);
}

void destroy(void *state)
{
    delete static_cast<Grade *>(state);
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

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    return host_abi == BRUME_PLUGIN_ABI ? &effect : nullptr;
}
