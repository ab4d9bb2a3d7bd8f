// rim: light from behind that surfaces show at their edges, seen through the fog. Shows how an effect reads layers (normals,
// which it needs, and a mask of the user's), fills one of its own, and uses what the host makes of the scene.
#include <new>
#include <string>
#include <string_view>

#include <brume/brume_plugin.h>
#include <brume/maths/pass_tables.hpp>
#include <brume/maths/pixels.hpp>

namespace rim {

std::string_view text(std::string_view file);  // embedded by CMakeLists.txt

namespace {

using namespace brume::maths_float;
using real = float;
#include <brume/maths/formulas_begin.hpp>
#include "rim.glsl"
#include <brume/maths/formulas_end.hpp>

const brume_parameter_info parameters[] = {
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0, 1e6, 1, "strength", "radiance",
     "Of the light at grazing angles", "", ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 1, 100, 4, "sharpness", "",
     "Power by which it falls off from the edge", "", ""},
};

enum Layer { layer_normal, layer_mask, layer_rim };
const brume_layer_info layers[] = {
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT | BRUME_LAYER_NEEDED, 3, 0, "normal",
     "where surfaces face, by which edges are known"},
    {sizeof(brume_layer_info), BRUME_LAYER_INPUT, 1, 0, "rim_mask", "how much of the rim light each pixel takes"},
    {sizeof(brume_layer_info), BRUME_LAYER_OUTPUT, 3, 0, "rim", "the light that was added"},
};

const char *const uses[] = {"density"};

struct Constants {
    float strength, sharpness;
    int32_t world, masked;
};
constexpr brume_constant constants[] = {BRUME_CONSTANT(Constants, strength), BRUME_CONSTANT(Constants, sharpness),
                                        BRUME_CONSTANT(Constants, world), BRUME_CONSTANT(Constants, masked)};

enum { color, normal, mask, density, result, light };
constexpr brume_slot slots[] = {brume_passes::fetch("color"),   brume_passes::fetch("normal"), brume_passes::fetch("mask"),
                                brume_passes::fetch("density"), brume_passes::write("result"), brume_passes::write("light")};

brume_status rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    using namespace brume_pixels;
    const Constants &c = *static_cast<const Constants *>(call->constants);
    const Medium medium = medium_of(*call->scene);
    const Camera camera = camera_of(*call->scene);
    const brume_plugin_pixels *s = call->slots;
    return for_pixels(*call, first, last, [&](int x, int y) {
        const vec3 through = ray_through(camera, pixel_centre(x, y)), ray = through / length(through);
        const vec4 n = load(s[normal], x, y);
        vec3 rim = rim_light(medium, vec3(n.x, n.y, n.z), c.world ? in_world(camera, ray) : ray, *at(s[density], x, y),
                             c.strength, c.sharpness);
        if (c.masked)
            rim *= *at(s[mask], x, y);
        const vec4 source = load(s[color], x, y);
        store(s[result], x, y,
              vec4(compose_radiance(vec3(source.x, source.y, source.z), vec3(1.0f), rim, call->scene->output_limit),
                   source.w));
        if (s[light].data)
            store(s[light], x, y, vec4(rim, 1.0f));
    });
}

struct State {
    int32_t width, height;
    Constants constants;
    brume_pass pass;
};

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **out)
{
    const bool needed = request->parameters[0] > 0;
    const uint64_t pixels = needed ? uint64_t(request->width) * uint64_t(request->height) : 0;
    const brume_plugin_entry entry{
        sizeof entry, needed ? 1u : 0u, "rim", needed ? "edges show light from behind" : "strength 0",
        pixels * 60,  pixels * 40,      0,     0};
    if (const brume_status status = services->add_entry(host, &entry); status || !needed)
        return status;
    if (const brume_status status =
            services->need_camera(host, BRUME_CAMERA_FIELD_OF_VIEW, "a surface's edge depends on where its pixel looks"))
        return status;
    State *state = new (std::nothrow) State{
        request->width, request->height, {float(request->parameters[0]), float(request->parameters[1]), 0, 0}, nullptr};
    if (!state)
        return services->fail(host, BRUME_ERROR_MEMORY, "no memory for the plan's state");
    *out = state;
    const std::string shader =
        "#include \"scene.glsl\"\n#include \"ray.glsl\"\n#include \"density.glsl\"\n#include \"radiance.glsl\"\n" +
        std::string(text("rim.glsl")) + std::string(text("rim.comp"));
    return brume_passes::create(*services, host, brume_passes::described("rim", slots, constants, sizeof(Constants)),
                                "rim.comp", shader, "", rows, state->pass);
}

brume_status execute(const brume_services *services, brume_host host, void *opaque, const brume_plugin_frame *frame)
{
    State &state = *static_cast<State *>(opaque);
    state.constants.world = frame->layers[layer_normal].kind == BRUME_LAYER_WORLD;
    state.constants.masked = frame->layers[layer_mask].image != nullptr;
    const brume_plugin_image density = brume::products_in(*frame)[0].images[0];
    const brume_plugin_image images[] = {
        frame->color,  frame->layers[layer_normal].image, frame->layers[layer_mask].image, density,
        frame->output, frame->layers[layer_rim].image};
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
    table.name = "rim";
    table.help = "Light from behind at the edges of surfaces, seen through the fog";
    table.order = 150;  // after multiscatter: it attenuates its own light
    table.thread_safety = BRUME_THREADS_SAFE;
    table.wanted = BRUME_WANTED_NEVER;
    table.parameters = parameters;
    table.parameter_count = 2;
    table.layers = layers;
    table.layer_count = 3;
    table.uses = uses;
    table.use_count = 1;
    table.plan = plan;
    table.execute = execute;
    table.destroy = destroy;
    return table;
}();

}  // namespace
}  // namespace rim

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    return host_abi == BRUME_PLUGIN_ABI ? &rim::effect : nullptr;
}
