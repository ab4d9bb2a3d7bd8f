/* Brume: making media of Gaussians by hand (Zhou et al. 2007, "Fogshop", sec. 6). C99; the rules of brume.h hold.
 *
 *   brume_media media;
 *   brume_media_create(context, &media);
 *   brume_media_paint paint = BRUME_MEDIA_PAINT_INIT;
 *   paint.stroke = &stroke; paint.scale = 0.5; paint.seed = 1;
 *   brume_media_apply_paint(media, &paint);
 *   brume_media_save(media, "bank.ply");
 *
 * A brume_media is a document: Gaussians, of which some are selected, a clipboard, and the history of the operations that
 * made them. Lengths are scene units, as in brume_gaussian: a Gaussian's radius is 1 / scale.
 *
 *   Operations  are those that say "Operation". Each is one step of the history, or fails and changes nothing. The result
 *               may not exceed BRUME_MAX_GAUSSIANS.
 *   Results     Chance comes from the operation's seed only, and all arithmetic is of correctly rounded operations: the same
 *               operations give the same bits, run to run and machine to machine.
 *   Journal     The history as text, one JSON object a line. Replaying it gives the same Gaussians bit for bit.
 */
#ifndef BRUME_BRUME_MEDIA_H
#define BRUME_BRUME_MEDIA_H

#include "brume.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the document ------------------------------------------------------------------------------------------------ */

typedef struct brume_media_t *brume_media;

/* An empty one. Keeps its context alive, and shares its messages and its rules for threads. */
BRUME_API brume_status brume_media_create(brume_context context, brume_media *out);
BRUME_API void brume_media_destroy(brume_media media);

typedef struct brume_media_info {
  uint32_t struct_size;
  uint32_t gaussian_count;
  uint32_t selected_count;
  uint32_t clipboard_count;
  uint32_t undo_count; /* operations that brume_media_undo() can take back */
  uint32_t redo_count;
} brume_media_info;
#define BRUME_MEDIA_INFO_INIT {(uint32_t)sizeof(brume_media_info), 0u, 0u, 0u, 0u, 0u}
BRUME_API void brume_media_info_init(brume_media_info *info, size_t size);
BRUME_API brume_status brume_media_get_info(brume_media media, brume_media_info *info);

/* Copies Gaussians `first` to `first + count - 1` out; each element of `out` is of out[0].struct_size. */
BRUME_API brume_status brume_media_get_gaussians(brume_media media, uint32_t first, uint32_t count, brume_gaussian *out);

/* Copies out 1 for each of those Gaussians that is selected, 0 for the others. */
BRUME_API brume_status brume_media_get_selection(brume_media media, uint32_t first, uint32_t count, uint8_t *out);

/* Operation: adds these Gaussians, each of gaussians[0].struct_size. Colours are kept as floats. */
BRUME_API brume_status brume_media_put(brume_media media, const brume_gaussian *gaussians, uint32_t count);

/* Operation: adds the Gaussians of a file, CSV or PLY by its extension (docs/media.md). */
BRUME_API brume_status brume_media_load(brume_media media, const char *path);

/* Writes all Gaussians, CSV or binary PLY by the extension. The file appears whole or not at all. Not an operation. */
BRUME_API brume_status brume_media_save(brume_media media, const char *path);

/* ---- views and strokes ------------------------------------------------------------------------------------------- */

/* What a picture on the screen shows of the medium's scene. */
typedef struct brume_media_view {
  uint32_t struct_size;
  uint32_t reserved;           /* 0 */
  const brume_camera *camera;  /* with field of view and pose */
  const brume_format *format;  /* size, display window, and how depth is to be read; its outputs are not used */
  const brume_image *depth;    /* distances to what the picture shows, host memory; read by the airbrush only; NULL (default):
                                  nothing is in the way */
} brume_media_view;
#define BRUME_MEDIA_VIEW_INIT {(uint32_t)sizeof(brume_media_view), 0u, NULL, NULL, NULL}
BRUME_API void brume_media_view_init(brume_media_view *view, size_t size);

#define BRUME_MEDIA_MAX_STROKE_POINTS 65536u

