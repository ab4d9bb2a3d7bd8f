#include "gl/egl_context.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "base/error.h"

namespace brume::gl {
namespace {

std::string egl_error()
{
    switch (EGLint error = eglGetError()) {
    case EGL_SUCCESS:
        return "no EGL error given";
    case EGL_NOT_INITIALIZED:
        return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
        return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
        return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
        return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
        return "EGL_BAD_CONFIG";
    case EGL_BAD_DISPLAY:
        return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
        return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER:
        return "EGL_BAD_PARAMETER";
    default:
        return "EGL error " + std::to_string(error);
    }
}

bool listed(const char *extensions, std::string_view name)
{
    std::string_view rest = extensions ? extensions : "";
    while (!rest.empty()) {
        size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == name)
            return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

std::vector<EGLDeviceEXT> devices_hardware_first()
{
    EGLint count = 0;
    eglQueryDevicesEXT(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(size_t(std::max(count, 0)));
    if (!eglQueryDevicesEXT(count, devices.data(), &count))
        return {};
    devices.resize(size_t(count));
    std::stable_partition(devices.begin(), devices.end(), [](EGLDeviceEXT device) {
        return !listed(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
    });
    return devices;
}

}  // namespace

EglContext::EglContext()
{
    if (!epoxy_has_egl())
        throw Error(BRUME_ERROR_GL, "no headless OpenGL context: libEGL cannot be loaded");

    // epoxy ends the process when a function of an absent extension is called: ask first.
    const char *client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    eglGetError();
    const bool platforms = listed(client, "EGL_EXT_platform_base");
    std::string failures;

    if (platforms && listed(client, "EGL_EXT_platform_device") &&
        (listed(client, "EGL_EXT_device_enumeration") || listed(client, "EGL_EXT_device_base"))) {
        int index = 0;
        std::vector<EGLDeviceEXT> devices = devices_hardware_first();
        for (EGLDeviceEXT device : devices)
            if (attempt(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                        "EGL device " + std::to_string(index++), failures))
                return;
        if (devices.empty())
            failures += "; EGL devices: eglQueryDevicesEXT found none";
    } else {
        failures += "; EGL devices: EGL_EXT_platform_device or EGL_EXT_device_enumeration is missing";
    }

    if (platforms && listed(client, "EGL_MESA_platform_surfaceless")) {
        if (attempt(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "surfaceless",
                    failures))
            return;
    } else {
        failures += "; surfaceless: EGL_MESA_platform_surfaceless is missing";
    }

    if (attempt(eglGetDisplay(EGL_DEFAULT_DISPLAY), "default display", failures))
        return;
    throw Error(BRUME_ERROR_GL, "no headless OpenGL 4.5 core context" + failures);
}

// Displays are never terminated: EGL has one per device and process, so that would take the contexts of the host and of
// other Brume contexts away.
EglContext::~EglContext()
{
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglReleaseThread();
}

bool EglContext::attempt(void *display, const std::string &name, std::string &failures)
{
    auto failed = [&](const std::string &step, const std::string &reason) {
        failures += "; " + name + ": " + step + ": " + reason;
        return false;
    };
    if (display == EGL_NO_DISPLAY)
        return failed("display", egl_error());
    if (!eglInitialize(display, nullptr, nullptr))
        return failed("eglInitialize", egl_error());
    const char *extensions = eglQueryString(display, EGL_EXTENSIONS);
    for (const char *needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
        if (!listed(extensions, needed))
            return failed("extensions", std::string(needed) + " is missing");
    if (!eglBindAPI(EGL_OPENGL_API))
        return failed("eglBindAPI(EGL_OPENGL_API)", egl_error());

    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT)
        return failed("eglCreateContext (OpenGL 4.5 core)", egl_error());
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        failed("eglMakeCurrent without surfaces", egl_error());
        eglDestroyContext(display, context);
        return false;
    }
    display_ = display;
    context_ = context;
    return true;
}

}  // namespace brume::gl
