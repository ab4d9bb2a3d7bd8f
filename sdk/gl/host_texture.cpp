#include "gl/host_texture.h"

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "gl/error.h"

namespace brume::gl {
namespace {

GLint parameter(GLuint texture, GLenum name)
{
    GLint value = 0;
    glGetTextureParameteriv(texture, name, &value);
    return value;
}

GLint level_parameter(GLuint texture, GLint level, GLenum name)
{
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, level, name, &value);
    return value;
}

std::string hex(GLenum value)
{
    char text[16];
    std::snprintf(text, sizeof text, "0x%04X", value);
    return text;
}

std::string format_text(GLenum format)
{
    switch (format) {
    case GL_R16F:
        return "GL_R16F";
    case GL_R32F:
        return "GL_R32F";
    case GL_RG16F:
        return "GL_RG16F";
    case GL_RG32F:
        return "GL_RG32F";
    case GL_RGB16F:
        return "GL_RGB16F";
    case GL_RGB32F:
        return "GL_RGB32F";
    case GL_RGBA16F:
        return "GL_RGBA16F";
    case GL_RGBA32F:
        return "GL_RGBA32F";
    case GL_R8:
        return "GL_R8";
    case GL_RGBA8:
        return "GL_RGBA8";
    case GL_R11F_G11F_B10F:
        return "GL_R11F_G11F_B10F";
    case GL_DEPTH_COMPONENT16:
        return "GL_DEPTH_COMPONENT16";
    case GL_DEPTH_COMPONENT24:
        return "GL_DEPTH_COMPONENT24";
    case GL_DEPTH_COMPONENT32F:
        return "GL_DEPTH_COMPONENT32F";
    case GL_DEPTH24_STENCIL8:
        return "GL_DEPTH24_STENCIL8";
    case GL_DEPTH32F_STENCIL8:
        return "GL_DEPTH32F_STENCIL8";
    default:
        return "internal format " + hex(format);
    }
}

[[noreturn]] void refuse(brume_status status, const std::string &what, GLuint texture, const std::string &problem)
{
    throw Error(status, what + ": texture " + std::to_string(texture) + " " + problem);
}

// A minification filter that wants mipmaps makes a texture without them incomplete, for image stores and copies too.
void require_complete(const brume_image &image, const std::string &what)
{
    const GLuint texture = image.gl_texture;
    const GLint filter = parameter(texture, GL_TEXTURE_MIN_FILTER);
    if (parameter(texture, GL_TEXTURE_IMMUTABLE_FORMAT) || filter == GL_NEAREST || filter == GL_LINEAR)
        return;
    int last = 0;
    for (int32_t side = std::max(image.width, image.height); side > 1; side /= 2)
        ++last;
    last = std::min(last, parameter(texture, GL_TEXTURE_MAX_LEVEL));
    for (int level = 1; level <= last; ++level)
        if (level_parameter(texture, level, GL_TEXTURE_WIDTH) != std::max(1, image.width >> level))
            refuse(BRUME_ERROR_ARGUMENT, what, texture,
                   "is incomplete: its GL_TEXTURE_MIN_FILTER wants mipmaps and level " + std::to_string(level) +
                       " is missing; expected all levels, GL_NEAREST, GL_LINEAR or GL_TEXTURE_MAX_LEVEL 0");
}

// Reads would go through the swizzle and writes and copies would not: no result would be right for both.
void require_plain_sampling(const HostTexture &texture, const std::string &what)
{
    const GLint base = parameter(texture.name, GL_TEXTURE_BASE_LEVEL);
    if (base != 0)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "has GL_TEXTURE_BASE_LEVEL " + std::to_string(base) + "; expected 0");
    GLint swizzle[4] = {};
    glGetTextureParameteriv(texture.name, GL_TEXTURE_SWIZZLE_RGBA, swizzle);
    const GLint plain[] = {GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA};
    for (int i = 0; i < (texture.scalar ? 1 : 4); ++i)
        if (swizzle[i] != plain[i])
            refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
                   "is swizzled (GL_TEXTURE_SWIZZLE_RGBA); expected the initial swizzle");
}

}  // namespace

