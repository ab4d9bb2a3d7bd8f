/* Brume: fog for finished images. The C ABI, and its manual.
 *
 * In: an HDR colour image and the distance to what each pixel shows. Out: the picture that a camera standing in the
 * medium would take. C99; no other header of the SDK is needed to use the library.
 *
 *   brume_context   a backend (CPU threads, or OpenGL 4.5) and the effects found beside the library
 *   brume_scene     what there is: medium, camera, effects and their parameters
 *   brume_plan      what must be done for that scene and one image format; made once, printed, executed per frame
 *
 *   brume_context context; brume_scene scene; brume_plan plan;
 *   brume_context_create(NULL, &context);
 *   brume_scene_create_from_text(context, text, strlen(text), "fog.json", &scene);
 *   brume_format format = BRUME_FORMAT_INIT; format.width = 1920; format.height = 1080;
 *   brume_plan_create(scene, &format, &plan);
 *   brume_frame frame = BRUME_FRAME_INIT; frame.color = &color; frame.depth = &depth; frame.output = &output;
 *   brume_plan_execute(plan, &frame);
 *
 * Rules that hold everywhere
 *   Status      Every call that can fail returns a brume_status. Codes unknown to you may come from a later library:
 *               treat every nonzero value as failure. brume_message() copies out the text of the calling thread's last
 *               failure in that context; nothing is sticky, and a failed call leaves its objects as they were. The output
 *               images of a failed brume_plan_execute() may be half written.
 *   Structs     begin with struct_size; initialise them with their BRUME_..._INIT. A field counts when it lies wholly
 *               inside the struct_size given; the others take their defaults. Size 0 is refused, and so is a larger
 *               struct whose bytes past the end known here are not all zero. Fields named reserved are 0. Languages
 *               that cannot use the macros call brume_..._init(&it, sizeof it), which sets `size` bytes (struct_size
 *               included) to the same defaults, those unknown to this library to 0; NULL or a size below 4 is nothing.
 *   Lifetime    destroy(NULL) is legal and nothing. A scene or plan keeps its context alive. A plan copies the scene:
 *               later changes to the scene do not reach it. Pointers in a struct are read during the call only.
 *   Threads     A context with its scenes and plans is externally synchronised: one call at a time. Contexts are
 *               independent of each other. Only brume_message() is per thread.
 *   Units       metres (scene lengths are multiplied by metres_per_unit), linear radiance, radians in this header
 *               (degrees in scene files), cross-sections times unit density in 1/m; densities are ratios.
 *   Strings     UTF-8, zero-terminated; strings returned by pointer live as long as the object they were asked of.
 *   Results     The same input on the same backend gives the same bits: any number of threads, host memory or texture,
 *               in place or not.
 */
#ifndef BRUME_BRUME_H
#define BRUME_BRUME_H

#include <stddef.h>
#include <stdint.h>

#define BRUME_VERSION_MAJOR 0
#define BRUME_VERSION_MINOR 2
#define BRUME_VERSION_PATCH 0

#if defined(_WIN32)
#define BRUME_API __declspec(dllimport)
#else
#define BRUME_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- status ------------------------------------------------------------------------------------------------------ */

typedef int32_t brume_status;
#define BRUME_OK 0
#define BRUME_ERROR_ARGUMENT 1      /* a NULL, a value out of range, a struct of size 0: the message names it */
#define BRUME_ERROR_UNSUPPORTED 2   /* valid, but not on this backend, format or build */
#define BRUME_ERROR_MEMORY 3
#define BRUME_ERROR_NOT_FOUND 4     /* no effect or parameter of that name; the message names the nearest */
#define BRUME_ERROR_SCENE 5         /* scene-file text: the message has line and column */
#define BRUME_ERROR_CAMERA 6        /* something needs a camera that nobody gave: the message says what and why */
#define BRUME_ERROR_FORMAT 7        /* an image does not fit the plan's format: make a new plan */
#define BRUME_ERROR_GL 8            /* no context, a lost one, a refused shader: the message names the step */
#define BRUME_ERROR_PLUGIN 9        /* an effect failed, threw, or answered nonsense */
#define BRUME_ERROR_INTERNAL 10     /* a defect of the library */
#define BRUME_ERROR_CANCELLED 11    /* the progress callback asked for it */

/* Name of a status ("BRUME_ERROR_SCENE"); of an unknown one "BRUME_ERROR_UNKNOWN". Never NULL. */
BRUME_API const char *brume_status_name(brume_status status);

/* Version of the library that was loaded, as 10000 * major + 100 * minor + patch. */
BRUME_API uint32_t brume_version(void);

/* ---- context ----------------------------------------------------------------------------------------------------- */

typedef struct brume_context_t *brume_context;
typedef struct brume_scene_t *brume_scene;
typedef struct brume_plan_t *brume_plan;

#define BRUME_BACKEND_AUTO 0u /* GL where a GPU is found, else CPU; software GL (llvmpipe) counts as no GPU */
#define BRUME_BACKEND_CPU 1u
#define BRUME_BACKEND_GL 2u   /* fails where GL cannot be had: there is no silent fallback */

#define BRUME_GL_OWNED 0u    /* a headless EGL context of the library's own, on a thread of its own: the caller's
                                thread and current context are never touched. Takes host memory only. */
#define BRUME_GL_BORROWED 1u /* the context current on the calling thread, OpenGL 4.5 or later; it must be current,
                                the same one, in every later call that names this context, destroy included. */

