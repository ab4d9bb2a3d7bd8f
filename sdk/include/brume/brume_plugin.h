/* Brume: the ABI between the library and its effects. C99. The effects that ship with the library use this header and
 * nothing else, so a stranger's effect can do all that they do.
 *
 * A plugin is a shared library in lib/brume/ beside the Brume library (or in a context's plugin_directory) that exports
 *
 *   BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi);
 *
 * It returns its table, which must live as long as the library is loaded, or NULL if it cannot work with that ABI. The
 * table is checked before anything else is called; a plugin that fails the check is refused with the reason.
 *
 * An effect turns frame->color into frame->output. It never touches OpenGL or threads: images, programs, passes and
 * loops are services of the host, on whichever backend the context has. Callbacks return a brume_status; before a
 * failing return an effect calls services->fail() with a message. C++ exceptions that escape are caught by the host and
 * become BRUME_ERROR_PLUGIN.
 */
#ifndef BRUME_PLUGIN_H
#define BRUME_PLUGIN_H

#include "brume.h"

#define BRUME_PLUGIN_ABI 1u

#if defined(_WIN32)
#define BRUME_PLUGIN_VISIBLE __declspec(dllexport)
#else
#define BRUME_PLUGIN_VISIBLE __attribute__((visibility("default")))
#endif
#ifdef __cplusplus
#define BRUME_PLUGIN_EXPORT extern "C" BRUME_PLUGIN_VISIBLE
#else
#define BRUME_PLUGIN_EXPORT BRUME_PLUGIN_VISIBLE
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct brume_host_t *brume_host;               /* the plan on whose behalf the host calls */
typedef struct brume_plugin_image_t *brume_plugin_image; /* a 2-D image of 32-bit floats with 1, 2 or 4 channels */
typedef struct brume_program_t *brume_program;         /* a compiled compute shader */

/* ---- what effects see of the scene: all of it relative to the camera, in metres, for one frame ----------------------
   These two structs are also GLSL structs of the same names and members (shaders/lib/scene.glsl); programs that declare
   `uniform Medium brume_medium;`, `uniform Camera brume_camera;` or `uniform float brume_output_limit;` get them filled by
   the host. */

typedef struct brume_plugin_medium {
  float scattering[3];  /* at unit density [1/m] */
  float absorption[3];
  float emission[3];    /* [radiance/m] */
  float luminance[3];   /* weights of the working space */
  float asymmetry;      /* g */
  float constant;       /* sum of the constant density terms */
  int32_t term_count;
  float terms[BRUME_MAX_DENSITY_TERMS][4]; /* exponential: xyz = falloff * direction in camera space [1/m], w = log of
                                              the density at the camera */
} brume_plugin_medium;

typedef struct brume_plugin_camera {
  float focal[2];         /* [px], > 0 */
  float tangent_scale[2]; /* camera-space x/-z = (px - center.x) * tangent_scale.x, y/-z likewise; y carries the sign of */
  float center[2];        /* the images' origin. center: principal point in pixels of this image */
  int32_t depth_kind;     /* BRUME_DEPTH_... */
  int32_t sky;            /* BRUME_SKY_... */
  float depth_range[2];   /* NORMALIZED: metres; DEVICE: 1/metres at 0 and at 1 */
  float far_distance;     /* [m] */
  float sky_distance;     /* [m] */
  float metres_per_unit;
  int32_t nonpositive;    /* BRUME_NONPOSITIVE_... */
} brume_plugin_camera;

typedef struct brume_plugin_scene {
  uint32_t struct_size;
  uint32_t has_medium;
  brume_plugin_medium medium;
  brume_plugin_camera camera;
  float output_limit;     /* largest magnitude the output's pixel type holds: 65504 or FLT_MAX */
  uint32_t reserved;
} brume_plugin_scene;

/* ---- planning ---------------------------------------------------------------------------------------------------- */

