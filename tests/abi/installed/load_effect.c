/* load_effect PREFIX DIRECTORY: runs the sample effects from DIRECTORY with the library installed in PREFIX, on the CPU and, where
 * there is a context, on GL. load_effect PREFIX DIRECTORY NAME: loads the effect of that name. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <brume/brume.h>

static void check(brume_context context, brume_status status)
{
    char message[512];
    if (status == BRUME_OK)
        return;
    brume_message(context, message, sizeof message);
    fprintf(stderr, "%s: %s\n", brume_status_name(status), message);
    exit(1);
}

static void expect(int condition, const char *what)
{
    if (condition)
        return;
    fprintf(stderr, "not so: %s\n", what);
    exit(1);
}

/* Where the effect of that name comes from. */
static int comes_from(brume_context context, const char *name, const char *directory)
{
    uint32_t i;
    for (i = 0; i < brume_effect_count(context); ++i) {
        brume_effect_info info = BRUME_EFFECT_INFO_INIT;
        check(context, brume_effect_get_info(context, i, &info));
        if (strcmp(info.name, name) == 0)
            return strncmp(info.file, directory, strlen(directory)) == 0;
    }
    return 0;
}

static brume_image image_of(float *data, uint32_t channels)
{
    brume_image image = BRUME_IMAGE_INIT;
    image.width = 2;
    image.height = 1;
    image.channels = channels;
    image.data = data;
    return image;
}

/* Two pixels: one seen head on and one at its edge, of which the mask takes half; the layer that is filled says what was added. */
static void run_rim(brume_context context)
{
    const char *text = "{\"brume\": 1, \"camera\": {\"vertical_fov\": 1}, \"medium\": {\"absorption\": 0.1},"
                       " \"effects\": {\"rim\": {\"strength\": 8, \"sharpness\": 1}}}";
    float color[8] = {1, 1, 1, 1, 1, 1, 1, 1}, depth[2] = {10, 10}, output[8], rim[8];
    float normal[6] = {0, 0, 1, 1, 0, 0}, mask[2] = {1, 0.5f};
    const float expected = 8 * 0.5f * expf(-1);
    brume_image color_image = image_of(color, 4), depth_image = image_of(depth, 1), output_image = image_of(output, 4),
                normal_image = image_of(normal, 3), mask_image = image_of(mask, 1), rim_image = image_of(rim, 4);
    brume_layer inputs[2] = {BRUME_LAYER_INIT, BRUME_LAYER_INIT}, filled = BRUME_LAYER_INIT;
    brume_format format = BRUME_FORMAT_INIT;
    brume_frame frame = BRUME_FRAME_INIT;
    brume_scene scene;
    brume_plan plan;
    expect(brume_layer_count(context, "rim") == 3, "the library knows the effect's layers");
    check(context, brume_scene_create_from_text(context, text, strlen(text), NULL, &scene));
    format.width = 2;
    format.height = 1;
    format.depth_kind = BRUME_DEPTH_RAY;
    expect(brume_plan_create(scene, &format, &plan) == BRUME_ERROR_UNSUPPORTED, "normals are needed");
    inputs[0].name = "normal";
    inputs[0].kind = BRUME_LAYER_CAMERA;
    inputs[0].image = &normal_image;
    inputs[1].name = "rim_mask";
    inputs[1].image = &mask_image;
    filled.name = "rim";
    filled.image = &rim_image;
    format.inputs = frame.inputs = inputs;
    format.input_count = frame.input_count = 2;
    format.outputs = frame.outputs = &filled;
    format.output_count = frame.output_count = 1;
    check(context, brume_plan_create(scene, &format, &plan));
    frame.color = &color_image;
    frame.depth = &depth_image;
    frame.output = &output_image;
    check(context, brume_plan_execute(plan, &frame));
    expect(fabsf(rim[0]) < 1e-3f, "a surface that faces the camera shows no rim light");
    expect(fabsf(rim[4] - expected) < 2e-2f * expected, "an edge does, through the mask and the fog");
    expect(output[4] == color[4] + rim[4] && output[7] == 1, "it is added");
    brume_plan_destroy(plan);
    brume_scene_destroy(scene);
}

static int run(uint32_t backend, const char *prefix, const char *directory)
{
    const char *text = "{\"brume\": 1, \"effects\": {\"grade\": {\"exposure\": 1, \"saturation\": 0}}}";
    float color[4] = {0.1f, 0.2f, 0.4f, 0.5f}, depth = 1, output[4];
    const float grey = 0.2126f * 0.1f + 0.7152f * 0.2f + 0.0722f * 0.4f;
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    brume_format format = BRUME_FORMAT_INIT;
    brume_image color_image = BRUME_IMAGE_INIT, depth_image, output_image;
    brume_frame frame = BRUME_FRAME_INIT;
    brume_context context;
    brume_scene scene;
    brume_plan plan;
    int i;
    desc.backend = backend;
    desc.plugin_directory = directory;
    if (brume_context_create(&desc, &context) != BRUME_OK) {
        char message[512];
        brume_message(NULL, message, sizeof message);
        printf("backend %u: %s\n", (unsigned)backend, message);
        return 0;
    }
    expect(comes_from(context, "multiscatter", prefix), "multiscatter comes from beside the library");
    expect(comes_from(context, "grade", directory), "grade comes from plugin_directory");
    check(context, brume_scene_create_from_text(context, text, strlen(text), NULL, &scene));
    format.width = format.height = 1;
    format.depth_kind = BRUME_DEPTH_RAY;
    check(context, brume_plan_create(scene, &format, &plan));
    color_image.width = color_image.height = 1;
    depth_image = output_image = color_image;
    depth_image.channels = 1;
    color_image.data = color;
    depth_image.data = &depth;
    output_image.data = output;
    frame.color = &color_image;
    frame.depth = &depth_image;
    frame.output = &output_image;
    check(context, brume_plan_execute(plan, &frame));
    for (i = 0; i < 3; ++i)
        expect(fabsf(output[i] - 2 * grey) < 1e-6f, "exposure 1 and saturation 0 give twice the luminance");
    expect(output[3] == color[3], "alpha is unchanged");
    brume_plan_destroy(plan);
    brume_scene_destroy(scene);
    run_rim(context);
    brume_context_destroy(context);
    return 1;
}

int main(int argc, char **argv)
{
    if (argc == 4) {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        brume_context context;
        desc.plugin_directory = argv[2];
        desc.backend = BRUME_BACKEND_CPU;
        check(NULL, brume_context_create(&desc, &context));
        expect(comes_from(context, argv[3], argv[2]), "the effect is loaded");
        brume_context_destroy(context);
        return 0;
    }
    expect(argc == 3, "two or three arguments");
    expect(run(BRUME_BACKEND_CPU, argv[1], argv[2]), "the CPU backend is always there");
    run(BRUME_BACKEND_GL, argv[1], argv[2]);
    return 0;
}
