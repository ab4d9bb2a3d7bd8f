/* Brume: the ABI between the library and its effects. C99. The effects that ship with the library use this header, and the
 * maths that is installed beside it (brume/maths), and nothing else, so a stranger's effect can do all that they do.
 *
 * A plugin is a shared library in lib/brume/ beside the Brume library (or in a context's plugin_directory) that exports
 *
 *   BRUME_PLUGIN_EXPORT const brume_effect *brume_plugin_effect(uint32_t host_abi);
 *
 * It returns its table, which must live as long as the library is loaded, or NULL if it cannot work with that ABI. The
 * table is checked before anything else is called; a plugin that fails the check is refused with the reason.
 *
 * An effect turns frame->color into frame->output. It never touches OpenGL or threads, and need not know which backend runs
 * it: it describes its passes once, each with a shader and a function for rows, and the host runs the one that fits.
 *
 * What it sees beside colour are layers, pictures of the caller's that it reads or fills, and products, what the host or other
 * effects make of the scene. It says which in its table; the host checks that what it needs is there, and in which order effects
 * run. Callbacks return a brume_status; before a
 * failing return an effect calls services->fail() with a message. C++ exceptions that escape are caught by the host and
 * become BRUME_ERROR_PLUGIN.
 */
#ifndef BRUME_PLUGIN_H
#define BRUME_PLUGIN_H

#include "brume.h"

#define BRUME_PLUGIN_ABI 2u

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
typedef struct brume_pass_t *brume_pass;               /* a pass as it was described */

/* ---- what effects see of the scene: all of it relative to the camera, in metres, for one frame ----------------------
   Structs of this section grow at their end only, and are given by pointer with the size that the host knows: arrays of them are
   stepped through by it, never by sizeof (brume/maths/scene_arrays.hpp has lights_in() and gaussians_in()). The first two are
   also structs of the maths (brume/maths/lib/scene.glsl: Medium, Camera), member by member; programs that declare
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

/* One Gaussian of the medium: density amplitude * exp(-scale^2 |x - center|^2) (Fogshop eq. 7). Two texels of product
   "gaussians". */
typedef struct brume_plugin_gaussian {
  float center[3];  /* camera space [m] */
  float scale;      /* a [1/m], > 0 */
  float amplitude;  /* c, ratio to unit density, >= 0 */
  float color[3];   /* share of what it scatters that is not absorbed after all, 0 to 1: tints airlight, not extinction */
} brume_plugin_gaussian;

/* A light. Its first 16 floats are four texels of product "lights". */
typedef struct brume_plugin_light {
  float position[3];  /* camera space [m]; DIRECTIONAL: 0 */
  float radius;       /* [m], >= 0; DIRECTIONAL: 0 */
  float direction[3]; /* camera space, unit: where SPOT and DIRECTIONAL shine to */
  float cos_outer;    /* SPOT: cosine of the half angle where its light ends */
  float intensity[3]; /* POINT, SPOT: [radiance m^2], so that irradiance is intensity / d^2; DIRECTIONAL: irradiance */
  float cos_inner;    /* SPOT: of the half angle where it begins to fall off, >= cos_outer */
  float type;         /* BRUME_LIGHT_... */
  float distance;     /* DIRECTIONAL: [m] of the constant terms that its light has come through */
  float surfaces;     /* BRUME_SURFACES_... */
  float reserved;

  /* Its shadow map (brume_light.shadow_kind): see product "light_shadows". */
  float shadow_rows[3][4]; /* a point of camera space [m], 1 appended, times these is it in the space of the map's camera */
  float shadow_kind;       /* BRUME_SHADOW_PERSPECTIVE, _ORTHOGRAPHIC or _LATLONG; 0: there is none */
  float shadow_extent;     /* PERSPECTIVE: tangent of half the vertical field of view; ORTHOGRAPHIC: half the width [m] */
  float shadow_depth;      /* BRUME_DEPTH_PLANAR or BRUME_DEPTH_RAY, in scene units, or BRUME_DEPTH_DEVICE */
  float shadow_screen;     /* 1: made by the host of the picture's depth; frames bring none */
  float shadow_range[2];   /* DEVICE: 1/metres at 0 and at 1, ORTHOGRAPHIC: metres */
  float shadow_reserved[2];
} brume_plugin_light;