HostTexture inspect(const brume_image &image, const std::string &what, StateGuard &guard)
{
    const GLuint name = image.gl_texture;
    if (!glIsTexture(name))
        refuse(BRUME_ERROR_ARGUMENT, what, name, "does not exist in the current context");
    // By binding: Mesa answers GL_TEXTURE_TARGET in core profiles only.
    throw_on_error("before looking at textures");
    guard.texture_unit(0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, name);
    if (take_error() != GL_NO_ERROR)
        refuse(BRUME_ERROR_UNSUPPORTED, what, name, "is no GL_TEXTURE_2D");

    HostTexture texture{};
    texture.name = name;
    texture.width = level_parameter(name, 0, GL_TEXTURE_WIDTH);
    texture.height = level_parameter(name, 0, GL_TEXTURE_HEIGHT);
    texture.format = GLenum(level_parameter(name, 0, GL_TEXTURE_INTERNAL_FORMAT));
    if (texture.width == 0)
        refuse(BRUME_ERROR_ARGUMENT, what, name, "has no level 0");
    if (texture.width != image.width || texture.height != image.height)
        refuse(BRUME_ERROR_ARGUMENT, what, name,
               "is " + std::to_string(texture.width) + " x " + std::to_string(texture.height) + "; the image says " +
                   std::to_string(image.width) + " x " + std::to_string(image.height));

    const auto real = [&](GLenum component) {
        const GLint type = level_parameter(name, 0, component);
        return type == GL_FLOAT || type == GL_UNSIGNED_NORMALIZED || type == GL_SIGNED_NORMALIZED;
    };
    const bool depth = real(GL_TEXTURE_DEPTH_TYPE);
    texture.color = real(GL_TEXTURE_RED_TYPE) && real(GL_TEXTURE_GREEN_TYPE) && real(GL_TEXTURE_BLUE_TYPE);
    texture.scalar = depth || texture.format == GL_R16F || texture.format == GL_R32F;
    if (!texture.color && !texture.scalar)
        refuse(BRUME_ERROR_UNSUPPORTED, what, name,
               "is " + format_text(texture.format) +
                   "; expected a floating-point or normalised format with red, green and "
                   "blue for colour, GL_R16F, GL_R32F or a depth format for depth");
    if (depth && parameter(name, GL_DEPTH_STENCIL_TEXTURE_MODE) != GL_DEPTH_COMPONENT)
        refuse(BRUME_ERROR_UNSUPPORTED, what, name,
               "is sampled as stencil; expected GL_DEPTH_STENCIL_TEXTURE_MODE GL_DEPTH_COMPONENT");
    require_complete(image, what);
    require_plain_sampling(texture, what);
    return texture;
}

void require_readable(const HostTexture &texture, int32_t channels, const std::string &what)
{
    if (channels == 1 && !texture.scalar)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is " + format_text(texture.format) + "; expected GL_R16F, GL_R32F or a depth format");
    if (channels == 4 && !texture.color)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is " + format_text(texture.format) + "; expected a format with red, green and blue");
}

void require_writable(const HostTexture &texture, int32_t channels, const std::string &what)
{
    const bool scalar = texture.format == GL_R16F || texture.format == GL_R32F;
    if (texture.format != GL_RGBA16F && texture.format != GL_RGBA32F && !(channels == 1 && scalar))
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is " + format_text(texture.format) + "; expected GL_RGBA16F or GL_RGBA32F" +
                   (channels == 1 ? ", GL_R16F or GL_R32F" : "") + " for an output");
}

std::shared_ptr<GlImage> wrap(const HostTexture &texture)
{
    auto image = std::make_shared<GlImage>();
    image->width = texture.width;
    image->height = texture.height;
    image->channels = texture.scalar ? 1 : 4;
    image->format = texture.format;
    image->texture = texture.name;
    return image;
}

}  // namespace brume::gl