#define BRUME_GL_STATE_PRESERVE 0u /* every piece of state listed in docs/gl-state.md is put back (default) */
#define BRUME_GL_STATE_DEFAULTS 1u /* that state is left at GL's initial values: cheaper, for hosts that set their own */
#define BRUME_GL_STATE_OWNED 2u    /* that state is left as it happens to be: for contexts used by nobody else */

#define BRUME_LOG_ERROR 1u
#define BRUME_LOG_WARNING 2u
#define BRUME_LOG_INFO 3u
#define BRUME_LOG_DEBUG 4u

/* Called on the thread of the API call that logs. Must not call the library. `message` lives during the call. */
typedef void (*brume_log_callback)(void *user, uint32_t level, const char *message);

/* How far a call has come, from 0 to 1, never falling. Called on the thread of the API call, now and then; must not call the
   library. A nonzero return ends the call with BRUME_ERROR_CANCELLED as soon as may be: what it was to write is undefined
   then, its objects stay usable. */
typedef int32_t (*brume_progress_callback)(void *user, double fraction);

typedef struct brume_context_desc {
  uint32_t struct_size;
  uint32_t backend;             /* BRUME_BACKEND_...; default AUTO */
  uint32_t gl_context;          /* BRUME_GL_OWNED (default) or BORROWED; read by the GL backend only */
  uint32_t gl_state;            /* BRUME_GL_STATE_...; read for borrowed contexts only */
  uint32_t threads;             /* CPU threads, 0 to 1024; 0 (default), or more than there are: all the process may
                                   use. Never changes a bit */
  uint32_t log_level;           /* the chattiest level wanted; default BRUME_LOG_WARNING */
  brume_log_callback log;       /* NULL (default): silent */
  void *log_user;
  const char *plugin_directory; /* a further absolute directory of effects; NULL (default): only lib/brume/ beside the
                                   library. The working directory and the environment are never searched. */
  brume_progress_callback progress; /* of brume_context_calibrate and brume_plan_execute; NULL (default): not asked. A frame
                                       on GL asks at its begin and its end only: its passes are but enqueued between. */
  void *progress_user;
} brume_context_desc;
#define BRUME_CONTEXT_DESC_INIT \
  {(uint32_t)sizeof(brume_context_desc), 0u, 0u, 0u, 0u, BRUME_LOG_WARNING, NULL, NULL, NULL, NULL, NULL}
BRUME_API void brume_context_desc_init(brume_context_desc *desc, size_t size);

/* desc NULL: the defaults. On failure *out is NULL and, there being no context to ask, brume_message(NULL, ...) has the
   text. Loads the effects' plugins; a plugin that is refused does not fail the call (see brume_effect_info.refusal). */
BRUME_API brume_status brume_context_create(const brume_context_desc *desc, brume_context *out);
BRUME_API void brume_context_destroy(brume_context context);

typedef struct brume_context_info {
  uint32_t struct_size;
  uint32_t backend;       /* the one in use: BRUME_BACKEND_CPU or _GL */
  uint32_t threads;       /* that work at most: those asked for, or all the process may use where those are fewer */
  uint32_t reserved;
  uint64_t host_bytes;    /* image memory held now, pools included */
  uint64_t device_bytes;
  const char *device;     /* GL_RENDERER, or "CPU" */
} brume_context_info;
#define BRUME_CONTEXT_INFO_INIT {(uint32_t)sizeof(brume_context_info), 0u, 0u, 0u, 0u, 0u, NULL}
BRUME_API void brume_context_info_init(brume_context_info *info, size_t size);
BRUME_API brume_status brume_context_get_info(brume_context context, brume_context_info *info);

/* Gives back the image memory that no plan holds; contexts keep some for the plans and frames to come, and free it as frames
   pass without use. */
BRUME_API brume_status brume_context_trim(brume_context context);

/* Measures what the effects' passes take on this device, for at most 20 s; later plans predict and choose with it. Not while
   other threads use the context. */
BRUME_API brume_status brume_context_calibrate(brume_context context);

/* The measured rates as text, "" before there are any, for another context of the same device to be given. Copied as
   brume_message does. */
BRUME_API size_t brume_context_calibration(brume_context context, char *buffer, size_t capacity);
/* Fails where the text is not of this library and device, and changes nothing then. */
BRUME_API brume_status brume_context_set_calibration(brume_context context, const char *text, size_t length);

/* Copies the message of the calling thread's last failed call on this context (context NULL: of any call without one),
   "" if there was none, cut to capacity and always zero-terminated when capacity > 0. Returns the bytes that the whole
   message needs, terminator included. */
BRUME_API size_t brume_message(brume_context context, char *buffer, size_t capacity);

/* ---- effects and their parameters -------------------------------------------------------------------------------- */

typedef struct brume_effect_info {
  uint32_t struct_size;
  uint32_t parameter_count;
  const char *name;
  const char *help;    /* one line */
  const char *file;    /* the plugin's path */
  const char *refusal; /* NULL; or why this plugin was not taken (then name is the file's name and it has no parameters) */
} brume_effect_info;
#define BRUME_EFFECT_INFO_INIT {(uint32_t)sizeof(brume_effect_info), 0u, NULL, NULL, NULL, NULL}
BRUME_API void brume_effect_info_init(brume_effect_info *info, size_t size);
BRUME_API uint32_t brume_effect_count(brume_context context);
BRUME_API brume_status brume_effect_get_info(brume_context context, uint32_t index, brume_effect_info *info);