typedef struct brume_plugin_scene {
  uint32_t struct_size;
  uint32_t has_medium;
  const brume_plugin_medium *medium;
  const brume_plugin_camera *camera;
  const brume_plugin_light *lights;       /* light_count of them, light_size bytes apart */
  const brume_plugin_gaussian *gaussians; /* gaussian_count of them, gaussian_size bytes apart. When planning: NULL where files or
                                             cameras come with the frames; then gaussian_count is 1 if there will be any */
  const float (*environment)[3]; /* RGB of each coefficient, in the order of brume_scene_set_environment; world axes */
  uint32_t medium_size;
  uint32_t camera_size;
  uint32_t light_size;
  uint32_t gaussian_size;
  uint32_t light_count;
  uint32_t gaussian_count;
  uint32_t environment_count; /* of spherical-harmonic coefficients: 0, 1, 4, 9, 16, 25 or 36 */
  float output_limit;            /* largest magnitude that the output image holds: 65504 or FLT_MAX */
  double position[3];            /* of the camera in the world [m] */
  uint64_t revision; /* of lights, Gaussians, environment and medium in the world: the same number, the same values; the camera
                        may move */
} brume_plugin_scene;

/* ---- layers and products ------------------------------------------------------------------------------------------
   An effect's table lists the layers that it reads and fills (brume_layer_info in brume.h), and by name the products that it
   uses and makes. Everywhere below, layers are counted in the order of that table, and products in that of `uses`. Structs of
   arrays that say no size (brume_plugin_layer, brume_slot, brume_constant, brume_plugin_pixels) do not grow within an ABI. */

typedef struct brume_plugin_layer {
  brume_plugin_image image;             /* as many channels as the table says (3: RGBA); NULL: not given, or not wanted */
  const brume_plugin_image *of_lights;  /* BRUME_LAYER_OF_LIGHT: one for each light of the scene, each may be NULL; or NULL */
  uint32_t kind;                        /* brume_layer.kind */
  uint32_t reserved;
} brume_plugin_layer;

/* What was made of the scene before this effect runs. Where the scene has nothing of the kind, image_count is 0. The host's own:

   name              images
   density           [0] two channels per pixel: int rho dt to what the pixel shows [m at unit density], and the distance to it
                     along the ray [m], 1e30 where far; negative: a pixel to be kept free of the medium, whose integral is 0
   density_rgb       only where the caller gave a layer optical_depth or transmittance: [0] RGBA, int rho dt as each colour of the
                     scene's medium has it; product density then has their mean by luminance
   gaussian_density  two channels per pixel: of the medium's Gaussians alone int rho dt, and int rho (1 - t/D)^2 dt
   gaussians         [0] data: 2 texels each, as brume_plugin_gaussian. [1] data: per tile of BRUME_TILE_SIZE squared pixels, row
                     by row: x the first and y the number of its entries in [2]. [2] data, one channel: indices of the
                     Gaussians that matter in the tile, by distance. count: of Gaussians
   light_gaussians   which Gaussians lie between a light and a point, by the light's direction, as brume/maths/lib/shadow.glsl reads
                     it. count: of lights
   camera_gaussians  the same image; it lists what lies between the camera and a point then, too
   lights            data: 4 texels each, as brume_plugin_light. count: of lights
   light_shadows     only where some light has a shadow map: [0] data: 5 texels each: shadow_rows, then shadow_kind,
                     shadow_extent, 1 where distances are along rays, 0, then x, y, width and height of the map's rectangle in [1].
                     [1] one channel: all maps side by side, distances [m], 1e30 where nothing is. count: of lights
   visible_lights    data: 1 texel each, center and radius, of the lights that have a radius and so can be seen. count: of them

   Beside these, effects make what they name in `makes`. Names without images say what a picture holds: attenuated_radiance (it
   is attenuated by the medium, so later effects must not do it again), single_scattering (what the lights scatter once is added
   to it), all_scattering (whatever they scatter is), environment_scattering (of the environment's light, all that the medium
   scatters from where the picture shows nothing is). */
typedef struct brume_plugin_product {
  uint32_t struct_size;
  uint32_t image_count;
  const brume_plugin_image *images;
  uint64_t revision; /* the same number, the same content */
  uint32_t count;
  uint32_t reserved;
} brume_plugin_product;

#define BRUME_TILE_SIZE 16

