#include "gl/error.h"

#include "base/error.h"

namespace brume::gl {

std::string error_name(GLenum error)
{
    switch (error) {
    case GL_NO_ERROR:
        return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_STACK_UNDERFLOW:
        return "GL_STACK_UNDERFLOW";
    case GL_STACK_OVERFLOW:
        return "GL_STACK_OVERFLOW";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "GL error " + std::to_string(error);
    }
}

GLenum take_error()
{
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR)
        return first;
    // Bounded: a lost context may report GL_CONTEXT_LOST for ever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    }
    return first;
}

void throw_on_error(const std::string &what)
{
    const GLenum error = take_error();
    if (error == GL_NO_ERROR)
        return;
    throw Error(error == GL_OUT_OF_MEMORY ? BRUME_ERROR_MEMORY : BRUME_ERROR_GL,
                what + ": OpenGL reports " + error_name(error));
}

}  // namespace brume::gl
