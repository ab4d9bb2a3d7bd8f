#include "gl_calls.h"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include <epoxy/gl.h>

namespace brume::test {
namespace {

// Stands in for one of epoxy's function pointers.
template <auto &pointer, class = std::remove_reference_t<decltype(pointer)>> struct Counted;
template <auto &pointer, class Result, class... Arguments> struct Counted<pointer, Result (*)(Arguments...)> {
    static inline Result (*real)(Arguments...) = nullptr;
    static inline int calls = 0;

    static Result call(Arguments... arguments)
    {
        ++calls;
        // epoxy's first call of a function puts the driver's in the pointer.
        struct Keep {
            ~Keep()
            {
                if (pointer != call)
                    real = std::exchange(pointer, call);
            }
        } keep;
        return real(arguments...);
    }
    static void install()
    {
        calls = 0;
        real = std::exchange(pointer, call);
    }
    static void remove() { pointer = real; }
};

template <class Visitor> void for_each(Visitor visit)
{
#define VISIT(function) visit(#function, Counted<epoxy_##function>())
    VISIT(glGetBooleanv);
    VISIT(glGetError);
    VISIT(glGetFloatv);
    VISIT(glGetInteger64v);
    VISIT(glGetIntegeri_v);
    VISIT(glGetIntegerv);
    VISIT(glGetInternalformativ);
    VISIT(glGetObjectLabel);
    VISIT(glGetProgramiv);
    VISIT(glGetString);
    VISIT(glGetTextureLevelParameteriv);
    VISIT(glGetTextureParameteriv);
    VISIT(glGetUniformLocation);
    VISIT(glIsEnabled);
    VISIT(glIsProgramPipeline);
    VISIT(glIsSampler);
    VISIT(glIsTexture);
#undef VISIT
}

}  // namespace

QueryCount::QueryCount()
{
    for_each([](const char *, auto function) { function.install(); });
}

QueryCount::~QueryCount()
{
    for_each([](const char *, auto function) { function.remove(); });
}

std::map<std::string, int> QueryCount::calls()
{
    std::map<std::string, int> calls;
    for_each([&](const char *name, auto function) { calls[name] = function.calls; });
    return calls;
}

int QueryCount::of(const std::string &function)
{
    return calls().at(function);
}

int QueryCount::total()
{
    int sum = 0;
    for (const auto &[name, count] : calls())
        sum += count;
    return sum;
}

std::string QueryCount::list()
{
    std::string text;
    for (const auto &[name, count] : calls())
        if (count > 0)
            text += name + " " + std::to_string(count) + "\n";
    return text;
}

namespace {

std::map<GLuint, uint64_t> bytes_of_textures;
PFNGLTEXTURESTORAGE2DPROC storage = nullptr;
PFNGLDELETETEXTURESPROC deletion = nullptr;

uint64_t texel_bytes(GLenum format)
{
    switch (format) {
    case GL_R16F:
        return 2;
    case GL_R32F:
    case GL_RG16F:
        return 4;
    case GL_RG32F:
    case GL_RGBA16F:
        return 8;
    case GL_RGBA32F:
        return 16;
    default:
        throw std::logic_error("a texture of format " + std::to_string(format));
    }
}

void APIENTRY count_storage(GLuint texture, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
    storage(texture, levels, format, width, height);
    bytes_of_textures[texture] = uint64_t(width) * uint64_t(height) * texel_bytes(format);
}

void APIENTRY count_deletion(GLsizei count, const GLuint *names)
{
    deletion(count, names);
    for (GLsizei i = 0; i < count; ++i)
        bytes_of_textures.erase(names[i]);
}

}  // namespace

TextureBytes::TextureBytes()
{
    // epoxy's first call of a function puts the driver's in the pointer.
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_R32F, 1, 1);
    glDeleteTextures(1, &texture);
    bytes_of_textures.clear();
    storage = std::exchange(epoxy_glTextureStorage2D, count_storage);
    deletion = std::exchange(epoxy_glDeleteTextures, count_deletion);
}

TextureBytes::~TextureBytes()
{
    epoxy_glTextureStorage2D = storage;
    epoxy_glDeleteTextures = deletion;
}

uint64_t TextureBytes::held()
{
    uint64_t sum = 0;
    for (const auto &[texture, bytes] : bytes_of_textures)
        sum += bytes;
    return sum;
}

}  // namespace brume::test
