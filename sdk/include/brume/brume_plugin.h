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
  float phase[4];       /* phase function: g of Henyey-Greenstein, g and alpha of Draine, weight of Draine (0: none) */
  float noise[4];       /* of the view ray at Gaussians: strength in radii, lattice points per metre, seed, 0 */
  float noise_shift[3]; /* the camera's place in the noise's lattice, modulo its period of 256 */
  float asymmetry;      /* g, the phase function's mean cosine */
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
  float right[3];         /* the camera's axes in the world: what is d in camera space is d.x right + d.y up + d.z back */
  float up[3];
  float back[3];
} brume_plugin_camera;

/* One Gaussian of the medium: density amplitude * exp(-scale^2 |x - center|^2) (Fogshop eq. 7). Two texels of
   frame->gaussians. */
typedef struct brume_plugin_gaussian {
  float center[3];  /* camera space [m] */
  float scale;      /* a [1/m], > 0 */
  float amplitude;  /* c, ratio to unit density, >= 0 */
  float colour[3];  /* share of what it scatters that is not absorbed after all, 0 to 1: tints airlight, not extinction */
} brume_plugin_gaussian;

/* A light. Four texels of frame->lights, hence floats only. */
typedef struct brume_plugin_light {
  float position[3];  /* camera space [m]; DIRECTIONAL: 0 */
  float radius;       /* [m], >= 0; DIRECTIONAL: 0 */
  float direction[3]; /* camera space, unit: where SPOT and DIRECTIONAL shine to */
  float cos_outer;    /* SPOT: cosine of the half angle where its light ends */
  float intensity[3]; /* POINT, SPOT: [radiance m^2], so that irradiance is intensity / d^2; DIRECTIONAL: irradiance */
  float cos_inner;    /* SPOT: of the half angle where it begins to fall off, >= cos_outer */
  float type;         /* BRUME_LIGHT_... */
  float distance;     /* DIRECTIONAL: [m] of the constant terms that its light has come through */
  float reserved[2];
} brume_plugin_light;

typedef struct brume_plugin_scene {
  uint32_t struct_size;
  uint32_t has_medium;
  brume_plugin_medium medium;
  brume_plugin_camera camera;
  float output_limit;     /* largest magnitude that the output image holds: 65504 or FLT_MAX */
  uint32_t light_count;
  uint32_t gaussian_count;
  uint32_t environment_count; /* of spherical-harmonic coefficients: 0, 1, 4, 9, 16, 25 or 36 */
  const brume_plugin_light *lights;
  const brume_plugin_gaussian *gaussians;
  const float (*environment)[3]; /* RGB of each coefficient, in the order of brume_scene_set_environment; world axes */
  double position[3];            /* of the camera in the world [m] */
  uint64_t revision; /* of lights, Gaussians and medium in the world: the same number, the same values; the camera may move */
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
  uint32_t attenuated;             /* 1: an effect that runs before this one attenuates the image by the medium */
  uint32_t lights_scatter;         /* 1: some effect of this scene adds what the lights scatter once */
  double transmittance;            /* mean transmittance that frames are expected to have; 0 where nobody knows */
  double detail;                   /* of brume_quality; 0 where nobody knows */
} brume_plugin_request;

