// What arrives of lamps, suns and skies in media that scatter however often. Needs radiance.glsl, phase.glsl.
#include "slab_field.glsl"
#include "lamp_medium.glsl"