/* Data images are arrays of texels: texel i is at (i % BRUME_DATA_WIDTH, i / BRUME_DATA_WIDTH). See upload(). */
#define BRUME_DATA_WIDTH 1024

#define BRUME_MADE_NOWHERE 0u
#define BRUME_MADE_EARLIER 1u /* by an effect that runs before this one, or by the host */
#define BRUME_MADE_LATER 2u   /* by an effect of this plan that comes after this one, or by this one */

/* ---- planning ---------------------------------------------------------------------------------------------------- */

typedef struct brume_plugin_request {
  uint32_t struct_size;
  uint32_t backend;                /* BRUME_BACKEND_CPU or _GL; passes run on either */
  int32_t width;
  int32_t height;
  uint32_t parameter_count;
  uint32_t layer_count;
  const double *parameters;        /* values in the order of the effect's table; choices by index */
  const uint32_t *layers;          /* in the order of the effect's table: 1 if the frames will give it, or want it filled */
  const brume_plugin_scene *scene; /* with the largest value that each keyed quantity of the medium takes: what is zero here
                                      is zero in every frame. Frames may bring another camera. */
  uint32_t animated;               /* 1: some value of the scene is keyed */
  uint32_t pose_matters;           /* 1: some density term depends on the position */
  double transmittance;            /* mean transmittance that frames are expected to have; 0 where nobody knows */
  double detail;                   /* of brume_quality; 0 where nobody knows */
} brume_plugin_request;

typedef struct brume_plugin_entry {
  uint32_t struct_size;
  uint32_t runs;       /* 1: passes of this name, 0: something dropped */
  const char *name;    /* copied */
  const char *reason;  /* copied */
  uint64_t bytes;      /* the least to be read and written per frame */

  /* What it does per frame, counted by kind; what a backend takes for one of a kind is the host's to know. */
  uint64_t operations; /* of texels by themselves: about as many nanoseconds of one thread of a server CPU */
  uint64_t alike;      /* such operations that neighbouring texels do alike: where there are lanes they are done side by side */
  uint64_t turns;      /* turns of loops within a texel (a quadrature's nodes, a ray's steps), each with a few exponentials or a
                          fetch */
} brume_plugin_entry;

/* ---- passes ------------------------------------------------------------------------------------------------------ */

/* A slot to which no image is bound reads as (0, 0, 0, 1) in shaders, which drop what they write to it; rows find NULL there. */
#define BRUME_ACCESS_FETCH 0u  /* sampler2D, nearest: for texelFetch */
#define BRUME_ACCESS_LINEAR 1u /* sampler2D, bilinear, clamped to the edge */
#define BRUME_ACCESS_WRITE 2u  /* layout-less `writeonly uniform image2D` */

typedef struct brume_slot {
  const char *name;     /* of the uniform; one that a program leaves out is nothing to it */
  uint32_t access;      /* BRUME_ACCESS_... */
  uint32_t reserved;
} brume_slot;

#define BRUME_CONSTANT_FLOAT 0u /* components 1 to 4: float, vec2, vec3, vec4 */
#define BRUME_CONSTANT_INT 1u   /* components 1 to 4: int, ivec2, ivec3, ivec4 */

/* A member of the struct of constants that run() takes, and the uniform that it is in shaders ("settings.level"). */
typedef struct brume_constant {
  const char *name;
  uint32_t type;        /* BRUME_CONSTANT_... */
  uint32_t components;
  uint32_t count;       /* array length, 1 for a plain one */
  uint32_t offset;      /* in the struct */
} brume_constant;

typedef struct brume_plugin_pixels {
  float *data;        /* NULL: nothing is bound there */
  int64_t row_stride; /* in floats */
  int32_t width;
  int32_t height;
  int32_t channels;
  int32_t reserved;
} brume_plugin_pixels;

/* What a pass on the CPU is given. */
typedef struct brume_plugin_rows {
  uint32_t struct_size;
  int32_t width;                    /* the grid: what run() was called with */
  int32_t height;
  uint32_t slot_count;
  const brume_plugin_pixels *slots; /* in the order of the pass's slots */
  const void *constants;
  const brume_plugin_scene *scene;
  void *user;                       /* as run() was given it */
} brume_plugin_rows;

/* Rows first (inclusive) to last (exclusive) of the grid. Called on several threads at once; must depend on nothing but its
   rows. */
