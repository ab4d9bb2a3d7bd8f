#pragma once
#include <string>

#include <epoxy/gl.h>

#include "gl/current_context.h"

namespace brume::gl {

// The host's context, known by more than its address: a context that is made anew often gets the address of the one before
// it, and the names of our objects would then be those of the host's.
class BorrowedContext {
public:
    // Of what is current, which must be OpenGL 4.5: leaves a labelled object there.
    explicit BorrowedContext(const ContextQuery &query);
    // Takes that object away where the context is still current.
    ~BorrowedContext();
    BorrowedContext(const BorrowedContext &) = delete;
    BorrowedContext &operator=(const BorrowedContext &) = delete;

    bool is_current() const { return why_not_current().empty(); }
    // Empty, or a message for who expected it.
    std::string why_not_current() const;

private:
    bool is_marked() const;

    const ContextQuery query_;
    const CurrentContext context_;
    const std::string label_;
    GLuint marker_ = 0;
};

}  // namespace brume::gl
