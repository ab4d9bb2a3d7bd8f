/* An engine's view of Brume: a frame that was rendered into an HDR colour and a depth texture is fogged where it lies,
 * in the engine's own OpenGL context.
 *
 *   gl_texture OUTPUT.ppm
 *
 * What an engine takes from here: create_fog() once, again when the size changes; apply_fog() per frame, after the opaque
 * passes and before tone mapping. The rest stands for the engine.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <brume/brume.h>

#define WIDTH 640
#define HEIGHT 360
#define NEAR_PLANE 0.1f

/* ---- Brume --------------------------------------------------------------------------------------------------------- */

typedef struct fog {
  brume_context context;
  brume_scene scene;
  brume_plan plan;
} fog;

static void check(brume_context context, brume_status status)
{
  char message[1024];
  if (status == BRUME_OK)
    return;
  brume_message(context, message, sizeof message);
  fprintf(stderr, "gl_texture: %s: %s\n", brume_status_name(status), message);
  exit(1);
}

/* With the engine's context current. */
static fog create_fog(void)
{
  fog fog;
  brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
  desc.backend = BRUME_BACKEND_GL;
  desc.gl_context = BRUME_GL_BORROWED;
  check(NULL, brume_context_create(&desc, &fog.context));

  brume_medium medium = BRUME_MEDIUM_INIT;
  medium.visibility = 400.0; /* [m] */
  medium.g = 0.8;
  brume_camera camera = BRUME_CAMERA_INIT;
  camera.given = BRUME_CAMERA_FIELD_OF_VIEW;
  camera.vertical_fov = 0.9; /* [rad] */
  check(fog.context, brume_scene_create(fog.context, &fog.scene));
  check(fog.context, brume_scene_set_medium(fog.scene, &medium));
  check(fog.context, brume_scene_set_camera(fog.scene, &camera));

  brume_format format = BRUME_FORMAT_INIT;
  format.width = WIDTH;
  format.height = HEIGHT;
  format.depth_kind = BRUME_DEPTH_DEVICE;
  format.depth_range[0] = INFINITY; /* reversed and infinite: 0 is far away, 1 is the near plane */
  format.depth_range[1] = NEAR_PLANE;
  format.sky = BRUME_SKY_CLAMP; /* the mist is this deep; at infinity the sky would be nothing but fog */
  format.sky_distance = 100.0;  /* [m] */
  check(fog.context, brume_plan_create(fog.scene, &format, &fog.plan));
  return fog;
}

static brume_image texture_image(GLuint texture, uint32_t channels)
{
  brume_image image = BRUME_IMAGE_INIT;
  image.kind = BRUME_IMAGE_GL_TEXTURE;
  image.origin = BRUME_ORIGIN_BOTTOM_LEFT;
  image.gl_texture = texture;
  image.channels = channels;
  image.width = WIDTH;
  image.height = HEIGHT;
  return image;
}

/* In place: the colour texture is also the output. Enqueues and returns. */
static void apply_fog(const fog *fog, GLuint color, GLuint depth)
{
  const brume_image color_image = texture_image(color, 4), depth_image = texture_image(depth, 1);
  brume_frame frame = BRUME_FRAME_INIT;
  frame.color = &color_image;
  frame.depth = &depth_image;
  frame.output = &color_image;
  check(fog->context, brume_plan_execute(fog->plan, &frame));
}

/* With the engine's context current. */
static void destroy_fog(fog *fog)
{
  brume_plan_destroy(fog->plan);
  brume_scene_destroy(fog->scene);
  brume_context_destroy(fog->context);
}

/* ---- the engine ---------------------------------------------------------------------------------------------------- */

static void fail(const char *what)
{
  fprintf(stderr, "gl_texture: %s\n", what);
  exit(1);
}

static void make_context(void)
{
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  EGLDeviceEXT device = NULL;
  EGLDisplay display;
  EGLContext context;
  EGLint count = 0;
  if (!epoxy_has_egl() || !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") ||
      !eglQueryDevicesEXT(1, &device, &count) || count < 1)
    fail("EGL has no device");
  display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, NULL);
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API))
    fail("EGL cannot be initialised for OpenGL");
  context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    fail("no OpenGL 4.5 context");
}

static GLuint make_texture(GLenum format)
{
  GLuint texture;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, format, WIDTH, HEIGHT);
  return texture;
}

/* A box that faces the camera: lower left corner and size [px], distance [m], radiance of a grey. */
static void draw_box(int x, int y, int width, int height, float distance, float radiance)
{
  const float color[4] = {radiance, radiance * 0.8f, radiance * 0.6f, 1.0f};
  const float depth = NEAR_PLANE / distance;
  glScissor(x, y, width, height);
  glClearBufferfv(GL_COLOR, 0, color);
  glClearBufferfv(GL_DEPTH, 0, &depth);
}

/* A street by day: sky, ground, and two rows of houses that fade with distance. */
static void draw_street(GLuint color, GLuint depth)
{
  int i;
  GLuint framebuffer;
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
  glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glEnable(GL_SCISSOR_TEST);
  draw_box(0, 0, WIDTH, HEIGHT, INFINITY, 1.0f);
  for (i = 0; i < HEIGHT / 2; ++i)
    draw_box(0, i, WIDTH, 1, 1.6f * HEIGHT / (float)(HEIGHT / 2 - i), 0.15f);
  for (i = 5; i >= 1; --i) {
    const int scale = 200 / i;
    draw_box(WIDTH / 2 - 2 * scale, HEIGHT / 2 - scale / 4, scale, scale, 12.0f * (float)i, 0.05f);
    draw_box(WIDTH / 2 + scale, HEIGHT / 2 - scale / 4, scale, scale, 12.0f * (float)i, 0.1f);
  }
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
}

/* Tone mapped by x / (1 + x), rows from the top. */
static void write_picture(GLuint color, const char *path)
{
  static float pixels[HEIGHT][WIDTH][4];
  FILE *file = fopen(path, "wb");
  int x, y, c;
  if (!file)
    fail("the output cannot be written");
  glGetTextureImage(color, 0, GL_RGBA, GL_FLOAT, (GLsizei)sizeof pixels, pixels);
  fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
  for (y = HEIGHT - 1; y >= 0; --y)
    for (x = 0; x < WIDTH; ++x)
      for (c = 0; c < 3; ++c) {
        const float exposed = 2.0f * pixels[y][x][c];
        fputc((int)(255.0f * powf(exposed / (1.0f + exposed), 1.0f / 2.2f) + 0.5f), file);
      }
  if (fclose(file) != 0)
    fail("the output cannot be written");
}

int main(int argc, char **argv)
{
  GLuint color, depth;
  fog fog;
  if (argc != 2)
    fail("usage: gl_texture OUTPUT.ppm");
  make_context();
  color = make_texture(GL_RGBA16F);
  depth = make_texture(GL_DEPTH_COMPONENT32F);

  fog = create_fog();
  draw_street(color, depth);
  apply_fog(&fog, color, depth);
  write_picture(color, argv[1]);
  destroy_fog(&fog);
  return 0;
}
