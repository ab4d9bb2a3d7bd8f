#pragma once
#include <memory>

namespace brume::gl {

// Which OpenGL context is current on a thread, whoever made it: EGL or GLX.
struct CurrentContext {
    void *egl = nullptr;
    void *glx = nullptr;

    explicit operator bool() const { return egl || glx; }
    bool operator==(const CurrentContext &) const = default;
};

// Asks the window-system libraries that the process has loaded when this is made: the dynamic loader takes a lock that
// frames should not wait for.
class ContextQuery {
public:
    ContextQuery();

    CurrentContext current() const;

private:
    struct Function {
        std::shared_ptr<void> library;
        void *(*get_current)() = nullptr;
    };
    static Function find(const char *library, const char *function);

    Function egl_, glx_;
};

}  // namespace brume::gl