/* A polyline. With a plane its points are projected onto it: straight down, or along the view's rays. */
typedef struct brume_media_stroke {
  uint32_t struct_size;
  uint32_t point_count;         /* 1 to BRUME_MEDIA_MAX_STROKE_POINTS */
  const double *points;         /* x, y, z in scene units; with a view x, y in pixels from the picture's top left corner */
  const brume_media_view *view; /* NULL (default): points are in the scene; else they are on the screen and need a plane */
  double plane_point[3];        /* a point of the plane; default 0 */
  double plane_normal[3];       /* of any length; default (0, 0, 0): no plane */
} brume_media_stroke;
#define BRUME_MEDIA_STROKE_INIT {(uint32_t)sizeof(brume_media_stroke), 0u, NULL, NULL, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}
BRUME_API void brume_media_stroke_init(brume_media_stroke *stroke, size_t size);

/* ---- paintbrush and eraser --------------------------------------------------------------------------------------- */

/* Gaussians along a stroke at equal distances, each moved by a random vector in the plane perpendicular to it. */
typedef struct brume_media_paint {
  uint32_t struct_size;
  uint32_t seed;
  const brume_media_stroke *stroke;
  double scale;     /* a [1/scene unit], > 0; default 1 */
  double amplitude; /* c, ratio to unit density, >= 0; default 1 */
  double color[3];  /* RGB, 0 to 1; default 1 */
  double spacing;   /* along the stroke [scene unit], >= 0; 0 (default): 0.75 / scale */
  double jitter;    /* bound of the random vector's length in radii 1 / scale, 0 to 1000; default 1 */
} brume_media_paint;
#define BRUME_MEDIA_PAINT_INIT \
  {(uint32_t)sizeof(brume_media_paint), 0u, NULL, 1.0, 1.0, {1.0, 1.0, 1.0}, 0.0, 1.0}
BRUME_API void brume_media_paint_init(brume_media_paint *paint, size_t size);

/* Operation. */
BRUME_API brume_status brume_media_apply_paint(brume_media media, const brume_media_paint *paint);

/* Takes strength (1 - (d / radius)^2)^2 from the amplitude of each Gaussian whose centre is d < radius from the stroke. Those
   that reach zero are removed. */
typedef struct brume_media_erase {
  uint32_t struct_size;
  uint32_t reserved;  /* 0 */
  const brume_media_stroke *stroke;
  double radius;      /* [scene unit], > 0; default 1 */
  double strength;    /* ratio to unit density, >= 0; default 1 */
} brume_media_erase;
#define BRUME_MEDIA_ERASE_INIT {(uint32_t)sizeof(brume_media_erase), 0u, NULL, 1.0, 1.0}
BRUME_API void brume_media_erase_init(brume_media_erase *erase, size_t size);

/* Operation. */
BRUME_API brume_status brume_media_apply_erase(brume_media media, const brume_media_erase *erase);

/* ---- particles --------------------------------------------------------------------------------------------------- */

/* A source of particles that fly on parabolas. Particle i is born at (i + chance) / rate and its place is a closed form of
   its age: what an emitter has made by some time does not depend on the times asked for before. */
typedef struct brume_media_emitter {
  uint32_t struct_size;
  uint32_t seed;
  double position[3];     /* default 0 */
  double radius;          /* of the ball in which particles are born, >= 0; default 0 */
  double velocity[3];     /* [scene unit/s]; default (0, 0, 1) */
  double spread;          /* radius of the ball in which initial velocities lie around that [scene unit/s], >= 0; default 0 */
  double acceleration[3]; /* [scene unit/s^2]; default 0 */
  double rate;            /* particles per second, 0 to 1e9; default 100 */
  double duration;        /* it emits from time 0 to this [s], 0 to 1e6; default 1e6 */
  double lifetime;        /* of a particle [s], 0 to 1e6; default 1 */
  double scale[2];        /* a at birth and at the end of life, > 0; the radius 1 / a changes evenly; default 1, 1 */
  double amplitude[2];    /* c at birth and at the end of life, >= 0; changes evenly; default 1, 0 */
  double color[3];        /* RGB, 0 to 1; default 1 */
} brume_media_emitter;
#define BRUME_MEDIA_EMITTER_INIT \
  {(uint32_t)sizeof(brume_media_emitter), 0u, {0.0, 0.0, 0.0}, 0.0, {0.0, 0.0, 1.0}, 0.0, {0.0, 0.0, 0.0}, 100.0, 1e6, 1.0, \
   {1.0, 1.0}, {1.0, 0.0}, {1.0, 1.0, 1.0}}
