/* run_scenes DIRECTORY FILE...: plans and executes each scene file on a small picture, effects from DIRECTORY included, on
 * the CPU and, where there is a context, on GL. */
#include <stdio.h>
#include <stdlib.h>

#include <brume/brume.h>

enum { width = 16, height = 9 };

static int fail(brume_context context, const char *file)
{
    char message[1024];
    brume_message(context, message, sizeof message);
    fprintf(stderr, "%s: %s\n", file, message);
    return 1;
}

static int run(brume_context context, const char *file)
{
    static char text[65536];
    float color[width * height * 4], depth[width * height], output[width * height * 4];
    brume_format format = BRUME_FORMAT_INIT;
    brume_camera camera = BRUME_CAMERA_INIT;
    brume_image color_image = BRUME_IMAGE_INIT, depth_image, output_image;
    brume_frame frame = BRUME_FRAME_INIT;
    brume_layer shadow = BRUME_LAYER_INIT, shadows[8];
    brume_scene_info info = BRUME_SCENE_INFO_INIT;
    brume_scene scene;
    brume_plan plan;
    brume_status status;
    size_t length;
    int i;
    FILE *stream = fopen(file, "rb");
    if (!stream)
        return fprintf(stderr, "%s: cannot be opened\n", file), 1;
    length = fread(text, 1, sizeof text, stream);
    fclose(stream);
    for (i = 0; i < width * height * 4; ++i)
        color[i] = 1, depth[i / 4] = 20;
    if (brume_scene_create_from_text(context, text, length, file, &scene) != BRUME_OK)
        return fail(context, file);
    /* Lights that name a shadow map get the picture's depth for it. */
    brume_scene_get_info(scene, &info);
    shadow.name = "shadow";
    shadow.image = &depth_image;
    for (shadow.light = 0; shadow.light < info.light_count && frame.input_count < 8; ++shadow.light)
        if (brume_scene_light_shadow_file(scene, shadow.light, NULL, 0) > 1)
            shadows[frame.input_count++] = shadow;
    format.inputs = frame.inputs = shadows;
    format.input_count = frame.input_count ? 1 : 0;
    format.width = color_image.width = width;
    format.height = color_image.height = height;
    status = brume_plan_create(scene, &format, &plan);
    brume_scene_destroy(scene);
    if (status != BRUME_OK)
        return fail(context, file);
    depth_image = output_image = color_image;
    depth_image.channels = 1;
    color_image.data = color;
    depth_image.data = depth;
    output_image.data = output;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    frame.color = &color_image;
    frame.depth = &depth_image;
    frame.output = &output_image;
    frame.camera = &camera;
    status = brume_plan_execute(plan, &frame);
    brume_plan_destroy(plan);
    return status == BRUME_OK ? 0 : fail(context, file);
}

int main(int argc, char **argv)
{
    const uint32_t backends[] = {BRUME_BACKEND_CPU, BRUME_BACKEND_GL};
    int failures = 0, b, i;
    if (argc < 3)
        return 2;
    for (b = 0; b < 2; ++b) {
        brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
        brume_context context;
        desc.backend = backends[b];
        desc.plugin_directory = argv[1];
        if (brume_context_create(&desc, &context) != BRUME_OK) {
            failures += fail(NULL, "context") && backends[b] == BRUME_BACKEND_CPU;
            continue;
        }
        for (i = 2; i < argc; ++i)
            failures += run(context, argv[i]);
        brume_context_destroy(context);
    }
    return failures ? 1 : 0;
}
