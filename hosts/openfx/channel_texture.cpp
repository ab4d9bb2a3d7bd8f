#include "channel_texture.h"

#include <epoxy/gl.h>

#include "gl/state_guard.h"
#include "host.h"

namespace openfx {
namespace {

constexpr const char *source = R"(#version 450 core
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D whole;
layout(binding = 0, r32f) writeonly uniform image2D single;
layout(location = 0) uniform int channel;
void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(at, imageSize(single))))
        imageStore(single, at, vec4(texelFetch(whole, at, 0)[channel]));
}
)";

}  // namespace

ChannelTexture::ChannelTexture()
    : context_(brume::gl::ContextQuery()), program_(glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source))
{
    GLint linked = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &linked);
    if (!linked) {
        glDeleteProgram(program_);
        throw Refusal("Depth: OpenGL does not compile the program that takes a channel of it");
    }
    glCreateSamplers(1, &sampler_);
    // The texture's own filter may want mipmaps that it does not have.
    glSamplerParameteri(sampler_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
}

ChannelTexture::~ChannelTexture()
{
    if (!context_.is_current())
        return;
    glDeleteProgram(program_);
    glDeleteSamplers(1, &sampler_);
    glDeleteTextures(1, &copy_);
}

uint32_t ChannelTexture::copy(uint32_t texture, int channel, int width, int height)
{
    if (width != width_ || height != height_) {
        glDeleteTextures(1, &copy_);
        glCreateTextures(GL_TEXTURE_2D, 1, &copy_);
        glTextureStorage2D(copy_, 1, GL_R32F, width, height);
        width_ = width;
        height_ = height;
    }
    GLint red = 0;
    glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_RED_SIZE, &red);
    const GLint component = red > 0 ? channel : 3;  // GL_ALPHA has no red

    brume::gl::StateGuard guard(BRUME_GL_STATE_PRESERVE, {});
    guard.program();
    guard.texture_unit(0);
    guard.image_unit(0);
    glProgramUniform1iv(program_, 0, 1, &component);
    glUseProgram(program_);
    glBindTextureUnit(0, texture);
    glBindSampler(0, sampler_);
    glBindImageTexture(0, copy_, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glDispatchCompute(GLuint(width + 7) / 8, GLuint(height + 7) / 8, 1);
    return copy_;
}

}  // namespace openfx
