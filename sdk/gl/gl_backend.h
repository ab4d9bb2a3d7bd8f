#pragma once
#include <cstdint>
#include <memory>

#include "plan/backend.h"

namespace brume {

struct GlOptions {
    bool borrowed = false;
    uint32_t state = BRUME_GL_STATE_PRESERVE;
};

// Throws Error(BRUME_ERROR_GL) that names the step that failed.
std::unique_ptr<Backend> make_gl_backend(const GlOptions &options, const Log &log);

// For BRUME_BACKEND_AUTO: a real GPU is there (for borrowed: the current context is one and is 4.5 or later).
bool gl_is_hardware(const GlOptions &options);

}  // namespace brume
