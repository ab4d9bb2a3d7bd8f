#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <array>
#include <vector>

#include <epoxy/gl.h>

namespace brume::gl {

// As many as some group of state has; without memory of its own, since every frame keeps some.
template <class Value> struct FewValues {
    std::array<Value, 12> values{};
    size_t count = 0;

    void push_back(Value value) { values[count++] = value; }
    Value &operator[](size_t i) { return values[i]; }
    Value operator[](size_t i) const { return values[i]; }
};

struct ContextProperties {
    bool compatibility = false;  // fixed-function pixel transfer would alter uploads
    GLint most_debug_groups = 1;
};

// The state of the host's context that passes and transfers change; docs/gl-state.md is its contract. What a piece of
// work does not touch is not even read: each function is called before the state it names is changed for the first
// time. At the end everything goes back (BRUME_GL_STATE_PRESERVE), to GL's initial values (DEFAULTS), or stays (OWNED).
class StateGuard {
public:
    StateGuard(uint32_t mode, const ContextProperties &properties);
    ~StateGuard();
    StateGuard(const StateGuard &) = delete;
    StateGuard &operator=(const StateGuard &) = delete;

    void program();
    void texture_unit(GLuint unit);
    void image_unit(GLuint unit);
    // These two also set that state to tight rows of client memory, whatever the mode.
    void pack();
    void unpack();

    bool compatibility() const { return properties_.compatibility; }
    // Whether one more debug group fits on the host's.
    bool debug_groups();

    // GL's names of all guarded state, as docs/gl-state.md lists them.
    static std::vector<std::string> names();

private:
    struct TextureUnit {
        GLint texture, sampler;
    };
    struct ImageUnit {
        GLint texture, level, layered, layer, access, format;
    };
    // Pixel-store parameters and the buffer, or fixed-function pixel transfer, in the order of their tables.
    using Values = FewValues<GLint>;
    using Scales = FewValues<GLfloat>;
    void pixel_transfer();

    const uint32_t mode_;
    const ContextProperties properties_;
    bool resume_transform_feedback_ = false;
    std::optional<GLint> program_;
    std::optional<GLint> active_texture_;
    std::map<GLuint, TextureUnit> texture_units_;
    std::map<GLuint, ImageUnit> image_units_;
    std::optional<Values> pack_, unpack_;
    std::optional<Scales> pixel_transfer_;
    std::optional<bool> debug_groups_;
};

}  // namespace brume::gl
