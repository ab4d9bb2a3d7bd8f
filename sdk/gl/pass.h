#pragma once
#include <brume/brume_plugin.h>

#include <epoxy/gl.h>

#include "gl/state_guard.h"

namespace brume::gl {

// How passes read textures, whatever the textures' own parameters say: clamped to the edge, without depth comparison.
struct Samplers {
    void create();
    void destroy();

    GLuint nearest = 0;
    GLuint linear = 0;
};

// Checks and dispatches one pass; later passes, transfers and copies see what it wrote.
// Throws Error(BRUME_ERROR_ARGUMENT) that names pass, item and expectation.
void run_pass(const brume_plugin_pass &pass, const brume_plugin_scene &scene, const Samplers &samplers, StateGuard &guard);

}  // namespace brume::gl