BRUME_API void brume_media_emitter_init(brume_media_emitter *emitter, size_t size);

/* Operation: adds a Gaussian for each particle alive at `time` [s], 0 to 1e6. */
BRUME_API brume_status brume_media_apply_emit(brume_media media, const brume_media_emitter *emitter, double time);

/* Particles without end of life, which are slowed by the air, wander, and bounce off what the view's depth shows; they freeze
   when the brush is stopped. Behind what the depth shows all is solid; beside the picture nothing is known and nothing in the
   way. The same seed with a longer duration carries the same particles on. */
typedef struct brume_media_airbrush {
  uint32_t struct_size;
  uint32_t seed;
  const brume_media_view *view; /* NULL (default): nothing is in the way */
  double position[3];           /* default 0; not behind what the depth shows */
  double velocity[3];           /* [scene unit/s]; default 0 */
  double spread;                /* radius of the ball in which initial velocities lie around that [scene unit/s], >= 0; default 1 */
  double drag;                  /* a particle's velocity falls by this share a second [1/s], 0 to 30; default 1 */
  double diffusion;             /* D: it wanders sqrt(2 D t) along each axis in t s [scene unit^2/s], >= 0; default 0.1 */
  double rate;                  /* particles per second, 0 to 1e9; default 100 */
  double duration;              /* until it is stopped [s], 0 to 1e6; default 1 */
  double scale;                 /* a [1/scene unit], > 0; default 1 */
  double amplitude;             /* c, ratio to unit density, >= 0; default 1 */
  double color[3];              /* RGB, 0 to 1; default 1 */
} brume_media_airbrush;
#define BRUME_MEDIA_AIRBRUSH_INIT \
  {(uint32_t)sizeof(brume_media_airbrush), 0u, NULL, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1.0, 1.0, 0.1, 100.0, 1.0, 1.0, 1.0, \
   {1.0, 1.0, 1.0}}
BRUME_API void brume_media_airbrush_init(brume_media_airbrush *airbrush, size_t size);

/* Operation. */
BRUME_API brume_status brume_media_apply_airbrush(brume_media media, const brume_media_airbrush *airbrush);

/* ---- selection --------------------------------------------------------------------------------------------------- */

#define BRUME_MEDIA_SELECT_REPLACE 0u
#define BRUME_MEDIA_SELECT_ADD 1u
#define BRUME_MEDIA_SELECT_REMOVE 2u

/* Operation: the Gaussians before the camera whose centres project into rectangle = {left, top, right, bottom}, in pixels from
   the picture's top left corner, become the selection, are added to it or taken from it. What hides them does not matter. */
BRUME_API brume_status brume_media_select_rectangle(brume_media media, const brume_media_view *view,
                                                    const double rectangle[4], uint32_t mode);
BRUME_API brume_status brume_media_select_all(brume_media media);  /* Operation. */
BRUME_API brume_status brume_media_select_none(brume_media media); /* Operation. */

BRUME_API brume_status brume_media_copy(brume_media media); /* Operation: the selection becomes the clipboard. */

/* Operation: adds the clipboard, moved by `offset` [scene unit]; what was added becomes the selection. */
BRUME_API brume_status brume_media_paste(brume_media media, const double offset[3]);

BRUME_API brume_status brume_media_move(brume_media media, const double offset[3]); /* Operation: moves the selection. */
BRUME_API brume_status brume_media_delete(brume_media media); /* Operation: removes the selection. */

/* ---- history ----------------------------------------------------------------------------------------------------- */

/* Takes the last operation back; fails where there is none. */
BRUME_API brume_status brume_media_undo(brume_media media);

/* Does again what was last undone; fails where there is nothing, or an operation has come since. */
BRUME_API brume_status brume_media_redo(brume_media media);

/* The history as text, a JSON object a line, what was undone included. Copied as brume_message does; 0 on failure. */
BRUME_API size_t brume_media_journal(brume_media media, char *buffer, size_t capacity);

/* Does all that a journal says, in this document, which need not be empty. `name` stands in messages for the file, NULL:
   "journal". A line that is wrong or cannot be done fails with its number, and nothing is changed. */
BRUME_API brume_status brume_media_replay(brume_media media, const char *text, size_t length, const char *name);

#ifdef __cplusplus
}
#endif
#endif