#define BRUME_PARAMETER_NUMBER 0u
#define BRUME_PARAMETER_INTEGER 1u
#define BRUME_PARAMETER_BOOLEAN 2u /* "true" or "false" as text, 1 or 0 as number */
#define BRUME_PARAMETER_CHOICE 3u

typedef struct brume_parameter_info {
  uint32_t struct_size;
  uint32_t type;         /* BRUME_PARAMETER_... */
  double minimum;        /* inclusive; numbers and integers only */
  double maximum;
  double default_number; /* of a choice: the index of the default in `choices` */
  const char *name;
  const char *unit;      /* "" where there is none */
  const char *help;      /* one line */
  const char *choices;   /* "paper|reference"; "" unless type is CHOICE */
  const char *alias;     /* another name by which it is taken, for scenes and programs that know it by that; "": none */
} brume_parameter_info;
#define BRUME_PARAMETER_INFO_INIT {(uint32_t)sizeof(brume_parameter_info), 0u, 0.0, 0.0, 0.0, NULL, NULL, NULL, NULL, NULL}
BRUME_API void brume_parameter_info_init(brume_parameter_info *info, size_t size);
BRUME_API brume_status brume_parameter_get_info(brume_context context, const char *effect, uint32_t index,
                                                brume_parameter_info *info);

#define BRUME_LAYER_INPUT 1u    /* read */
#define BRUME_LAYER_OUTPUT 2u   /* filled */
#define BRUME_LAYER_NEEDED 4u   /* an input without which the effect does not run */
#define BRUME_LAYER_OF_LIGHT 8u /* one for each light of the scene */
#define BRUME_LAYER_ANY_SIZE 16u /* an input whose images need not have the frame's size: of another view than its camera's */

/* A layer that an effect reads or fills. */
typedef struct brume_layer_info {
  uint32_t struct_size;
  uint32_t flags;    /* BRUME_LAYER_INPUT or _OUTPUT, and what else holds */
  uint32_t channels; /* 1 or 3 */
  uint32_t reserved;
  const char *name;  /* [a-z][a-z0-9_]*, at most 63 bytes */
  const char *help;  /* one line: what it is, and what for */
} brume_layer_info;
#define BRUME_LAYER_INFO_INIT {(uint32_t)sizeof(brume_layer_info), 0u, 0u, 0u, NULL, NULL}
BRUME_API void brume_layer_info_init(brume_layer_info *info, size_t size);

/* How many layers an effect reads and fills; effect NULL: those that the library reads itself. 0 of an effect that is not there. */
BRUME_API uint32_t brume_layer_count(brume_context context, const char *effect);
BRUME_API brume_status brume_layer_get_info(brume_context context, const char *effect, uint32_t index, brume_layer_info *info);

/* ---- scene ------------------------------------------------------------------------------------------------------- */

/* An empty scene: no medium, no camera, no effects. */
BRUME_API brume_status brume_scene_create(brume_context context, brume_scene *out);

/* A scene from scene-file text (JSON, UTF-8; docs/sequences.md; `brume schema` prints its JSON Schema). `name` stands in
   messages for the file, NULL: "scene". Unknown keys, wrong types and values out of range fail with line and column. */
BRUME_API brume_status brume_scene_create_from_text(brume_context context, const char *text, size_t length,
                                                    const char *name, brume_scene *out);
BRUME_API void brume_scene_destroy(brume_scene scene);

/* The JSON Schema of scene files, effects of this context included. Copied as brume_message does. */
BRUME_API size_t brume_scene_schema(brume_context context, char *buffer, size_t capacity);

#define BRUME_DENSITY_CONSTANT 0u    /* rho = value */
#define BRUME_DENSITY_EXPONENTIAL 1u /* rho = value exp(-falloff <x - origin, direction>), Iser 2018 sec. 3.3 */

typedef struct brume_density_term {
  uint32_t struct_size;
  uint32_t type;       /* BRUME_DENSITY_... */
  double value;        /* ratio to unit density, >= 0; default 1 */
  double falloff;      /* b [1/m], >= 0; exponential only; default 0 */
  double direction[3]; /* n, of any length but 0; the density falls along it; default (0, 1, 0) */
  double origin[3];    /* o, in scene units; default 0 */
} brume_density_term;
#define BRUME_DENSITY_TERM_INIT \
  {(uint32_t)sizeof(brume_density_term), BRUME_DENSITY_CONSTANT, 1.0, 0.0, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}
BRUME_API void brume_density_term_init(brume_density_term *term, size_t size);

#define BRUME_MAX_DENSITY_TERMS 16u /* exponential ones; constant terms are added up and do not count */

/* A Gaussian density term: rho = amplitude exp(-scale^2 |x - center|^2) (Zhou et al. 2007 eq. 7). */
typedef struct brume_gaussian {
  uint32_t struct_size;
  uint32_t reserved;  /* 0 */
  double center[3];   /* b, in scene units */
  double scale;       /* a [1/scene unit], > 0; its radius is 1/a */
  double amplitude;   /* c, ratio to unit density, >= 0; default 1 */
  double color[3];    /* RGB, 0 to 1; default 1. The share of what it would scatter that it does scatter; the rest is
                         absorbed, so that extinction does not depend on it. Read by airlight only. */
} brume_gaussian;
#define BRUME_GAUSSIAN_INIT {(uint32_t)sizeof(brume_gaussian), 0u, {0.0, 0.0, 0.0}, 1.0, 1.0, {1.0, 1.0, 1.0}}
BRUME_API void brume_gaussian_init(brume_gaussian *gaussian, size_t size);