typedef brume_status (*brume_rows_function)(const brume_plugin_rows *call, int32_t first, int32_t last);

/* A pass, on whichever backend: for each point of a grid it reads images and constants and writes images. */
typedef struct brume_pass_desc {
  uint32_t struct_size;
  uint32_t slot_count;
  const char *name;                /* of the plan's running entry that its time counts to */
  const brume_slot *slots;
  const brume_constant *constants;
  uint32_t constant_count;
  uint32_t constant_size;          /* of the struct; 0 where there are no constants */

  /* For OpenGL: the body of a compute shader; NULL: there is none, and plans on that backend are refused. The host supplies
     #version, the workgroup size (8 x 8), `uniform ivec2 brume_grid` and the lines of `defines`; `#include "file.glsl"` takes
     from brume/maths/lib. Compiled once per context for the same texts. Its uniforms are those of `slots`, `constants` and the
     host's, whose names begin with brume_; any other is refused. */
  const char *source;
  const char *source_name;         /* as messages call it; NULL: `name` */
  const char *defines;             /* NULL: none */

  /* For the CPU; NULL: there is none, and plans on that backend are refused. Called for all rows of the grid, in blocks of
     `grain`, on all threads; the first status that is not BRUME_OK ends it. */
  brume_rows_function rows;
  int32_t grain;
  uint32_t reserved;
} brume_pass_desc;

/* ---- executing --------------------------------------------------------------------------------------------------- */

typedef struct brume_plugin_frame {
  uint32_t struct_size;
  uint32_t layer_count;
  uint32_t product_count;
  uint32_t reserved;
  const brume_plugin_scene *scene;
  brume_plugin_image color;             /* RGBA; linear, premultiplied; may hold NaN and infinities */
  brume_plugin_image depth;             /* one channel, as the caller gave it: ray.glsl converts; see product "density" */
  brume_plugin_image output;            /* RGBA; never the image `color` is */
  const brume_plugin_layer *layers;     /* in the order of the effect's table */
  const brume_plugin_product *products; /* in the order of the effect's `uses`, each of products[0].struct_size */
} brume_plugin_frame;

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
  /* In plan(): a pass that lives as long as the plan. Its name, slots, constants and texts are copied. */
  brume_status (*create_pass)(brume_host host, const brume_pass_desc *desc, brume_pass *out);
  /* In plan(): who makes the product of this name: BRUME_MADE_... */
  uint32_t (*made)(brume_host host, const char *product);

  /* In execute(): one run of a pass; later ones see what it wrote. images: in the order of the pass's slots, NULL: unbound.
     constants: the struct that the pass describes. width, height: of the grid. user: for rows() alone; alive during the call. */
  brume_status (*run)(brume_host host, brume_pass pass, const brume_plugin_image *images, const void *constants, int32_t width,
                      int32_t height, void *user);

  /* In plan() or execute(): a data image of 1 or 4 channels with this content (copied), to be read only. It lives until the
     effect uploads to the same slot (0 to 63, the effect's own numbering) again, or the plan ends. */
  brume_status (*upload)(brume_host host, uint32_t slot, int32_t channels, const float *values, uint64_t texels,
                         brume_plugin_image *out);
  /* In plan() or execute(): the images of a product that this effect makes, from now on. The array is copied, the images are the
     effect's own. `revision` tells contents apart. */
  brume_status (*publish)(brume_host host, const char *product, const brume_plugin_image *images, uint32_t image_count,
                          uint32_t count, uint64_t revision);

  /* In plan() or offer(): what the entry's work takes on this backend, in nanoseconds of one thread at nominal rates: for an effect that
     chooses between ways. A calibration does not change it, so that pictures do not depend on one. */
  double (*nanoseconds)(brume_host host, const brume_plugin_entry *entry);
} brume_services;

/* ---- the effect -------------------------------------------------------------------------------------------------- */

#define BRUME_THREADS_UNSAFE 0u        /* the host never calls this plugin twice at once */
#define BRUME_THREADS_INSTANCE_SAFE 1u /* different plans at once */
#define BRUME_THREADS_SAFE 2u          /* anything at once */

