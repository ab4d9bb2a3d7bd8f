#include "api/backends.h"

#include "base/error.h"
#ifdef BRUME_GL
#include "gl/gl_backend.h"
#endif

namespace brume {

std::unique_ptr<Backend> make_backend(const brume_context_desc &desc, const Log &log)
{
#ifdef BRUME_GL
    const GlOptions gl{desc.gl_context == BRUME_GL_BORROWED, desc.gl_state};
    if (desc.backend == BRUME_BACKEND_GL || (desc.backend == BRUME_BACKEND_AUTO && gl_is_hardware(gl)))
        return make_gl_backend(gl, log);
#else
    (void)log;
    if (desc.backend == BRUME_BACKEND_GL)
        throw Error(BRUME_ERROR_GL, "backend: BRUME_BACKEND_GL; this build has no OpenGL backend (BRUME_GL=OFF)");
#endif
    return make_cpu_backend(desc.threads);
}

}  // namespace brume
