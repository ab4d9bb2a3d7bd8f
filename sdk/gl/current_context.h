#pragma once

namespace brume::gl {

// Which OpenGL context is current on the calling thread, whoever made it: EGL or GLX.
struct CurrentContext {
    void *egl = nullptr;
    void *glx = nullptr;

    explicit operator bool() const { return egl || glx; }
    bool operator==(const CurrentContext &) const = default;
};

CurrentContext current_context();

}  // namespace brume::gl