#define BRUME_WANTED_NEVER 0u      /* runs only in scenes that name it */
#define BRUME_WANTED_WITH_MEDIUM 1u /* also in scenes that have a medium and name no effects */
#define BRUME_WANTED_WITH_LIGHTS 2u /* also in scenes that have a medium and lights or an environment, and name no effects */
#define BRUME_WANTED_WITH_LAYERS 3u /* also in scenes that have a medium and lights, and name no effects, where frames bring a layer
                                       that the effect reads, but for those of any size */

typedef struct brume_effect {
  uint32_t struct_size;
  uint32_t abi;             /* BRUME_PLUGIN_ABI of the plugin's header */
  const char *name;         /* [a-z][a-z0-9_]*, at most 63 bytes */
  const char *help;         /* one line */
  int32_t order;            /* effects run after those that make what they use, else by ascending order, then by name;
                               multiscatter has 100 */
  uint32_t thread_safety;   /* BRUME_THREADS_... */
  uint32_t wanted;          /* BRUME_WANTED_... */
  uint32_t parameter_count; /* at most 256 */
  uint32_t layer_count;     /* at most 64 */
  uint32_t make_count;      /* at most 64 */
  uint32_t use_count;       /* at most 64 */
  uint32_t reserved;
  const brume_parameter_info *parameters; /* each of parameters[0].struct_size */
  const brume_layer_info *layers;         /* read and filled; each of layers[0].struct_size */
  const char *const *makes;               /* names of products */
  const char *const *uses;                /* those that nobody makes have no images */

  /* Looks at the request, adds entries, images, passes. No running entry added: the effect is dropped, plan state
     NULL. *state is the effect's own, given back to execute and destroy.

     Frames may come with other values than the request's scene has (keys, brume_plan_update): of its medium, lights, Gaussians,
     environment and camera. What stays as planned: whether there is a medium, which of its nine cross-sections and emissions are
     zero, whether scattering and absorption are grey, whether there are constant, exponential and Gaussian densities, how
     many coefficients the environment has, and whether there are lights. An effect is dropped for reasons that stay as planned, or
     for what the medium but its Gaussians, metres_per_unit or the format's distances are: only where these differ does the host ask
     by another plan() whether it would run now, of a scene with one Gaussian at most and one light of each shadow_kind. */
  brume_status (*plan)(const brume_services *services, brume_host host, const brume_plugin_request *request, void **state);
  brume_status (*execute)(const brume_services *services, brume_host host, void *state, const brume_plugin_frame *frame);
  void (*destroy)(void *state); /* state may be NULL */

  /* NULL: makes all that `makes` names; else whether (1 or 0) it makes number `index` of them with these parameters. */
  uint32_t (*makes_with)(const double *parameters, uint32_t index);

  /* NULL, or the settings that a wish for quality chooses from: changes of the request's `parameters` (parameter_count of
     them, copied there) those that setting `index` fixes, and gives the error that 95 of 100 frames are predicted to keep below
     with it, as brume_quality.max_error counts; 0: the effect's reference. Returns 1, or 0 from the first index that is none. */
  uint32_t (*offer)(const brume_services *services, brume_host host, const brume_plugin_request *request, uint32_t index,
                    double *parameters, double *error);

  /* NULL, or what choices that the scene decides come to: changes `parameters`, a copy of the request's, before any effect
     plans; plan and makes_with then get these. Of the services only made() and fail() may be called, and made() takes it that all
     effects run. */
  brume_status (*settle)(const brume_services *services, brume_host host, const brume_plugin_request *request, double *parameters);

  /* NULL: uses all that `uses` names; else whether (1 or 0) it uses number `index` of them with these parameters, those that settle
     left. What no running effect uses is not made. */
  uint32_t (*uses_with)(const double *parameters, uint32_t index);

  /* scene_count (at most 64) texts of scene files that between them have the effect's passes do all kinds of their work, for
     brume_context_calibrate. NULL: it takes scenes of its own, one for each kind of density. It runs the effect alone: with each of its
     offers, or where it has none with the parameters that the text sets. Frames are small, and bring the layers that the effect needs,
     then all of the frame's size that it reads. */
  const char *const *scenes;
  uint32_t scene_count;
  uint32_t reserved_too;
} brume_effect;

typedef const brume_effect *(*brume_plugin_effect_function)(uint32_t host_abi);
#define BRUME_PLUGIN_ENTRY "brume_plugin_effect"

#ifdef __cplusplus
}
#endif
#endif