typedef struct brume_plugin_request {
  uint32_t struct_size;
  uint32_t backend;                /* BRUME_BACKEND_CPU or _GL */
  int32_t width;
  int32_t height;
  uint32_t outputs;                /* BRUME_OUTPUT_... flags wanted */
  uint32_t parameter_count;
  const double *parameters;        /* values in the order of the effect's table; choices by index */
  const brume_plugin_scene *scene; /* with the largest value that each keyed quantity of the medium takes: what is zero here
                                      is zero in every frame. Frames may bring another camera. */
  uint32_t animated;               /* 1: some value of the scene is keyed */
  uint32_t pose_matters;           /* 1: some density term depends on the position */
} brume_plugin_request;

typedef struct brume_plugin_entry {
  uint32_t struct_size;
  uint32_t runs;       /* 1: a pass, 0: something dropped */
  const char *name;    /* as later given to run() or rows(); copied */
  const char *reason;  /* copied */
  uint64_t bytes;      /* the least to be read and written per frame */
  uint64_t operations;
} brume_plugin_entry;

/* ---- executing --------------------------------------------------------------------------------------------------- */

typedef struct brume_plugin_frame {
  uint32_t struct_size;
  uint32_t outputs;                /* BRUME_OUTPUT_... flags for which an image is there in this frame */
  const brume_plugin_scene *scene;
  brume_plugin_image color;        /* RGBA; linear, premultiplied; may hold NaN and infinities */
  brume_plugin_image depth;        /* one channel, as the caller gave it: shaders/lib/ray.glsl converts */
  brume_plugin_image output;       /* RGBA; never the image `color` is */
  brume_plugin_image transmittance; /* RGBA, NULL unless wanted */
  brume_plugin_image optical_depth; /* RGBA, NULL unless wanted */
  brume_plugin_image scattered;     /* RGBA, NULL unless wanted */
  brume_plugin_image blur_radius;   /* one channel, NULL unless wanted */
} brume_plugin_frame;

/* A slot that a pass leaves unbound reads as (0, 0, 0, 1) and drops what is written to it. */
#define BRUME_ACCESS_FETCH 0u  /* sampler2D, nearest: for texelFetch */
#define BRUME_ACCESS_LINEAR 1u /* sampler2D, bilinear, clamped to the edge */
#define BRUME_ACCESS_WRITE 2u  /* layout-less `writeonly uniform image2D` */

typedef struct brume_plugin_binding {
  const char *name;         /* of the uniform; one that the program does not use is ignored */
  brume_plugin_image image;
  uint32_t access;          /* BRUME_ACCESS_... */
  uint32_t reserved;
} brume_plugin_binding;

#define BRUME_UNIFORM_FLOAT 0u /* components 1 to 4: float, vec2, vec3, vec4 */
#define BRUME_UNIFORM_INT 1u   /* components 1 to 4: int, ivec2, ivec3, ivec4 */

typedef struct brume_plugin_uniform {
  const char *name;
  uint32_t type;
  uint32_t components;
  uint32_t count;       /* array length, 1 for a plain one */
  uint32_t reserved;
  const void *data;     /* count * components values */
} brume_plugin_uniform;

typedef struct brume_plugin_pass {
  uint32_t struct_size;
  uint32_t binding_count;
  const char *name;         /* of the plan's entry whose time this counts to */
  brume_program program;
  const brume_plugin_binding *bindings;
  const brume_plugin_uniform *uniforms;
  uint32_t uniform_count;
  int32_t width;            /* invocations wanted; set as `uniform ivec2 brume_grid` */
  int32_t height;
  uint32_t reserved;
} brume_plugin_pass;

typedef struct brume_plugin_pixels {
  float *data;
  int64_t row_stride; /* in floats */
  int32_t width;
  int32_t height;
  int32_t channels;
  int32_t reserved;
} brume_plugin_pixels;

