#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "plan/backend.h"
#include "gl/disposal.h"

namespace brume::gl {

// A linked compute program and what it declares.
class GlProgram {
public:
    struct Uniform {
        GLint location;
        GLenum type;
        GLint size;  // array length
    };
    // A sampler2D or an image2D, and the texture or image unit that it is set to.
    struct Slot {
        GLint location;
        bool image;
        GLuint unit = 0;
    };

    // Throws Error(BRUME_ERROR_GL) with the compiler's or linker's log, or naming a uniform that passes cannot set.
    GlProgram(const std::string &name, const std::string &source, const std::string &defines,
              std::shared_ptr<Disposal> disposal);
    ~GlProgram();
    GlProgram(const GlProgram &) = delete;
    GlProgram &operator=(const GlProgram &) = delete;

    GLuint id() const { return id_; }
    const std::string &name() const { return name_; }
    // By name, without those that the host sets.
    std::map<std::string, Slot, std::less<>> &slots() { return slots_; }
    const std::map<std::string, Uniform, std::less<>> &uniforms() const { return uniforms_; }

    void set_unit(Slot &slot, GLuint unit) const;
    // Of the uniform's size, in its type.
    void set(const Uniform &uniform, const void *data) const;
    void set_grid(int32_t width, int32_t height) const;
    // brume_medium, brume_camera and brume_output_limit.
    void set_scene(const brume_plugin_scene &scene);

private:
    struct Member {
        Uniform uniform;
        uint32_t offset;
    };

    void link(const std::string &source, const std::string &defines);
    void list_uniforms();
    void take_host_uniform(const std::string &name, const Uniform &uniform);
    void refuse_buffers() const;

    const std::string name_;
    const std::shared_ptr<Disposal> disposal_;
    GLuint id_ = 0;
    std::map<std::string, Uniform, std::less<>> uniforms_;
    std::map<std::string, Slot, std::less<>> slots_;
    std::vector<Member> medium_members_, camera_members_;
    Uniform grid_{-1, 0, 0}, output_limit_{-1, 0, 0};

    // What the uniforms have.
    brume_plugin_medium medium_{};
    brume_plugin_camera camera_{};
    float limit_ = 0;
    bool set_ = false;
};

// Whether passes set a uniform of this type by this many components of BRUME_CONSTANT_...
bool holds(const GlProgram::Uniform &uniform, uint32_t type, uint32_t components);
const char *type_text(const GlProgram::Uniform &uniform);

}  // namespace brume::gl
