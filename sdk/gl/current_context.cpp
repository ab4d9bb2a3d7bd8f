#include "gl/current_context.h"

#include <dlfcn.h>

namespace brume::gl {
namespace {

// Asks only a library that the process has loaded already: loading GLX beside an EGL host, or the reverse, could fail
// or start a second driver, and a context of a library that is not there cannot be current.
void *ask(const char *library, const char *function)
{
    void *handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
    if (!handle)
        return nullptr;
    auto get_current = reinterpret_cast<void *(*)()>(dlsym(handle, function));
    void *context = get_current ? get_current() : nullptr;
    dlclose(handle);
    return context;
}

}  // namespace

CurrentContext current_context()
{
    CurrentContext current;
    current.egl = ask("libEGL.so.1", "eglGetCurrentContext");
    current.glx = ask("libGLX.so.0", "glXGetCurrentContext");
    if (!current.glx)
        current.glx = ask("libGL.so.1", "glXGetCurrentContext");  // drivers without GLVND
    return current;
}

}  // namespace brume::gl
