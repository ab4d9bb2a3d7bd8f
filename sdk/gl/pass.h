#pragma once
#include <memory>
#include <vector>

#include <epoxy/gl.h>

#include "plan/backend.h"
#include "gl/program.h"
#include "gl/state_guard.h"

namespace brume::gl {

// How passes read textures, whatever the textures' own parameters say: clamped to the edge, without depth comparison.
struct Samplers {
    GLuint nearest = 0;
    GLuint linear = 0;

    void create();
    void destroy();
};

// A pass of a plan: what of its description the program has, found once.
class GlPass : public Pass {
public:
    // Throws Error(BRUME_ERROR_ARGUMENT) where the program declares what the layout does not have, or has otherwise.
    GlPass(std::shared_ptr<GlProgram> program, PassLayout layout);

    // Later passes, transfers and copies see what it wrote.
    void run(const brume_plugin_image *images, const void *constants, int32_t width, int32_t height,
             const brume_plugin_scene &scene, const Samplers &samplers, StateGuard &guard);

private:
    struct Binding {
        size_t slot;  // of the layout
        GlProgram::Slot *uniform;
        uint32_t access;
    };
    struct Constant {
        GlProgram::Uniform uniform;
        uint32_t offset, bytes;
    };

    void find_slots();
    void find_constants();
    void set_constants(const void *constants);
    void bind_images(const brume_plugin_image *images, const Samplers &samplers, StateGuard &guard);

    const std::shared_ptr<GlProgram> program_;
    std::vector<Binding> bindings_;
    std::vector<Constant> constants_;
    const std::string label_;  // of captures and debug logs
};

}  // namespace brume::gl