#define BRUME_MAX_GAUSSIANS 1000000u

typedef struct brume_medium {
  uint32_t struct_size;
  uint32_t term_count;  /* 0 (default): constant density 1 */
  double scattering[3]; /* sigma_s at unit density [1/m], RGB, >= 0; default 0 */
  double absorption[3]; /* sigma_a at unit density [1/m], RGB, >= 0; default 0 */
  double emission[3];   /* radiance per metre that the medium itself emits at unit density, RGB, >= 0; default 0 */
  double g;             /* mean cosine of the phase function, -1 to 1; default 0 (isotropic) */
  double visibility;    /* [m]; > 0 replaces scattering by 3.912 / visibility - absorption (Koschmieder, 2 %); default 0 */
  double droplet_diameter; /* [um] 5 to 50 replaces g by the mean cosine of Jendersie and d'Eon 2023's fit; default 0 */
  const brume_density_term *terms; /* term_count of them, each of terms[0].struct_size; they add up */
  const brume_gaussian *gaussians; /* gaussian_count of them, each of gaussians[0].struct_size; they add to the terms */
  uint32_t gaussian_count; /* default 0. With Gaussians and no terms there is no constant density. */
  uint32_t noise_seed;     /* Noise perturbs the view ray before it meets a Gaussian, anchored in the world (Fogshop sec. 5.5) */
  double noise_strength;   /* largest shift of the ray at the Gaussian along each axis, in its radii 1/a, 0 to 10; default 0 */
  double noise_scale;      /* distance between the noise's lattice points, in scene units, > 0; default 1 */
  double noise_offset[3];  /* shift of the noise, in scene units; move it to animate; default 0 */
} brume_medium;
#define BRUME_MEDIUM_INIT {(uint32_t)sizeof(brume_medium), 0u, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, \
                           0.0, 0.0, 0.0, NULL, NULL, 0u, 0u, 0.0, 1.0, {0.0, 0.0, 0.0}}
BRUME_API void brume_medium_init(brume_medium *medium, size_t size);

/* Replaces the medium; NULL takes it away. */
BRUME_API brume_status brume_scene_set_medium(brume_scene scene, const brume_medium *medium);

#define BRUME_LIGHT_POINT 0u       /* a sphere that shines alike in all directions */
#define BRUME_LIGHT_SPOT 1u        /* the same within a cone */
#define BRUME_LIGHT_DIRECTIONAL 2u /* parallel light, such as the sun's */

#define BRUME_SHADOW_NONE 0u
#define BRUME_SHADOW_PERSPECTIVE 1u  /* of POINT and SPOT */
#define BRUME_SHADOW_ORTHOGRAPHIC 2u /* of DIRECTIONAL */
#define BRUME_SHADOW_LATLONG 3u      /* of POINT and SPOT: all around; its middle looks down -z, +x is right of it, +y is its top */
#define BRUME_SHADOW_SCREEN 4u       /* of POINT and SPOT: no map is brought; what the picture shows throws shadows, by its depth */

#define BRUME_SURFACES_LIT 0u
#define BRUME_SURFACES_UNLIT 1u

/* A light of the medium (effect airlight). The image shows surfaces as lights light them; what the medium changes of that is effect
   surface's. */
typedef struct brume_light {
  uint32_t struct_size;
  uint32_t type;        /* BRUME_LIGHT_... */
  double position[3];   /* POINT, SPOT: in scene units */
  double direction[3];  /* SPOT, DIRECTIONAL: where it shines to, of any length but 0; default (0, 0, -1) */
  double intensity[3];  /* RGB, >= 0; default 1. POINT, SPOT: [radiance m^2]: a sphere of radius r [m] and radiance L has
                           pi r^2 L. DIRECTIONAL: irradiance on a surface that faces it [radiance sr]. */
  double radius;        /* POINT, SPOT: in scene units, >= 0; default 0. The airlight is bounded by it, and image pixels that
                           show the sphere are known to be this light (docs/airlight.md). */
  double angle;         /* SPOT: of the whole cone [rad], 0 to pi; default pi / 4 */
  double penumbra;      /* SPOT: share of the half angle over which it falls off to nothing, 0 to 1; default .1 */
  double distance;      /* DIRECTIONAL: length that its light has come through the constant density terms, in scene units,
                           >= 0; default 0. These have no end, and without it would let no light in. */

  /* Where the light's shadow map looks: a depth picture of the scene from the light, which frames bring as the layer "shadow"
     of this light. Its pixels are square; depths are in scene units, and what is NaN, infinite or <= 0 shows nothing. */
  uint32_t shadow_kind;       /* BRUME_SHADOW_...; default NONE */
  uint32_t shadow_depth;      /* BRUME_DEPTH_PLANAR (default), _RAY or _DEVICE; LATLONG: RAY */
  double shadow_extent;       /* PERSPECTIVE: of the map's height [rad], 0 < extent < pi; ORTHOGRAPHIC: width of the map, in scene
                                 units, > 0; LATLONG: not read. SCREEN: nothing of the map is read */
  double shadow_to_world[16]; /* as brume_camera.camera_to_world, of the map's camera */

  uint32_t surfaces; /* BRUME_SURFACES_LIT (default) or _UNLIT: nothing of what surfaces show is this light's */
  uint32_t reserved;

  double shadow_range[2]; /* of DEVICE: planar distances where depth is 0 and where it is 1, in scene units; reversed where the first
                             is the larger. PERSPECTIVE: > 0, either may be infinite; ORTHOGRAPHIC: depth is linear between them. The
                             cleared value of the far end shows nothing. */
} brume_light;
#define BRUME_LIGHT_INIT {(uint32_t)sizeof(brume_light), 0u, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {1.0, 1.0, 1.0}, \
                          0.0, 0.7853981633974483, 0.1, 0.0, BRUME_SHADOW_NONE, 0u, 0.0, \
                          {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}, 0u, 0u, {0.0, 0.0}}
