#include "gl/disposal.h"

namespace brume::gl {

void Disposal::add(Kind kind, GLuint name) noexcept
{
    std::lock_guard lock(mutex_);
    if (!closed_)
        waiting_.emplace_back(kind, name);
    else if (borrowed_ && borrowed_->is_current())
        destroy(kind, name);
}

void Disposal::collect()
{
    std::lock_guard lock(mutex_);
    for (const auto &[kind, name] : waiting_)
        destroy(kind, name);
    waiting_.clear();
}

void Disposal::close()
{
    collect();
    std::lock_guard lock(mutex_);
    closed_ = true;
}

void Disposal::destroy(Kind kind, GLuint name)
{
    switch (kind) {
    case Kind::texture:
        glDeleteTextures(1, &name);
        break;
    case Kind::program:
        glDeleteProgram(name);
        break;
    case Kind::query:
        glDeleteQueries(1, &name);
        break;
    }
}

}  // namespace brume::gl
