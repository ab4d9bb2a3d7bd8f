#pragma once
#include <cstdint>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace brume::test {

enum class Profile { core, compatibility, es };

// A host's context: made here and current on this thread while it lives.
class HostContext {
public:
    explicit HostContext(Profile profile = Profile::core);
    ~HostContext();
    HostContext(const HostContext &) = delete;
    HostContext &operator=(const HostContext &) = delete;
    void make_current() const;
    void release() const;

private:
    EGLDisplay display_;
    EGLContext context_;
};

// Immutable, one level.
GLuint make_texture(GLenum format, int32_t width, int32_t height);

}  // namespace brume::test