BRUME_API void brume_light_init(brume_light *light, size_t size);

#define BRUME_MAX_LIGHTS 4096u

/* Replaces the lights; count 0 takes them away. */
BRUME_API brume_status brume_scene_set_lights(brume_scene scene, const brume_light *lights, uint32_t count);

/* Replaces the distant light from all around by real spherical harmonics in world axes: count is 0 (none), 1, 4, 9, 16, 25
   or 36 RGB triples, ordered l = 0, 1, ..., m = -l to l, orthonormal, without the Condon-Shortley phase: Y_00 = .2821,
   Y_1m = .4886 (y, z, x). */
BRUME_API brume_status brume_scene_set_environment(brume_scene scene, const double *coefficients, uint32_t count);

/* The lat-long environment image that the scene's text names, which the library does not read; "" if none. Copied as
   brume_message does. Planning such a scene fails until brume_scene_set_environment gives its coefficients. */
BRUME_API size_t brume_scene_environment_file(brume_scene scene, char *buffer, size_t capacity);

/* The shadow map that the scene's text names for a light, which the library does not read; "" if none. Copied as brume_message
   does. Planning such a scene fails unless the format's inputs have the layer "shadow". */
BRUME_API size_t brume_scene_light_shadow_file(brume_scene scene, uint32_t light, char *buffer, size_t capacity);

/* The layer that the scene's text names for a light's own share of the picture, which frames bring as the layer "light_group" of
   this light; "" if none. Copied as brume_message does. */
BRUME_API size_t brume_scene_light_group(brume_scene scene, uint32_t light, char *buffer, size_t capacity);

#define BRUME_CAMERA_FIELD_OF_VIEW 1u /* vertical_fov, pixel_aspect and center are given */
#define BRUME_CAMERA_POSE 2u          /* camera_to_world is given */

/* A pinhole camera; right-handed, looks down -z, +y up. */
typedef struct brume_camera {
  uint32_t struct_size;
  uint32_t given;             /* BRUME_CAMERA_... flags; what is missing is an error only where something needs it */
  double vertical_fov;        /* of the display window's height [rad], 0 < fov < pi */
  double pixel_aspect;        /* width of a pixel over its height; default 1 */
  double center[2];           /* principal point as a fraction of the display window, from its left and its top;
                                 default (.5, .5); others describe off-axis projections */
  double camera_to_world[16]; /* row-major, applied to column points; rigid (no scale), translation in scene units */
} brume_camera;
#define BRUME_CAMERA_INIT {(uint32_t)sizeof(brume_camera), 0u, 0.8726646259971648, 1.0, {0.5, 0.5}, \
  {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}}
BRUME_API void brume_camera_init(brume_camera *camera, size_t size);

BRUME_API brume_status brume_scene_set_camera(brume_scene scene, const brume_camera *camera);

/* What of a camera the scene has: BRUME_CAMERA_... flags. */
BRUME_API brume_status brume_scene_get_camera_given(brume_scene scene, uint32_t *given);

/* Length of one scene unit [m], > 0; default 1. Distances, origins and camera translations are multiplied by it. */
BRUME_API brume_status brume_scene_set_metres_per_unit(brume_scene scene, double metres);

/* Luminance weights of the working colour space, >= 0 with a sum of 1; default Rec. 709 (.2126, .7152, .0722). */
BRUME_API brume_status brume_scene_set_luminance_weights(brume_scene scene, const double weights[3]);

/* Adds the effect with its defaults if it is not there, and sets one parameter; `parameter` NULL sets none. What the
   content needs (multiscatter, where there is a medium) runs besides, unless the scene came from text that names its
   effects. */
BRUME_API brume_status brume_scene_set_text(brume_scene scene, const char *effect, const char *parameter, const char *value);
BRUME_API brume_status brume_scene_set_number(brume_scene scene, const char *effect, const char *parameter, double value);

#define BRUME_PRESET_NONE 0u
#define BRUME_PRESET_DRAFT 1u     /* max_error .3 */
#define BRUME_PRESET_STANDARD 2u  /* max_error .1 */
#define BRUME_PRESET_FINAL 3u     /* max_error .03 */
#define BRUME_PRESET_REFERENCE 4u /* what the others are measured by; CPU only, minutes for small frames */

/* What frames may differ by from the effects' references, or take: at most one of the first three is not 0. Plans then set the
   effects' parameters that the scene leaves open. The error is the root of relMSE, after 2 x 2 box averages and a 3 x 3 box
   filter: sqrt(mean((a - r)^2 / (r^2 + (m / 20)^2))), m the mean of r. Errors and presets choose alike on all devices of a
   backend; time chooses by what this context's device takes (brume_context_calibrate). */
