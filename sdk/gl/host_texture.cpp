#include "gl/host_texture.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/image_memory.h"
#include "base/recycling_allocator.h"
#include "gl/debug_group.h"
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

// Mesa answers GL_TEXTURE_TARGET in core profiles only, and no OpenGL does for buffer textures, which have one row. Else
// binding tells, by an error that must not reach the debug log of the host.
bool is_2d(GLuint texture, GLint height, StateGuard &guard)
{
    if (!guard.compatibility() && height > 1)
        return parameter(texture, GL_TEXTURE_TARGET) == GL_TEXTURE_2D;
    throw_on_error("before looking at textures");
    guard.texture_unit(0);
    const DebugGroup group("brume: look at textures", guard);
    group.silence_errors();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture);
    return take_error() == GL_NO_ERROR;
}

// Whether it can be read as colour or as one channel, or is depth. Formats in common use are known by name,
// which spares four questions to the driver.
void classify(HostTexture &texture)
{
    switch (texture.format) {
    case GL_RGBA16F:
    case GL_RGBA32F:
    case GL_R11F_G11F_B10F:
    case GL_RGB10_A2:
        texture.color = true;
        return;
    case GL_R16:
    case GL_R16F:
    case GL_R32F:
    case GL_RG32F:
        texture.scalar = true;
        return;
    case GL_DEPTH_COMPONENT16:
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32F:
    case GL_DEPTH24_STENCIL8:
    case GL_DEPTH32F_STENCIL8:
        texture.scalar = texture.depth = true;
        return;
    default:
        break;
    }
    const auto real = [&](GLenum component) {
        const GLint type = level_parameter(texture.name, 0, component);
        return type == GL_FLOAT || type == GL_UNSIGNED_NORMALIZED || type == GL_SIGNED_NORMALIZED;
    };
    texture.scalar = texture.depth = real(GL_TEXTURE_DEPTH_TYPE);
    texture.color = real(GL_TEXTURE_RED_TYPE) && real(GL_TEXTURE_GREEN_TYPE) && real(GL_TEXTURE_BLUE_TYPE);
}

}  // namespace

HostTexture inspect(GLuint name, const std::string &what, StateGuard &guard)
{
    if (!glIsTexture(name))
        refuse(BRUME_ERROR_ARGUMENT, what, name, "does not exist in the current context");
    HostTexture texture{};
    texture.name = name;
    texture.width = level_parameter(name, 0, GL_TEXTURE_WIDTH);
    texture.height = level_parameter(name, 0, GL_TEXTURE_HEIGHT);
    if (!is_2d(name, texture.height, guard))
        refuse(BRUME_ERROR_UNSUPPORTED, what, name, "is no GL_TEXTURE_2D");
    texture.format = GLenum(level_parameter(name, 0, GL_TEXTURE_INTERNAL_FORMAT));
    if (texture.width == 0)
        refuse(BRUME_ERROR_ARGUMENT, what, name, "has no level 0");

    classify(texture);
    if (!texture.color && !texture.scalar)
        refuse(BRUME_ERROR_UNSUPPORTED, what, name,
               "is " + format_text(texture.format) +
                   "; expected a floating-point or normalised format with red, green and "
                   "blue for colour, GL_R16, GL_R16F, GL_R32F, GL_RG32F or a depth format for depth");
    require_plain_sampling(texture, what);
    return texture;
}

bool require_complete(const HostTexture &looked_at, const std::string &what)
{
    const GLuint texture = looked_at.name;
    if (parameter(texture, GL_TEXTURE_IMMUTABLE_FORMAT))
        return true;
    const GLint filter = parameter(texture, GL_TEXTURE_MIN_FILTER);
    if (filter == GL_NEAREST || filter == GL_LINEAR)
        return false;
    int last = 0;
    for (int32_t side = std::max(looked_at.width, looked_at.height); side > 1; side /= 2)
        ++last;
    last = std::min(last, parameter(texture, GL_TEXTURE_MAX_LEVEL));
    for (int level = 1; level <= last; ++level)
        if (level_parameter(texture, level, GL_TEXTURE_WIDTH) != std::max(1, looked_at.width >> level))
            refuse(BRUME_ERROR_ARGUMENT, what, texture,
                   "is incomplete: its GL_TEXTURE_MIN_FILTER wants mipmaps and level " + std::to_string(level) +
                       " is missing; expected all levels, GL_NEAREST, GL_LINEAR or GL_TEXTURE_MAX_LEVEL 0");
    return false;
}