typedef struct brume_plugin_entry {
  uint32_t struct_size;
  uint32_t runs;       /* 1: a pass, 0: something dropped */
  const char *name;    /* as later given to run() or rows(); copied */
  const char *reason;  /* copied */
  uint64_t bytes;      /* the least to be read and written per frame */
  uint64_t operations; /* what it costs: about as many nanoseconds of one thread of a server CPU */
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
  brume_plugin_image airlight;      /* RGBA, NULL unless wanted */
  brume_plugin_image airlight_error; /* RGBA, NULL unless wanted */
  const brume_plugin_image *light_airlight; /* one RGBA image per light of the scene, each NULL unless wanted; or NULL */

  /* What the host made of the scene's Gaussians and lights; NULL where there are none (a slot left unbound). */
  brume_plugin_image gaussian_density; /* 2 channels per pixel: their int rho dt to what the pixel shows [m at unit
                                          density], and int rho (1 - t/D)^2 dt */
  brume_plugin_image gaussians;        /* data: 2 texels each, as brume_plugin_gaussian */
  brume_plugin_image lights;           /* data: 4 texels each, as brume_plugin_light */
  brume_plugin_image tiles;            /* data: per tile of BRUME_TILE_SIZE squared pixels, row by row: x the first and y the
                                          number of its entries in tile_gaussians */
  brume_plugin_image tile_gaussians;   /* data, one channel: indices of the Gaussians that matter in the tile, by distance */
} brume_plugin_frame;

#define BRUME_TILE_SIZE 16

/* Data images are arrays of texels: texel i is at (i % BRUME_DATA_WIDTH, i / BRUME_DATA_WIDTH). See upload(). */
#define BRUME_DATA_WIDTH 1024

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

  /* In plan() or execute(): a data image of 1 or 4 channels with this content (copied), to be read only. It lives until the
     effect uploads to the same slot (0 to 63, the effect's own numbering) again, or the plan ends. */
  brume_status (*upload)(brume_host host, uint32_t slot, int32_t channels, const float *values, uint64_t texels,
                         brume_plugin_image *out);
} brume_services;

/* ---- the effect -------------------------------------------------------------------------------------------------- */

#define BRUME_THREADS_UNSAFE 0u        /* the host never calls this plugin twice at once */
#define BRUME_THREADS_INSTANCE_SAFE 1u /* different plans at once */
#define BRUME_THREADS_SAFE 2u          /* anything at once */

#define BRUME_WANTED_NEVER 0u      /* runs only in scenes that name it */
#define BRUME_WANTED_WITH_MEDIUM 1u /* also in scenes that have a medium and name no effects */
#define BRUME_WANTED_WITH_LIGHTS 2u /* also in scenes that have a medium and lights or an environment, and name no effects */

typedef struct brume_effect {
  uint32_t struct_size;
  uint32_t abi;             /* BRUME_PLUGIN_ABI of the plugin's header */
  const char *name;         /* [a-z][a-z0-9_]*, at most 63 bytes */
  const char *help;         /* one line */
  int32_t order;            /* effects run by ascending order, then by name; multiscatter has 100 */
  uint32_t thread_safety;   /* BRUME_THREADS_... */
  uint32_t wanted;          /* BRUME_WANTED_... */
  uint32_t outputs;         /* the BRUME_OUTPUT_... flags that it can fill */
  uint32_t attenuates;      /* 1: its output is attenuated by the medium, so later effects must not do it again */
  uint32_t parameter_count; /* at most 256 */
  const brume_parameter_info *parameters; /* each of parameters[0].struct_size */

  /* Looks at the request, adds entries, images, programs. No running entry added: the effect is dropped, plan state
     NULL. *state is the effect's own, given back to execute and destroy. */
  brume_status (*plan)(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state);
  brume_status (*execute)(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame);
  void (*destroy)(void *state); /* state may be NULL */

  /* NULL, or the settings that a wish for quality chooses from: changes of the request's `parameters` (parameter_count of
     them, copied there) those that setting `index` fixes, and gives the error that 95 of 100 frames are predicted to keep below
     with it, as brume_quality.max_error counts; 0: the effect's reference. Returns 1, or 0 from the first index that is none. */
  uint32_t (*offer)(const brume_plugin_request *request, uint32_t index, double *parameters, double *error);
} brume_effect;

typedef const brume_effect *(*brume_plugin_effect_function)(uint32_t host_abi);
#define BRUME_PLUGIN_ENTRY "brume_plugin_effect"

#ifdef __cplusplus
}
#endif
#endif
