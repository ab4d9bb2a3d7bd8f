/* A program that was built against the header of 0.2 and runs with today's library. Compiled with that header only. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "brume.h"

static brume_context context;

static void check(brume_status status, const char *what)
{
    if (status != BRUME_OK) {
        char message[512];
        brume_message(context, message, sizeof message);
        fprintf(stderr, "%s: %s: %s\n", what, brume_status_name(status), message);
        exit(1);
    }
}

static void expect(int condition, const char *what)
{
    if (!condition) {
        fprintf(stderr, "not so: %s\n", what);
        exit(1);
    }
}

/* Three grey pixels at 10, 20 and 30 m in a medium of sigma_a .1: attenuation alone. */
static void fog_three_pixels(brume_scene scene)
{
    float color[12], depth[3] = {10, 20, 30}, output[12], transmittance[9];
    brume_format format = BRUME_FORMAT_INIT;
    brume_image color_image = BRUME_IMAGE_INIT, depth_image = BRUME_IMAGE_INIT, output_image = BRUME_IMAGE_INIT;
    brume_image transmittance_image = BRUME_IMAGE_INIT;
    brume_layer layer = BRUME_LAYER_INIT;
    brume_frame frame = BRUME_FRAME_INIT;
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    brume_plan plan;
    int i;
    for (i = 0; i < 12; ++i)
        color[i] = 0.5f;
    format.width = 3;
    format.height = 1;
    format.depth_kind = BRUME_DEPTH_RAY;
    layer.name = "transmittance";
    format.outputs = &layer;
    format.output_count = 1;
    check(brume_plan_create(scene, &format, &plan), "plan");
    check(brume_plan_get_info(plan, &info), "plan info");
    expect(info.does_nothing == 0 && info.entry_count > 0, "the plan does something");
    color_image.width = depth_image.width = output_image.width = transmittance_image.width = 3;
    color_image.height = depth_image.height = output_image.height = transmittance_image.height = 1;
    color_image.data = color;
    depth_image.data = depth;
    depth_image.channels = 1;
    output_image.data = output;
    transmittance_image.data = transmittance;
    transmittance_image.channels = 3;
    layer.image = &transmittance_image;
    frame.color = &color_image;
    frame.depth = &depth_image;
    frame.output = &output_image;
    frame.outputs = &layer;
    frame.output_count = 1;
    check(brume_plan_execute(plan, &frame), "execute");
    for (i = 0; i < 3; ++i) {
        expect(fabs(transmittance[3 * i] - exp(-0.1 * depth[i])) < 1e-6, "transmittance is exp(-tau)");
        expect(fabs(output[4 * i] - 0.5 * exp(-0.1 * depth[i])) < 1e-6, "the pixel is attenuated");
        expect(output[4 * i + 3] == 0.5f, "alpha is unchanged");
    }
    check(brume_plan_update(plan, scene, &format), "update");
    check(brume_plan_execute(plan, &frame), "execute after the update");
    brume_plan_destroy(plan);
}

int main(void)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    brume_context_info context_info = BRUME_CONTEXT_INFO_INIT;
    brume_effect_info effect = BRUME_EFFECT_INFO_INIT;
    brume_parameter_info parameter = BRUME_PARAMETER_INFO_INIT;
    brume_layer_info layer = BRUME_LAYER_INFO_INIT;
    brume_density_term term = BRUME_DENSITY_TERM_INIT;
    brume_medium medium = BRUME_MEDIUM_INIT;
    brume_camera camera = BRUME_CAMERA_INIT;
    const char *text = "{\"brume\": 1, \"medium\": {\"absorption\": 0.1}}";
    const double weights[3] = {0.2126, 0.7152, 0.0722};
    brume_scene scene;
    uint32_t given;

    expect(brume_version() >= 200, "the library is not older than this program");
    desc.backend = BRUME_BACKEND_CPU;
    check(brume_context_create(&desc, &context), "context");
    check(brume_context_get_info(context, &context_info), "context info");
    expect(brume_effect_count(context) > 0, "there are effects");
    check(brume_effect_get_info(context, 0, &effect), "effect info");
    check(brume_parameter_get_info(context, "multiscatter", 0, &parameter), "parameter info");
    expect(brume_layer_count(context, NULL) > 0, "there are layers");
    check(brume_layer_get_info(context, NULL, 0, &layer), "layer info");

    check(brume_scene_create_from_text(context, text, strlen(text), "old", &scene), "scene from text");
    fog_three_pixels(scene);
    brume_scene_destroy(scene);

    check(brume_scene_create(context, &scene), "scene");
    medium.absorption[0] = medium.absorption[1] = medium.absorption[2] = 0.05;
    medium.terms = &term;
    medium.term_count = 1;
    term.value = 2;
    check(brume_scene_set_medium(scene, &medium), "medium");
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    check(brume_scene_set_camera(scene, &camera), "camera");
    check(brume_scene_get_camera_given(scene, &given), "camera given");
    expect(given == camera.given, "the camera is there");
    check(brume_scene_set_metres_per_unit(scene, 1), "unit");
    check(brume_scene_set_luminance_weights(scene, weights), "weights");
    check(brume_scene_set_text(scene, "multiscatter", "kernel", "paper"), "text parameter");
    check(brume_scene_set_number(scene, "multiscatter", "levels", 3), "number parameter");
    expect(brume_scene_set_number(scene, "multiscatter", "no such", 3) != BRUME_OK, "unknown parameters fail");
    expect(brume_scene_schema(context, NULL, 0) > 1, "there is a schema");
    fog_three_pixels(scene);
    brume_scene_destroy(scene);
    brume_context_destroy(context);
    return 0;
}
