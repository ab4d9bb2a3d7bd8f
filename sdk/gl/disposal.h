#pragma once
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "gl/borrowed_context.h"

namespace brume::gl {

// GL objects whose last owner let go of them wherever it happened to be; they are deleted when GL calls may be made.
class Disposal {
public:
    enum class Kind { texture, program, query };

    // borrowed: the host's context; none: a context that ends with its backend and takes its objects along.
    explicit Disposal(std::shared_ptr<const BorrowedContext> borrowed) : borrowed_(std::move(borrowed)) {}

    // On any thread.
    void add(Kind kind, GLuint name) noexcept;
    // These two where GL calls may be made. After close() an object of a borrowed context is deleted at once if that
    // context is current and is left to its context otherwise.
    void collect();
    void close();

private:
    static void destroy(Kind kind, GLuint name);

    const std::shared_ptr<const BorrowedContext> borrowed_;
    std::mutex mutex_;
    std::vector<std::pair<Kind, GLuint>> waiting_;
    bool closed_ = false;
};

}  // namespace brume::gl
