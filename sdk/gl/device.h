#pragma once
#include <memory>
#include <optional>
#include <string>

#include "gl/borrowed_context.h"
#include "gl/gl_backend.h"
#include "gl/gl_thread.h"
#include "gl/state_guard.h"

namespace brume::gl {

// Where GL calls are made, the owned context on its thread or the borrowed one on the caller's, and what surrounds
// them: the right context, the state guard, and errors that are not mistaken for each other's.
class Device {
public:
    // Throws Error(BRUME_ERROR_GL) where there is no OpenGL 4.5.
    Device(const GlOptions &options, const Log &log);

    bool borrowed() const { return borrowed_ != nullptr; }
    // Whether others use the context too.
    bool shared() const { return borrowed() && options_.state != BRUME_GL_STATE_OWNED; }
    const std::shared_ptr<const BorrowedContext> &borrowed_context() const { return borrowed_; }
    const std::string &renderer() const { return renderer_; }

    void invoke(const std::function<void()> &work);
    // Throws Error(BRUME_ERROR_INTERNAL) outside invoke().
    StateGuard &guard();

private:
    void read_properties();
    void surround(const std::function<void()> &work);
    void report_host_error() const;

    const GlOptions options_;
    const Log log_;
    std::shared_ptr<const BorrowedContext> borrowed_;
    std::unique_ptr<GlThread> thread_;
    std::string renderer_;
    ContextProperties properties_;
    std::optional<StateGuard> guard_;
};

// Of the current context.
bool renders_in_software();

}  // namespace brume::gl