typedef struct brume_quality {
  uint32_t struct_size;
  uint32_t preset;      /* BRUME_PRESET_...; default NONE */
  double max_error;     /* > 0, at most 10; default 0: none asked */
  double budget_ms;     /* > 0 per frame; default 0: none asked */
  double transmittance; /* mean transmittance of what frames show, 0 to 1, which errors depend on; default 0: taken for dense */
  double detail;        /* how far a frame's colour is from itself after a 9 x 9 box blur, counted as max_error is, which errors
                           depend on, too: .08 for smooth images, 1 for usual, 5 for small lamps in the dark; default 0: unknown,
                           taken for 5 */
} brume_quality;
#define BRUME_QUALITY_INIT {(uint32_t)sizeof(brume_quality), BRUME_PRESET_NONE, 0.0, 0.0, 0.0, 0.0}
BRUME_API void brume_quality_init(brume_quality *quality, size_t size);

/* Replaces the quality wanted; NULL: parameters are as they are set. */
BRUME_API brume_status brume_scene_set_quality(brume_scene scene, const brume_quality *quality);
BRUME_API brume_status brume_scene_get_quality(brume_scene scene, brume_quality *quality);

#define BRUME_UP_Y 0u /* the centre of a lat-long image is toward -z of the world, and +x to the right of it */
#define BRUME_UP_Z 1u /* toward +y, and +x to the right of it */

typedef struct brume_scene_info {
  uint32_t struct_size;
  uint32_t light_count;
  uint32_t gaussian_count;    /* without those of files that are read at each frame */
  uint32_t environment_count; /* of spherical-harmonic coefficients */
  uint32_t environment_up;    /* where the top of the environment image is: BRUME_UP_... */
  uint32_t reserved;
} brume_scene_info;
#define BRUME_SCENE_INFO_INIT {(uint32_t)sizeof(brume_scene_info), 0u, 0u, 0u, 0u, 0u}
BRUME_API void brume_scene_info_init(brume_scene_info *info, size_t size);

BRUME_API brume_status brume_scene_get_info(brume_scene scene, brume_scene_info *info);

/* ---- images and layers ------------------------------------------------------------------------------------------- */

#define BRUME_IMAGE_HOST 0u       /* data, row_stride, pixel_stride */
#define BRUME_IMAGE_GL_TEXTURE 1u /* gl_texture; borrowed contexts only. Each frame asks OpenGL what the texture is */
#define BRUME_IMAGE_GL_TEXTURE_TRUSTED 2u
/* The same, but OpenGL is asked nothing: the texture is as gl_texture below wants it, of width x height pixels (of which the image
   is a part: whole_width x whole_height), without swizzle and with base level 0. For colour, channels is 3 or 4. An output is
   exactly RGBA32F or RGBA16F, or with channels 1 R32F or R16F, as `pixel` says. Where that is not so, the call fails with
   BRUME_ERROR_GL or the picture is undefined. */

#define BRUME_PIXEL_F32 0u
#define BRUME_PIXEL_F16 1u

#define BRUME_ORIGIN_TOP_LEFT 0u
#define BRUME_ORIGIN_BOTTOM_LEFT 1u /* the first row is the bottom one, as GL has it; all images of a frame agree */

typedef struct brume_image {
  uint32_t struct_size;
  uint32_t kind;         /* BRUME_IMAGE_...; default HOST */
  uint32_t pixel;        /* BRUME_PIXEL_...; not read for GL_TEXTURE, which knows its own; default F32 */
  uint32_t channels;     /* 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; depth: 1; default 4 */
  int32_t width;
  int32_t height;
  uint32_t origin;       /* BRUME_ORIGIN_...; default TOP_LEFT */
  uint32_t gl_texture;   /* a complete GL_TEXTURE_2D, level 0 is used. Colour: any float or normalised format with RGB;
                            depth: R16, R16F, R32F, RG32F (red) or a depth format; output: RGBA32F, RGBA16F,
                            R11F_G11F_B10F (no alpha, negative values become 0) or RGB10_A2 (clamped to [0, 1], alpha of 2
                            bits); BLUR_RADIUS: RGBA32F, RGBA16F, R32F or R16F */
  void *data;            /* of the first row's first pixel; read only for inputs */
  int64_t pixel_stride;  /* [bytes]; 0 (default): packed */
  int64_t row_stride;    /* [bytes], may be negative; 0 (default): packed */
  int64_t plane_stride;  /* [bytes] from a channel to the next, may be negative; 0 (default): side by side in the pixel. Else
                            packed means that the samples of a channel are side by side. */
  int32_t x;             /* Images that are a part of a larger texture, or of a larger image in memory, which `data` and the */
  int32_t y;             /* strides then describe: column and row of the part's first pixel, rows counted as they are stored */
  int32_t whole_width;   /* whatever `origin` says, and the size of the whole; 0 (default): the image is all there is. What is */
  int32_t whole_height;  /* around the part is neither read nor written. OpenGL copies parts once a frame, wholes it does not. */
} brume_image;
#define BRUME_IMAGE_INIT {(uint32_t)sizeof(brume_image), 0u, 0u, 4u, 0, 0, 0u, 0u, NULL, 0, 0, 0, 0, 0, 0, 0}
BRUME_API void brume_image_init(brume_image *image, size_t size);

/* A picture beside colour and depth, by the name of what it holds. Effects say which they read and fill
   (brume_layer_get_info); those that ship know, for instance,
     inputs   optical_depth, transmittance (of any renderer's fog: they take the place of the scene's density along the ray),
              shadow (shadow map of one light, one channel, of any size: see brume_light.shadow_kind)
     outputs  transmittance (exp(-tau), RGB), optical_depth (tau, RGB; sky in a medium without end gives up to 1e30 times sigma),
              scattered (what was added to the attenuated image: scattered and emitted radiance, RGB), blur_radius (deviation of
              the blur of this pixel's light [px], one channel), airlight (radiance of the lights scattered once toward the
              camera, RGB), airlight_error (estimate of that radiance's error, RGB), light_airlight (airlight of one light, RGB) */
