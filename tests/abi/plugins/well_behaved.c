/* Copies colour to output on the CPU; has a parameter of each type. Also built a second time, to be refused for its name. */
#include <string.h>

#include <brume/brume_plugin.h>

static const brume_parameter_info parameters[] = {
    {sizeof(brume_parameter_info), BRUME_PARAMETER_NUMBER, 0.0, 10.0, 0.5, "strength", "stops", "How much", ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_INTEGER, 1.0, 12.0, 4.0, "levels", "", "How many", ""},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_BOOLEAN, 0.0, 0.0, 1.0, "masking", "", "Whether", NULL},
    {sizeof(brume_parameter_info), BRUME_PARAMETER_CHOICE, 0.0, 0.0, 1.0, "kernel", NULL, "Which", "paper|reference"},
};

struct copy {
    brume_plugin_pixels from, to;
};

static brume_status copy_rows(void *user, int32_t first, int32_t last)
{
    const struct copy *copy = (const struct copy *)user;
    for (int32_t y = first; y < last; ++y)
        memcpy(copy->to.data + y * copy->to.row_stride, copy->from.data + y * copy->from.row_stride,
               (size_t)copy->from.width * 4 * sizeof(float));
    return BRUME_OK;
}

static brume_status plan(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state)
{
    const uint64_t bytes = (uint64_t)request->width * (uint64_t)request->height * 32;
    const brume_plugin_entry entry = {sizeof(brume_plugin_entry), 1, "copy", "always", bytes, 0};
    *state = NULL;
    if (request->backend != BRUME_BACKEND_CPU)
        return services->fail(host, BRUME_ERROR_UNSUPPORTED, "well_behaved runs on the CPU only");
    return services->add_entry(host, &entry);
}

static brume_status execute(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame)
{
    struct copy copy;
    brume_status status = services->pixels(host, frame->color, &copy.from);
    (void)state;
    if (status == BRUME_OK)
        status = services->pixels(host, frame->output, &copy.to);
    return status == BRUME_OK ? services->rows(host, "copy", copy.from.height, 16, copy_rows, &copy) : status;
}

static void destroy(void *state)
{
    (void)state;
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
