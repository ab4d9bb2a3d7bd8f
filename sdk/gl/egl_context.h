#pragma once
#include <string>

namespace brume::gl {

// A headless OpenGL 4.5 core context: from an EGL device (hardware before software), else surfaceless, else from the
// default display. Current on the thread that made it, which must also destroy it.
class EglContext {
public:
    // Throws Error(BRUME_ERROR_GL) that lists every attempt with the step that failed.
    EglContext();
    ~EglContext();
    EglContext(const EglContext &) = delete;
    EglContext &operator=(const EglContext &) = delete;

private:
    bool attempt(void *display, const std::string &name, std::string &failures);

    void *display_ = nullptr;
    void *context_ = nullptr;
};

}  // namespace brume::gl
