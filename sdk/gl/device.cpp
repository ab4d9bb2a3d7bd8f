#include "gl/device.h"

#include <epoxy/gl.h>

#include "base/error.h"
#include "gl/egl_context.h"
#include "gl/error.h"

namespace brume::gl {
namespace {

constexpr int needed_version = 45;

std::string text(GLenum name)
{
    const GLubyte *value = glGetString(name);
    return value ? reinterpret_cast<const char *>(value) : "";
}

// Empty if the current context will do, else why not.
std::string why_unusable(const ContextQuery &query)
{
    if (!query.current())
        return "no OpenGL context is current on the calling thread";
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < needed_version)
        return "the current context is \"" + text(GL_VERSION) + "\"; expected OpenGL 4.5 or later";
    return "";
}

}  // namespace

Device::Device(const GlOptions &options, const Log &log) : options_(options), log_(log)
{
    if (!options_.borrowed) {
        thread_ = std::make_unique<GlThread>();
        thread_->invoke([&] { read_properties(); });
        return;
    }
    const ContextQuery query;
    if (const std::string reason = why_unusable(query); !reason.empty())
        throw Error(BRUME_ERROR_GL, "borrowed OpenGL context: " + reason);
    report_host_error();
    borrowed_ = std::make_shared<BorrowedContext>(query);
    read_properties();
}

void Device::invoke(const std::function<void()> &work)
{
    if (thread_)
        return thread_->invoke([&] { surround(work); });
    if (guard_)
        return work();
    if (const std::string reason = borrowed_->why_not_current(); !reason.empty())
        throw Error(BRUME_ERROR_GL, reason);
    surround(work);
}

StateGuard &Device::guard()
{
    if (!guard_)
        throw Error(BRUME_ERROR_INTERNAL, "a GL backend was used outside invoke()");
    return *guard_;
}

void Device::read_properties()
{
    renderer_ = text(GL_RENDERER);
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    properties_.compatibility = profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT;
    glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &properties_.most_debug_groups);
}

void Device::surround(const std::function<void()> &work)
{
    if (guard_)
        return work();
    report_host_error();
    guard_.emplace(borrowed() ? options_.state : BRUME_GL_STATE_OWNED, properties_);
    try {
        // The host may have read the images to be written, or written those to be read, through shaders.
        if (borrowed())
            glMemoryBarrier(GL_ALL_BARRIER_BITS);
        work();
    } catch (...) {
        guard_.reset();
        take_error();
        throw;
    }
    guard_.reset();
    throw_on_error("running effects");
}

// An error flag that the host left cannot be put back once read, and left in place it would look like ours.
void Device::report_host_error() const
{
    const GLenum error = take_error();
    if (error != GL_NO_ERROR)
        log_(BRUME_LOG_WARNING,
             "an OpenGL error was pending before this call, and reading it cleared it: " + error_name(error));
}

bool renders_in_software()
{
    const std::string renderer = text(GL_RENDERER);
    for (const char *name : {"llvmpipe", "softpipe", "swrast", "SWR", "SwiftShader", "Software"})
        if (renderer.find(name) != std::string::npos)
            return true;
    return false;
}

}  // namespace brume::gl

namespace brume {

bool gl_is_hardware(const GlOptions &options)
{
    using namespace gl;
    if (options.borrowed)
        return why_unusable(ContextQuery()).empty() && !renders_in_software();
    static const bool owned = [] {
        try {
            GlThread thread;
            bool software = true;
            thread.invoke([&] { software = renders_in_software(); });
            return !software;
        } catch (const std::exception &) {
            return false;
        }
    }();
    return owned;
}

}  // namespace brume
