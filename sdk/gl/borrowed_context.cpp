#include "gl/borrowed_context.h"

#include <atomic>
#include <cstring>

#include "gl/error.h"

namespace brume::gl {
namespace {

// Of no other marker in this process, those of a second copy of this library included.
std::string new_label()
{
    static std::atomic<unsigned> count = 0;
    return "brume context " + std::to_string(++count) + " of " + std::to_string(reinterpret_cast<uintptr_t>(&count));
}

}  // namespace

// A program pipeline, because contexts of a share group do not share those: a new context of the group has our textures,
// but has its own queries under the names of ours.
BorrowedContext::BorrowedContext(const ContextQuery &query) : query_(query), context_(query.current()), label_(new_label())
{
    glCreateProgramPipelines(1, &marker_);
    glObjectLabel(GL_PROGRAM_PIPELINE, marker_, -1, label_.c_str());
}

BorrowedContext::~BorrowedContext()
{
    if (is_current())
        glDeleteProgramPipelines(1, &marker_);
}

std::string BorrowedContext::why_not_current() const
{
    const CurrentContext current = query_.current();
    if (!current)
        return "no OpenGL context is current on the calling thread; expected the one that the brume context was created in";
    if (current != context_)
        return "another OpenGL context is current than the one that the brume context was created in";
    if (!is_marked())
        return "the OpenGL context that the brume context was created in has been destroyed, and a new one is current at "
               "its "
               "address; expected the brume context to be destroyed first";
    return "";
}

// Where there is no such object, the question is an error, and so is the host's call.
bool BorrowedContext::is_marked() const
{
    char label[96] = {};
    glGetObjectLabel(GL_PROGRAM_PIPELINE, marker_, sizeof label, nullptr, label);
    if (label_ == label)
        return true;
    take_error();
    return false;
}

}  // namespace brume::gl
