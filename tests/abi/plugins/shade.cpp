// Two effects, one library each: makes_shade makes an image for others, uses_shade adds it to the picture. By their numbers
// the user would come first.
#include <new>
#include <string_view>

#include <brume/brume_plugin.h>

namespace {

constexpr bool makes = std::string_view(TEST_CASE) == "makes_shade";
const char *const product[] = {"shade"};

const brume_parameter_info parameters[] = {{sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0, 1, 0.25, "share", "",
                                            "Of the red; 0: there is no shade", "", ""},
                                           {sizeof(brume_parameter_info), BRUME_PARAMETER_BOOLEAN, 0, 1, 0, "strays", "",
                                            "Publishes what it does not make", "", ""}};

struct Constants {
    float share;
};
const brume_constant constants[] = {{"share", BRUME_CONSTANT_FLOAT, 1, 1, 0}};

enum Slot { color, shade, result };
const brume_slot maker_slots[] = {
    {"color", BRUME_ACCESS_FETCH, 0}, {"shade", BRUME_ACCESS_WRITE, 0}, {"result", BRUME_ACCESS_WRITE, 0}};
const brume_slot user_slots[] = {
    {"color", BRUME_ACCESS_FETCH, 0}, {"shade", BRUME_ACCESS_FETCH, 0}, {"result", BRUME_ACCESS_WRITE, 0}};

const char *const maker_shader = R"(
uniform sampler2D color;
writeonly uniform image2D shade, result;
uniform float share;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, brume_grid)))
        return;
    vec4 v = texelFetch(color, p, 0);
    imageStore(shade, p, vec4(share * v.r));
    imageStore(result, p, v);
}
)";
const char *const user_shader = R"(
uniform sampler2D color, shade;
writeonly uniform image2D result;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, brume_grid)))
        return;
    vec4 v = texelFetch(color, p, 0);
    imageStore(result, p, vec4(v.rgb + texelFetch(shade, p, 0).r, v.a));
}
)";

brume_status rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const auto at = [&](Slot slot, int32_t x, int32_t y) {
        const brume_plugin_pixels &p = call->slots[slot];
        return p.data ? p.data + y * p.row_stride + x * p.channels : nullptr;
    };
    for (int32_t y = first; y < last; ++y)
        for (int32_t x = 0; x < call->width; ++x) {
            const float *from = at(color, x, y);
            float *to = at(result, x, y), *middle = at(shade, x, y);
            if (makes)
                *middle = static_cast<const Constants *>(call->constants)->share * from[0];
            for (int c = 0; c < 4; ++c)
                to[c] = from[c] + (!makes && middle && c < 3 ? *middle : 0);
        }
    return BRUME_OK;
}

struct State {
    int32_t width, height;
    Constants constants;
    bool strays;
    brume_pass pass;
    brume_plugin_image made;
    uint64_t frames;
};

brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **out)
{
    const float share = makes ? float(request->parameters[0]) : 0;
    const uint32_t made = services->made(host, product[0]);
    const brume_plugin_entry entry{sizeof entry,
                                   !makes || share > 0,
                                   "shade",
                                   makes                        ? "shade is asked for"
                                   : made == BRUME_MADE_EARLIER ? "shade is made"
                                   : made == BRUME_MADE_LATER   ? "shade comes too late"
                                                                : "nobody makes shade",
                                   0,
                                   0,
                                   0,
                                   0};
    if (const brume_status status = services->add_entry(host, &entry); status || !entry.runs)
        return status;
    State *state = new (std::nothrow)
        State{request->width, request->height, {share}, makes && request->parameters[1] != 0, nullptr, nullptr, 0};
    if (!state)
        return services->fail(host, BRUME_ERROR_MEMORY, "no memory for the plan's state");
    *out = state;
    if (makes)
        if (const brume_status status = services->create_image(host, "shade", state->width, state->height, 1, &state->made))
            return status;
    brume_pass_desc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "shade";
    desc.slots = makes ? maker_slots : user_slots;
    desc.slot_count = 3;
    desc.constants = constants;
    desc.constant_count = makes;
    desc.constant_size = makes ? sizeof(Constants) : 0;
    desc.source = makes ? maker_shader : user_shader;
    desc.rows = rows;
    desc.grain = 4;
    return services->create_pass(host, &desc, &state->pass);
}

brume_status execute(const brume_services *services, brume_host host, void *opaque, const brume_plugin_frame *frame)
{
    State &state = *static_cast<State *>(opaque);
    brume_plugin_image between = state.made;
    if (!makes && frame->products->image_count > 0)
        between = frame->products->images[0];
    const brume_plugin_image images[] = {frame->color, between, frame->output};
    if (const brume_status status =
            services->run(host, state.pass, images, makes ? &state.constants : nullptr, state.width, state.height, nullptr);
        status || !makes)
        return status;
    return services->publish(host, state.strays ? "gloom" : product[0], &state.made, 1, 0, ++state.frames);
}

void destroy(void *state)
{
    delete static_cast<State *>(state);
}

const brume_effect effect = [] {
    brume_effect e{};
    e.struct_size = sizeof e;
    e.abi = BRUME_PLUGIN_ABI;
    e.name = TEST_CASE;
    e.help = makes ? "Makes the product shade" : "Adds the product shade";
    e.order = makes ? 300 : 200;
    e.thread_safety = BRUME_THREADS_SAFE;
    e.parameters = parameters;
    e.parameter_count = makes ? 2 : 0;
    (makes ? e.makes : e.uses) = product;
    (makes ? e.make_count : e.use_count) = 1;
    e.plan = plan;
    e.execute = execute;
    e.destroy = destroy;
    return e;
}();

}  // namespace

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    return host_abi == BRUME_PLUGIN_ABI ? &effect : nullptr;
}
