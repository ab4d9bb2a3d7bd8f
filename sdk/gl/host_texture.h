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
    bool depth;
};

// Throws Error unless it exists, is two-dimensional, and sampled as it is stored.
HostTexture inspect(GLuint name, const std::string &what, StateGuard &guard);

// Whether a texture of that name still has what inspect() found of its storage: the format, and the size.
bool has_format(const HostTexture &texture);
bool has_size(const HostTexture &texture);
// What its owner may change while it lives.
void require_plain_sampling(const HostTexture &texture, const std::string &what);

// A minification filter that wants mipmaps makes a texture without them incomplete for image stores and copies; samplers of
// our own read it all the same. Returns whether it stays complete while it lives.
bool require_complete(const HostTexture &texture, const std::string &what);

// What the image says of itself, of which OpenGL is not asked.
HostTexture trusted(const brume_image &image, const std::string &what);

void require_size(const HostTexture &texture, const brume_image &image, const std::string &what);

// Throw Error where this kind of texture does not serve as an image of that many channels (1: depth or blur radius).
void require_readable(const HostTexture &texture, int32_t channels, const std::string &what);
void require_writable(const HostTexture &texture, int32_t channels, const std::string &what);

// The texture itself as an image.
std::shared_ptr<GlImage> wrap(const HostTexture &texture);

}  // namespace brume::gl
