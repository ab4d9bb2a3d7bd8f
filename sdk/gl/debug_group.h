#pragma once
#include <algorithm>
#include <string>

#include "gl/state_guard.h"

namespace brume::gl {

// Names what happens in captures and debug logs; nothing where the host has filled the stack of groups.
class DebugGroup {
public:
    DebugGroup(const std::string &name, StateGuard &guard) : pushed_(guard.debug_groups())
    {
        if (pushed_)
            glPushDebugGroup(GL_DEBUG_SOURCE_THIRD_PARTY, 0, GLsizei(std::min<size_t>(name.size(), 200)), name.data());
    }
    ~DebugGroup()
    {
        if (pushed_)
            glPopDebugGroup();
    }
    DebugGroup(const DebugGroup &) = delete;
    DebugGroup &operator=(const DebugGroup &) = delete;

    // OpenGL's errors are not logged in this group.
    void silence_errors() const
    {
        if (pushed_)
            glDebugMessageControl(GL_DEBUG_SOURCE_API, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    }

private:
    const bool pushed_;
};

}  // namespace brume::gl
