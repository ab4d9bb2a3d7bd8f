/* Copies colour to output on the CPU; has a parameter of each type. Also built a second time, to be refused for its name. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <brume/brume_plugin.h>

static const brume_parameter_info parameters[] = {
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0.0, 10.0, 0.5, "strength", "stops", "How much", "", NULL},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_INTEGER, 1.0, 12.0, 4.0, "levels", "", "How many", "", NULL},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_BOOLEAN, 0.0, 0.0, 1.0, "masking", "", "Whether", NULL, ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_CHOICE, 0.0, 0.0, 1.0, "kernel", NULL, "Which", "paper|reference", "filter"},
};

static brume_status copy_rows(const brume_plugin_rows *call, int32_t first, int32_t last)
{
    const brume_plugin_pixels *from = &call->slots[0], *to = &call->slots[1];
    int32_t y;
    for (y = first; y < last; ++y)
        memcpy(to->data + y * to->row_stride, from->data + y * from->row_stride, (size_t)call->width * 4 * sizeof(float));
    return BRUME_OK;
}

struct state {
    brume_pass copy;
    int32_t width, height;
};

static brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state)
{
    static const brume_slot slots[] = {{"source", BRUME_ACCESS_FETCH, 0}, {"target", BRUME_ACCESS_WRITE, 0}};
    const uint64_t bytes = (uint64_t)request->width * (uint64_t)request->height * 32;
    /* As a plugin of an older header: what lies behind its struct is not the host's to read. */
    const brume_plugin_entry entry = {offsetof(brume_plugin_entry, alike), 1, "copy", "always", bytes, 7, 1000, 1000};
    brume_pass_desc desc;
    struct state *made;
    brume_status status = services->add_entry(host, &entry);
    if (status != BRUME_OK)
        return status;
    made = (struct state *)malloc(sizeof *made);
    if (!made)
        return services->fail(host, BRUME_ERROR_MEMORY, "out of memory");
    made->width = request->width;
    made->height = request->height;
    *state = made;
    memset(&desc, 0, sizeof desc);
    desc.struct_size = sizeof desc;
    desc.name = "copy";
    desc.slots = slots;
    desc.slot_count = 2;
    desc.rows = copy_rows;
    desc.grain = 16;
    return services->create_pass(host, &desc, &made->copy);
}

static brume_status execute(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame)
{
    const struct state *made = (const struct state *)state;
    const brume_plugin_image images[] = {frame->color, frame->output};
    return services->run(host, made->copy, images, NULL, made->width, made->height, NULL);
}

static void destroy(void *state)
{
    free(state);
}

static const brume_effect effect = {
    .struct_size = sizeof(brume_effect),
    .abi = BRUME_PLUGIN_ABI,
    .name = "well_behaved",
    .help = "Copies",
    .order = 200,
    .thread_safety = BRUME_THREADS_SAFE,
    .wanted = BRUME_WANTED_NEVER,
    .parameter_count = 4,
    .parameters = parameters,
    .plan = plan,
    .execute = execute,
    .destroy = destroy,
};

BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi);
const brume_effect *brume_plugin_effect(uint32_t host_abi)
{
    return host_abi == BRUME_PLUGIN_ABI ? &effect : NULL;
}
