#include "host_context.h"

#include <stdexcept>

namespace brume::test {

HostContext::HostContext(Profile profile)
{
    EGLDeviceEXT device;
    EGLint count = 0;
    if (!eglQueryDevicesEXT(1, &device, &count) || count < 1)
        throw std::runtime_error("no EGL device");
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    eglInitialize(display_, nullptr, nullptr);
    const EGLint desktop[] = {EGL_CONTEXT_MAJOR_VERSION,
                              4,
                              EGL_CONTEXT_MINOR_VERSION,
                              5,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              profile == Profile::compatibility ? EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT
                                                                : EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    const EGLint embedded[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    eglBindAPI(profile == Profile::es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, profile == Profile::es ? embedded : desktop);
    if (context_ == EGL_NO_CONTEXT)
        throw std::runtime_error("no OpenGL context for the test");
    make_current();
}

HostContext::~HostContext()
{
    if (eglGetCurrentContext() == context_)
        release();
    eglDestroyContext(display_, context_);
}

void HostContext::make_current() const
{
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        throw std::runtime_error("eglMakeCurrent failed");
}

void HostContext::release() const
{
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

GLuint make_texture(GLenum format, int32_t width, int32_t height)
{
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, width, height);
    return texture;
}

}  // namespace brume::test
