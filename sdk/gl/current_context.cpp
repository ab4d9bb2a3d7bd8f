#include "gl/current_context.h"

#include <dlfcn.h>

namespace brume::gl {

ContextQuery::ContextQuery()
    : egl_(find("libEGL.so.1", "eglGetCurrentContext")), glx_(find("libGLX.so.0", "glXGetCurrentContext"))
{
    if (!glx_.get_current)
        glx_ = find("libGL.so.1", "glXGetCurrentContext");  // drivers without GLVND
}

CurrentContext ContextQuery::current() const
{
    return {egl_.get_current ? egl_.get_current() : nullptr, glx_.get_current ? glx_.get_current() : nullptr};
}

// Only a library that the process has loaded already: loading GLX beside an EGL host, or the reverse, could fail or start
// a second driver, and a context of a library that is not there cannot be current.
ContextQuery::Function ContextQuery::find(const char *library, const char *function)
{
    Function found;
    if (void *handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD)) {
        found.library = {handle, dlclose};
        found.get_current = reinterpret_cast<void *(*)()>(dlsym(handle, function));
    }
    return found;
}

}  // namespace brume::gl
