#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "core/backend.h"
#include "gl/disposal.h"

namespace brume::gl {

// A linked compute program and what it declares.
class GlProgram : public Program {
public:
    struct Uniform {
        GLint location;
        GLenum type;
        GLint size;  // array length
    };
    // A sampler2D's texture unit or an image2D's image unit; numbered in the order of declaration's listing by GL.
    struct Slot {
        GLuint unit;
        bool image;
    };

    // Throws Error(BRUME_ERROR_GL) with the compiler's or linker's log.
    GlProgram(const std::string &name, const std::string &source, const std::string &defines,
              std::shared_ptr<Disposal> disposal);
    ~GlProgram() override;
    GlProgram(const GlProgram &) = delete;
    GlProgram &operator=(const GlProgram &) = delete;

    GLuint id() const { return id_; }
    const std::string &name() const { return name_; }
    const std::map<std::string, Slot, std::less<>> &slots() const { return slots_; }

    // Sets an active uniform; one that the program does not use is ignored. Throws Error(BRUME_ERROR_ARGUMENT) where
    // the types differ.
    void set(const char *name, uint32_t type, uint32_t components, uint32_t count, const void *data);
    void set_grid(int32_t width, int32_t height);
    // brume_medium, brume_camera and brume_output_limit.
    void set_scene(const brume_plugin_scene &scene);

private:
    void link(const std::string &source, const std::string &defines);
    void list_uniforms();
    void refuse_buffers() const;

    const std::string name_;
    const std::shared_ptr<Disposal> disposal_;
    GLuint id_ = 0;
    std::map<std::string, Uniform, std::less<>> uniforms_;
    std::map<std::string, Slot, std::less<>> slots_;
    std::optional<brume_plugin_scene> scene_;  // whose values the uniforms have
};

}  // namespace brume::gl