typedef struct brume_layer {
  uint32_t struct_size;
  uint32_t kind;            /* BRUME_LAYER_...; default 0 */
  const char *name;
  const brume_image *image; /* in a format: not read. Inputs: 1 to 4 channels, of which effects see as many as they ask for (grey is
                               spread). Outputs: 3 or 4 channels (alpha is set to 1), 1 for layers of one channel */
  uint32_t light;           /* layers of lights: index of the light in the scene. In a format: not read */
  uint32_t reserved;        /* 0 */
} brume_layer;
#define BRUME_LAYER_INIT {(uint32_t)sizeof(brume_layer), 0u, NULL, NULL, 0u, 0u}
BRUME_API void brume_layer_init(brume_layer *layer, size_t size);

#define BRUME_LAYER_WORLD 0u  /* of normals: in world axes */
#define BRUME_LAYER_CAMERA 1u /* in camera axes (+x right, +y up, looking down -z) */

#define BRUME_MAX_LAYERS 8192u /* of inputs, and of outputs, those of single lights included */

/* ---- plan -------------------------------------------------------------------------------------------------------- */

#define BRUME_DEPTH_PLANAR 0u     /* distance along the optical axis (what EXR's Z means); needs the field of view */
#define BRUME_DEPTH_RAY 1u        /* distance along the pixel's ray */
#define BRUME_DEPTH_INVERSE 2u    /* 1 / planar; <= 0 is far */
#define BRUME_DEPTH_NORMALIZED 3u /* planar = depth_range[0] + z (depth_range[1] - depth_range[0]); z >= 1 is far */
#define BRUME_DEPTH_DEVICE 4u     /* a depth buffer of [0, 1]: 1/planar = mix(1/depth_range[0], 1/depth_range[1], z);
                                     reversed when depth_range[0] is the larger; either may be infinite. The cleared
                                     value of the far end is far. */

#define BRUME_SKY_FOG 0u   /* far pixels are at infinity, seen through all of the medium (default) */
#define BRUME_SKY_KEEP 1u  /* far pixels are returned without fog in front; glows of others still reach them */
#define BRUME_SKY_CLAMP 2u /* far pixels are at sky_distance */

#define BRUME_NONPOSITIVE_FAR 0u  /* planar and ray depth <= 0 is far: what many renderers write where nothing was hit */
#define BRUME_NONPOSITIVE_NEAR 1u /* it is at the camera, with no medium in front */

typedef struct brume_format {
  uint32_t struct_size;
  int32_t width;              /* of the images, 1 to 65536 (and within the device's largest texture) */
  int32_t height;
  int32_t display_x;          /* the display window (what the camera's field of view spans) in pixels, relative to the */
  int32_t display_y;          /* image's top left pixel; overscan and crops differ from the image. */
  int32_t display_width;      /* 0 (default): the display window is the image */
  int32_t display_height;
  uint32_t depth_kind;        /* BRUME_DEPTH_...; default PLANAR */
  double depth_range[2];      /* for NORMALIZED and DEVICE; in scene units; default (0, 1) */
  double far_distance;        /* planar or ray distances >= this are far, in scene units; default 1e9. NaN, infinite and
                                 negative values are, too, and 0 but for DEVICE and NORMALIZED (see nonpositive). */
  uint32_t sky;               /* BRUME_SKY_...; default FOG */
  uint32_t input_count;       /* of layers that every frame brings; default 0 */
  double sky_distance;        /* for BRUME_SKY_CLAMP, in scene units, along the ray */
  uint32_t nonpositive;       /* BRUME_NONPOSITIVE_...; default FAR */
  uint32_t output_count;      /* of layers that frames may ask for; default 0 */
  const brume_layer *inputs;  /* names and kinds, each once; each of inputs[0].struct_size */
  const brume_layer *outputs;
} brume_format;
#define BRUME_FORMAT_INIT \
  {(uint32_t)sizeof(brume_format), 0, 0, 0, 0, 0, 0, 0u, {0.0, 1.0}, 1e9, 0u, 0u, 0.0, 0u, 0u, NULL, NULL}
BRUME_API void brume_format_init(brume_format *format, size_t size);

/* Works out what the scene needs for images of this format, and allocates its images. Once warm, executing it allocates nothing, unless
   there are Gaussians and they, lights or the camera move. BRUME_ERROR_NOT_FOUND where the scene names no effects and has a medium, or
   lights or an environment that the medium scatters, and no effect was found that renders it. BRUME_ERROR_MEMORY says what all of the
   plan's images take and which is the largest; on the CPU before any is made, where that is more than the process may use. */
BRUME_API brume_status brume_plan_create(brume_scene scene, const brume_format *format, brume_plan *out);
BRUME_API void brume_plan_destroy(brume_plan plan);

