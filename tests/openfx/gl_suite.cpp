// The test host's textures: a picture is brought to one when it is loaded, and the output back when it is freed.
#include <vector>

#include <epoxy/gl.h>

#include "host.h"

namespace host {
namespace {

using namespace ofx;

constexpr const char *picture_name = "host's picture", *output_name = "host's output";

std::vector<float> packed(const Picture &picture)
{
    const RectI &b = picture.bounds;
    std::vector<float> pixels;
    for (int y = b.y1; y < b.y2; ++y)
        for (int x = b.x1; x < b.x2; ++x)
            for (int c = 0; c < picture.channels; ++c)
                pixels.push_back(picture.at(x, y, c));
    return pixels;
}

GLenum layout(const Picture &picture)
{
    return picture.channels == 4 ? GL_RGBA : picture.channels == 3 ? GL_RGB : GL_RED;
}

// The state that the plugin is tried on must not reach the host's own transfers.
struct Transfer {
    Transfer()
    {
        glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack);
        glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack);
        for (size_t i = 0; i < std::size(names); ++i) {
            glGetIntegerv(names[i], &values[i]);
            glPixelStorei(names[i], names[i] == GL_PACK_ALIGNMENT || names[i] == GL_UNPACK_ALIGNMENT ? 4 : 0);
        }
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    }
    ~Transfer()
    {
        for (size_t i = 0; i < std::size(names); ++i)
            glPixelStorei(names[i], values[i]);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(unpack));
        glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(pack));
    }
    static constexpr GLenum names[] = {GL_PACK_SWAP_BYTES,  GL_UNPACK_SWAP_BYTES,  GL_PACK_ROW_LENGTH, GL_UNPACK_ROW_LENGTH,
                                       GL_PACK_SKIP_PIXELS, GL_UNPACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS,  GL_UNPACK_SKIP_ROWS,
                                       GL_PACK_ALIGNMENT,   GL_UNPACK_ALIGNMENT};
    GLint values[std::size(names)], unpack, pack;
};

Status load(ClipHandle handle, Time, const char *, const RectD *, PropertySet *texture)
{
    Clip &clip = *reinterpret_cast<Clip *>(handle);
    if (!clip.picture)
        return failed;
    Picture &picture = *clip.picture;
    const int width = picture.bounds.x2 - picture.bounds.x1, height = picture.bounds.y2 - picture.bounds.y1;
    const GLenum format = picture.format          ? picture.format
                          : picture.channels == 4 ? GL_RGBA32F
                          : picture.channels == 3 ? GL_RGB32F
                                                  : GL_R32F;
    GLuint name = 0;
    const Transfer transfer;
    glCreateTextures(picture.target, 1, &name);
    if (picture.mipmapped) {
        glTextureStorage2D(name, 1, format, width, height);
    } else {
        glBindTexture(picture.target, name);
        glTexImage2D(picture.target, 0, GLint(format), width, height, 0, layout(picture), GL_FLOAT, nullptr);
        glBindTexture(picture.target, 0);
    }
    glTextureSubImage2D(name, 0, 0, 0, width, height, layout(picture), GL_FLOAT, packed(picture).data());
    auto *set = new Set(*picture.hand_out());
    set->values.erase(property::data);
    set->put<int>(property::texture, {int(name)});
    set->put<int>(property::texture_target, {int(picture.target)});
    set->put<void *>(picture_name, {&picture});
    set->put<int>(output_name, {clip.is_output});
    ++picture.textures;
    *texture = reinterpret_cast<PropertySet>(set);
    return ok;
}

Status free_texture(PropertySet texture)
{
    const std::unique_ptr<Set> set(reinterpret_cast<Set *>(texture));
    Picture &picture = *static_cast<Picture *>(set->get<void *>(picture_name));
    const auto name = GLuint(set->get<int>(property::texture));
    if (set->get<int>(output_name)) {
        const Transfer transfer;
        std::vector<float> pixels = packed(picture);
        glGetTextureImage(name, 0, layout(picture), GL_FLOAT, GLsizei(pixels.size() * sizeof(float)), pixels.data());
        const float *next = pixels.data();
        const RectI &b = picture.bounds;
        for (int y = b.y1; y < b.y2; ++y)
            for (int x = b.x1; x < b.x2; ++x)
                for (int c = 0; c < picture.channels; ++c)
                    picture.at(x, y, c) = *next++;
    }
    glDeleteTextures(1, &name);
    --picture.handed_out;
    return ok;
}

Status flush()
{
    return reply_default;
}

}  // namespace

extern const GlSuite gl_suite;
const GlSuite gl_suite = {load, free_texture, flush};

}  // namespace host
