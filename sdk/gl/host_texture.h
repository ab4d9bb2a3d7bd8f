#pragma once
#include <memory>
#include <string>

#include <brume/brume.h>

#include "gl/image.h"
#include "gl/state_guard.h"

namespace brume::gl {

// A texture of the host's, looked at but not changed.
struct HostTexture {
    GLuint name;
    GLint width, height;
    GLenum format;  // internal
    bool color;     // floating-point or normalised, with red, green and blue
    bool scalar;    // one floating-point channel, or depth
};

// Throws Error unless it exists, is two-dimensional, complete, and sampled as it is stored.
HostTexture inspect(GLuint name, const std::string &what, StateGuard &guard);

// What the image says of itself, of which OpenGL is not asked.
HostTexture trusted(const brume_image &image, const std::string &what);

void require_size(const HostTexture &texture, const brume_image &image, const std::string &what);

// Throw Error where this kind of texture does not serve as an image of that many channels (1: depth or blur radius).
void require_readable(const HostTexture &texture, int32_t channels, const std::string &what);
void require_writable(const HostTexture &texture, int32_t channels, const std::string &what);

// The texture itself as an image.
std::shared_ptr<GlImage> wrap(const HostTexture &texture);

}  // namespace brume::gl