/* Gives the plan another scene of the same structure, for the frames from now on, without planning anew: medium values, density
   terms and Gaussians, lights, environment and camera may differ. format NULL: as it was; else depth ranges, far and sky
   distances may differ. Structure is: the effects and their parameters, the quality asked, whether there is a medium and which of
   its values are zero, whether scattering and absorption are grey, whether there are constant, exponential and Gaussian
   densities, whether there are lights and such with a shadow map, how many coefficients the environment has; the size, the display window's presence
   and the layers of the format. Where that differs the call fails with BRUME_ERROR_FORMAT, names what differs, and leaves the plan as
   it was. Predictions stay those of the scene that was planned.
   Cost: a copy of the scene's values, by their number, into memory that the plan keeps: once warm, moving lights and cameras by
   brume_scene_set_lights, _set_camera, this and the frame allocate nothing. Gaussians are not copied, but brume_scene_set_medium
   makes them anew. Where the plan dropped an effect, and the medium but for its Gaussians, metres_per_unit, the luminance weights or
   the format's distances differ from the last, the effects plan once more to see that it is dropped still, without going
   through Gaussians and lights. docs/accuracy.md has figures. */
BRUME_API brume_status brume_plan_update(brume_plan plan, brume_scene scene, const brume_format *format);

typedef struct brume_plan_info {
  uint32_t struct_size;
  uint32_t entry_count;
  uint32_t does_nothing;     /* 1: every pass was dropped; execute copies, bit for bit */
  uint32_t camera_needs;     /* BRUME_CAMERA_... flags that executing needs */
  const char *camera_reason; /* what needs it and why; "" */
  uint64_t image_bytes;      /* memory of the plan's own images; from the first frame on with the data of lights and Gaussians
                                and with what the last frame's images were converted to */
  double predicted_ms;       /* per frame, from the passes' operations and bytes at the context's rates: nominal ones, or its
                                own after brume_context_calibrate */
  double predicted_error;    /* that 95 of 100 frames keep below, as brume_quality.max_error counts; < 0: unknown */
  const char *quality;       /* what was chosen for the quality asked, and why; "" where none was asked */
  int64_t clamped_values;    /* of the last execute's half outputs: those beyond 65504, written as that; < 0 before one, and
                                for half outputs on GL, where a count would have to be waited for. The first of a context
                                is logged. */
} brume_plan_info;
#define BRUME_PLAN_INFO_INIT {(uint32_t)sizeof(brume_plan_info), 0u, 0u, 0u, NULL, 0u, 0.0, 0.0, NULL, 0}
BRUME_API void brume_plan_info_init(brume_plan_info *info, size_t size);
BRUME_API brume_status brume_plan_get_info(brume_plan plan, brume_plan_info *info);

typedef struct brume_plan_entry {
  uint32_t struct_size;
  uint32_t runs;        /* 1: a pass; 0: something that was dropped */
  const char *effect;
  const char *name;
  const char *reason;   /* why it runs, or why not */
  uint64_t bytes;       /* the least it must read and write per frame */
  uint64_t operations;  /* per frame, about: what takes one thread of this backend a nanosecond at nominal rates */
  double predicted_ms;
  double measured_ms;   /* of the last execute; < 0 before one. On GL: GPU time; asking waits for that frame to end. */
} brume_plan_entry;
#define BRUME_PLAN_ENTRY_INIT {(uint32_t)sizeof(brume_plan_entry), 0u, NULL, NULL, NULL, 0u, 0u, 0.0, 0.0}
BRUME_API void brume_plan_entry_init(brume_plan_entry *entry, size_t size);
BRUME_API brume_status brume_plan_get_entry(brume_plan plan, uint32_t index, brume_plan_entry *entry);

/* ---- execution --------------------------------------------------------------------------------------------------- */

/* Colour is linear radiance; with alpha it is premultiplied: RGB is treated as the radiance it is, and alpha comes back
   unchanged. A component that is not finite comes back unchanged too and gives no light to others. Half outputs are
   clamped to +-65504 (brume_plan_info counts how many). `output` may be the very image `color` is (in place), with the
   same layout; partial overlap is not allowed. Images may be different channels of the same pixels in memory, and parts of
   one texture or of one image in memory that have no pixel in common.
   Depth may have another size than the plan's, from frame to frame, where it shows the same picture: sides larger or smaller by one
   factor, 1/16 to 16, and then rounded, up or down, by more than a pixel. Each pixel takes the depth pixel in which its centre lies,
   by shares of width and height: column floor((x + 1/2) depth width / width), rows likewise, and no depths are mixed.
   Host memory: returns when the output is complete. GL textures: the work is enqueued in the current context, nothing
   waits; the caller orders its own reads after it as after any GL write (a memory barrier for all uses is issued). */
typedef struct brume_frame {
  uint32_t struct_size;
  uint32_t input_count;
  const brume_image *color;
  const brume_image *depth;
  const brume_image *output;
  const brume_layer *inputs;  /* input_count of them, each of inputs[0].struct_size: all that the plan's format names */
  const brume_layer *outputs; /* output_count of them: any that the plan's format names, each once (and once for each light) */
  uint32_t output_count;
  uint32_t reserved;          /* 0 */
  const brume_camera *camera; /* what it gives goes before the scene's; NULL (default): the scene's */
  double frame;               /* frame number, for the scene's keyed values; default 0 */
} brume_frame;
#define BRUME_FRAME_INIT {(uint32_t)sizeof(brume_frame), 0u, NULL, NULL, NULL, NULL, NULL, 0u, 0u, NULL, 0.0}
BRUME_API void brume_frame_init(brume_frame *frame, size_t size);

BRUME_API brume_status brume_plan_execute(brume_plan plan, const brume_frame *frame);

#ifdef __cplusplus
}
#endif
#endif
