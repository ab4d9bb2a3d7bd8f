#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

namespace brume::gl {

// The state of the host's context that passes and transfers change; docs/gl-state.md is its contract. What a piece of
// work does not touch is not even read: each function is called before the state it names is changed for the first
// time. At the end everything goes back (BRUME_GL_STATE_PRESERVE), to GL's initial values (DEFAULTS), or stays (OWNED).
class StateGuard {
public:
    // compatibility: the context has fixed-function pixel transfer, which would alter uploads.
    StateGuard(uint32_t mode, bool compatibility);
    ~StateGuard();
    StateGuard(const StateGuard &) = delete;
    StateGuard &operator=(const StateGuard &) = delete;

    void program();
    void texture_unit(GLuint unit);
    void image_unit(GLuint unit);
    // Also sets pixel-store state to tight rows from client memory, whatever the mode.
    void pixel_transfer();

    // GL's names of all guarded state, as docs/gl-state.md lists them.
    static std::vector<std::string> names();

private:
    struct TextureUnit {
        GLint texture, sampler;
    };
    struct ImageUnit {
        GLint texture, level, layered, layer, access, format;
    };
    static constexpr size_t pixel_store_count = 16;
    static constexpr size_t pixel_scale_count = 8;
    struct PixelTransfer {
        std::array<GLint, pixel_store_count> store;
        std::array<GLfloat, pixel_scale_count> scale;
        GLint map_color, pack_buffer, unpack_buffer;
    };

    PixelTransfer initial_pixel_transfer() const;
    PixelTransfer read_pixel_transfer() const;
    void set_pixel_transfer(const PixelTransfer &state) const;

    const uint32_t mode_;
    const bool compatibility_;
    bool resume_transform_feedback_ = false;
    std::optional<GLint> program_;
    std::optional<GLint> active_texture_;
    std::map<GLuint, TextureUnit> texture_units_;
    std::map<GLuint, ImageUnit> image_units_;
    std::optional<PixelTransfer> pixel_transfer_;
};

}  // namespace brume::gl
