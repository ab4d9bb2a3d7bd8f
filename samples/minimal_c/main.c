/* A lamp before a dark wall, without fog and with it: minimal_c OUTPUT.ppm */
#include <brume/brume.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WIDTH 320
#define HEIGHT 180

static float clear[WIDTH * HEIGHT * 3], depth[WIDTH * HEIGHT], fogged[WIDTH * HEIGHT * 3];

static const char scene_text[] = "{ \"brume\": 1, \"camera\": { \"vertical_fov\": 40 },"
                                 "  \"medium\": { \"scattering\": 0.04, \"g\": 0.85 } }";

static void check(brume_context context, brume_status status)
{
    char message[512];
    if (status == BRUME_OK)
        return;
    brume_message(context, message, sizeof message);
    fprintf(stderr, "%s: %s\n", brume_status_name(status), message);
    exit(1);
}

static void paint(void)
{
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) {
            const int i = y * WIDTH + x;
            const float r = hypotf((float)(x - WIDTH / 2), (float)(y - HEIGHT / 2));
            const int lamp = r < 6, brick = y % 20 > 1 && (x + y / 20 * 22) % 44 > 1;
            depth[i] = lamp ? 20.0f : 24.0f; /* metres along the optical axis */
            clear[3 * i] = lamp ? 60.0f : brick ? 0.05f : 0.02f;
            clear[3 * i + 1] = lamp ? 45.0f : brick ? 0.03f : 0.02f;
            clear[3 * i + 2] = lamp ? 25.0f : 0.02f;
        }
}

static void write_rows(FILE *file, const float *linear)
{
    for (int i = 0; i < WIDTH * HEIGHT * 3; ++i)
        fputc((int)(255 * powf(linear[i] / (1 + linear[i]), 1 / 2.2f) + 0.5f), file);
}

int main(int argc, char **argv)
{
    brume_context context;
    brume_scene scene;
    brume_plan plan;
    brume_format format = BRUME_FORMAT_INIT;
    brume_image color = BRUME_IMAGE_INIT, z, output;
    brume_frame frame = BRUME_FRAME_INIT;
    FILE *file = argc == 2 ? fopen(argv[1], "wb") : NULL;
    if (!file)
        return fprintf(stderr, "usage: minimal_c OUTPUT.ppm (a file that can be written)\n"), 2;
    paint();

    check(NULL, brume_context_create(NULL, &context));
    check(context, brume_scene_create_from_text(context, scene_text, strlen(scene_text), NULL, &scene));
    format.width = color.width = WIDTH;
    format.height = color.height = HEIGHT;
    check(context, brume_plan_create(scene, &format, &plan));

    color.channels = 3;
    output = z = color;
    z.channels = 1;
    color.data = clear, z.data = depth, output.data = fogged;
    frame.color = &color, frame.depth = &z, frame.output = &output;
    check(context, brume_plan_execute(plan, &frame));

    fprintf(file, "P6 %d %d 255\n", WIDTH, 2 * HEIGHT); /* before above, after below */
    write_rows(file, clear);
    write_rows(file, fogged);
    brume_plan_destroy(plan);
    brume_scene_destroy(scene);
    brume_context_destroy(context);
    return fclose(file) == 0 ? 0 : 1;
}
