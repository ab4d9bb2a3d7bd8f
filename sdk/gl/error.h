#pragma once
#include <string>

#include <epoxy/gl.h>

namespace brume::gl {

// "GL_INVALID_OPERATION", or the number of an unknown one.
std::string error_name(GLenum error);

// Clears GL's error flags; the first one set, GL_NO_ERROR if none was.
GLenum take_error();

// Throws Error(BRUME_ERROR_MEMORY or BRUME_ERROR_GL) if a flag is set; `what` names what was done.
void throw_on_error(const std::string &what);

}  // namespace brume::gl