/* Rows first (inclusive) to last (exclusive). Called on several threads at once; must depend on nothing but its rows. */
typedef brume_status (*brume_rows_function)(void *user, int32_t first, int32_t last);

typedef struct brume_services {
  uint32_t struct_size;
  uint32_t reserved;

  /* Remembers the message of the failure that the effect is about to return; gives `status` back. */
  brume_status (*fail)(brume_host host, brume_status status, const char *message);

  /* In plan(): describe what will run and what was dropped, in order. */
  brume_status (*add_entry)(brume_host host, const brume_plugin_entry *entry);
  /* In plan(): this effect needs BRUME_CAMERA_... of the camera because of `reason` (copied). */
  brume_status (*need_camera)(brume_host host, uint32_t needs, const char *reason);
  /* In plan(): an image that lives as long as the plan; pooled between plans. Its content is undefined at each frame. */
  brume_status (*create_image)(brume_host host, const char *label, int32_t width, int32_t height, int32_t channels,
                               brume_plugin_image *out);
  /* In plan(), GL only: a compute program. The host supplies #version, the workgroup size (8 x 8), `uniform ivec2
     brume_grid` and the lines of `defines`; `#include "file.glsl"` takes from shaders/lib. Compiled once per context
     for the same texts. Lives as long as the context. Uniforms are plain floats, ints and their vectors, sampler2D and
     writeonly image2D; names that begin with brume_ are the host's. */
  brume_status (*compile)(brume_host host, const char *name, const char *source, const char *defines, brume_program *out);

  /* In execute(), GL only: one dispatch; later passes see what it wrote. */
  brume_status (*run)(brume_host host, const brume_plugin_pass *pass);
  /* In execute(), CPU only: calls `function` for all rows [0, count), in blocks of `grain`, on all threads. The first
     status that is not BRUME_OK ends it. */
  brume_status (*rows)(brume_host host, const char *name, int32_t count, int32_t grain, brume_rows_function function,
                       void *user);
  /* In execute(), CPU only: the memory of an image. */
  brume_status (*pixels)(brume_host host, brume_plugin_image image, brume_plugin_pixels *out);
} brume_services;

/* ---- the effect -------------------------------------------------------------------------------------------------- */

#define BRUME_THREADS_UNSAFE 0u        /* the host never calls this plugin twice at once */
#define BRUME_THREADS_INSTANCE_SAFE 1u /* different plans at once */
#define BRUME_THREADS_SAFE 2u          /* anything at once */

#define BRUME_WANTED_NEVER 0u      /* runs only in scenes that name it */
#define BRUME_WANTED_WITH_MEDIUM 1u /* also in scenes that have a medium and name no effects */

typedef struct brume_effect {
  uint32_t struct_size;
  uint32_t abi;             /* BRUME_PLUGIN_ABI of the plugin's header */
  const char *name;         /* [a-z][a-z0-9_]*, at most 63 bytes */
  const char *help;         /* one line */
  int32_t order;            /* effects run by ascending order, then by name; multiscatter has 100 */
  uint32_t thread_safety;   /* BRUME_THREADS_... */
  uint32_t wanted;          /* BRUME_WANTED_... */
  uint32_t outputs;         /* the BRUME_OUTPUT_... flags that it can fill */
  uint32_t reserved;        /* 0 */
  uint32_t parameter_count; /* at most 256 */
  const brume_parameter_info *parameters; /* each of parameters[0].struct_size */

  /* Looks at the request, adds entries, images, programs. No running entry added: the effect is dropped, plan state
     NULL. *state is the effect's own, given back to execute and destroy. */
  brume_status (*plan)(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state);
  brume_status (*execute)(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame);
  void (*destroy)(void *state); /* state may be NULL */
} brume_effect;

typedef const brume_effect *(*brume_plugin_effect_function)(uint32_t host_abi);
#define BRUME_PLUGIN_ENTRY "brume_plugin_effect"

#ifdef __cplusplus
}
#endif
#endif