// What is gone answers nothing, by an error.
bool has_format(const HostTexture &texture)
{
    const bool has = GLenum(level_parameter(texture.name, 0, GL_TEXTURE_INTERNAL_FORMAT)) == texture.format;
    if (!has)
        take_error();
    return has;
}

bool has_size(const HostTexture &texture)
{
    return level_parameter(texture.name, 0, GL_TEXTURE_WIDTH) == texture.width &&
           level_parameter(texture.name, 0, GL_TEXTURE_HEIGHT) == texture.height;
}

// Reads would go through the swizzle and writes and copies would not: no result would be right for both.
void require_plain_sampling(const HostTexture &texture, const std::string &what)
{
    if (texture.depth && parameter(texture.name, GL_DEPTH_STENCIL_TEXTURE_MODE) != GL_DEPTH_COMPONENT)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is sampled as stencil; expected GL_DEPTH_STENCIL_TEXTURE_MODE GL_DEPTH_COMPONENT");
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

HostTexture trusted(const brume_image &image, const std::string &what)
{
    const bool scalar = image.channels == 1, color = image.channels >= 3;
    if (!scalar && !color)
        refuse(BRUME_ERROR_ARGUMENT, what, image.gl_texture,
               "is trusted with " + std::to_string(image.channels) + " channels; expected 1, 3 or 4");
    const brume_image whole = whole_of(image);
    return {image.gl_texture, whole.width, whole.height, image_format(scalar ? 1 : 4, image.pixel), color, scalar, false};
}

void require_size(const HostTexture &texture, const brume_image &image, const std::string &what)
{
    const brume_image whole = whole_of(image);
    if (texture.width != whole.width || texture.height != whole.height)
        refuse(BRUME_ERROR_ARGUMENT, what, texture.name,
               "is " + std::to_string(texture.width) + " x " + std::to_string(texture.height) + "; the image says " +
                   extent_text(image) + (is_part(image) ? "" : ", and no whole_width x whole_height that it is a part of"));
}

void require_readable(const HostTexture &texture, int32_t channels, const std::string &what)
{
    if (channels == 1 && !texture.scalar)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is " + format_text(texture.format) + "; expected GL_R16, GL_R16F, GL_R32F, GL_RG32F or a depth format");
    if (channels == 4 && !texture.color)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is " + format_text(texture.format) + "; expected a format with red, green and blue");
}

void require_writable(const HostTexture &texture, int32_t channels, const std::string &what)
{
    const bool own = channels == 1 ? texture.format == GL_R16F || texture.format == GL_R32F
                                   : texture.format == GL_R11F_G11F_B10F || texture.format == GL_RGB10_A2;
    if (texture.format != GL_RGBA16F && texture.format != GL_RGBA32F && !own)
        refuse(BRUME_ERROR_UNSUPPORTED, what, texture.name,
               "is " + format_text(texture.format) + "; expected GL_RGBA16F, GL_RGBA32F, " +
                   (channels == 1 ? "GL_R16F or GL_R32F" : "GL_R11F_G11F_B10F or GL_RGB10_A2") + " for an output");
}

std::shared_ptr<GlImage> wrap(const HostTexture &texture)
{
    auto image = std::allocate_shared<GlImage>(RecyclingAllocator<GlImage>());
    image->width = texture.width;
    image->height = texture.height;
    image->channels = texture.scalar ? 1 : 4;
    image->format = texture.format;
    image->texture = texture.name;
    return image;
}

}  // namespace brume::gl
