#include "host_state.h"

#include <sstream>

#include "host_context.h"

namespace brume::test {
namespace {

constexpr int texture_units = 8, image_units = 8;

struct Named {
    GLenum name;
    const char *text;
};
#define NAMED(name)                                                                                                         \
    {                                                                                                                       \
        name, #name                                                                                                         \
    }

constexpr Named plain[] = {
    NAMED(GL_CURRENT_PROGRAM),
    NAMED(GL_PROGRAM_PIPELINE_BINDING),
    NAMED(GL_ACTIVE_TEXTURE),
    NAMED(GL_PIXEL_PACK_BUFFER_BINDING),
    NAMED(GL_PIXEL_UNPACK_BUFFER_BINDING),
    NAMED(GL_SHADER_STORAGE_BUFFER_BINDING),
    NAMED(GL_UNIFORM_BUFFER_BINDING),
    NAMED(GL_VERTEX_ARRAY_BINDING),
    NAMED(GL_DRAW_FRAMEBUFFER_BINDING),
    NAMED(GL_READ_FRAMEBUFFER_BINDING),
    NAMED(GL_ARRAY_BUFFER_BINDING),
    NAMED(GL_DISPATCH_INDIRECT_BUFFER_BINDING),
    NAMED(GL_DEBUG_GROUP_STACK_DEPTH),
    NAMED(GL_DEPTH_TEST),
    NAMED(GL_BLEND),
    NAMED(GL_RASTERIZER_DISCARD),
    NAMED(GL_TRANSFORM_FEEDBACK_ACTIVE),
    NAMED(GL_TRANSFORM_FEEDBACK_PAUSED),
    NAMED(GL_TEXTURE_CUBE_MAP_SEAMLESS),
    NAMED(GL_PACK_SWAP_BYTES),
    NAMED(GL_UNPACK_SWAP_BYTES),
    NAMED(GL_PACK_LSB_FIRST),
    NAMED(GL_UNPACK_LSB_FIRST),
    NAMED(GL_PACK_ROW_LENGTH),
    NAMED(GL_UNPACK_ROW_LENGTH),
    NAMED(GL_PACK_IMAGE_HEIGHT),
    NAMED(GL_UNPACK_IMAGE_HEIGHT),
    NAMED(GL_PACK_SKIP_PIXELS),
    NAMED(GL_UNPACK_SKIP_PIXELS),
    NAMED(GL_PACK_SKIP_ROWS),
    NAMED(GL_UNPACK_SKIP_ROWS),
    NAMED(GL_PACK_SKIP_IMAGES),
    NAMED(GL_UNPACK_SKIP_IMAGES),
    NAMED(GL_PACK_ALIGNMENT),
    NAMED(GL_UNPACK_ALIGNMENT),
    NAMED(GL_PACK_COMPRESSED_BLOCK_WIDTH),
    NAMED(GL_UNPACK_COMPRESSED_BLOCK_SIZE),
};

constexpr Named per_texture_unit[] = {NAMED(GL_TEXTURE_BINDING_2D), NAMED(GL_TEXTURE_BINDING_3D),
                                      NAMED(GL_TEXTURE_BINDING_CUBE_MAP), NAMED(GL_SAMPLER_BINDING)};

constexpr Named per_image_unit[] = {NAMED(GL_IMAGE_BINDING_NAME),    NAMED(GL_IMAGE_BINDING_LEVEL),
                                    NAMED(GL_IMAGE_BINDING_LAYERED), NAMED(GL_IMAGE_BINDING_LAYER),
                                    NAMED(GL_IMAGE_BINDING_ACCESS),  NAMED(GL_IMAGE_BINDING_FORMAT)};

constexpr Named pixel_transfer[] = {NAMED(GL_RED_SCALE),   NAMED(GL_RED_BIAS),   NAMED(GL_GREEN_SCALE),
                                    NAMED(GL_GREEN_BIAS),  NAMED(GL_BLUE_SCALE), NAMED(GL_BLUE_BIAS),
                                    NAMED(GL_ALPHA_SCALE), NAMED(GL_ALPHA_BIAS), NAMED(GL_MAP_COLOR)};

GLuint make_program()
{
    const char *source = "#version 450 core\nlayout(local_size_x = 1) in;\nuniform int x;\n"
                         "layout(std430, binding = 0) buffer B { int y; };\nvoid main() { y = x; }\n";
    return glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
}

GLuint make_buffer()
{
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 1 << 16, nullptr, GL_DYNAMIC_STORAGE_BIT);
    return buffer;
}

void dirty_pixel_store(GLenum swap, GLenum lsb, GLenum row, GLenum height, GLenum pixels, GLenum rows, GLenum images,
                       GLenum alignment)
{
    glPixelStorei(swap, GL_TRUE);
    glPixelStorei(lsb, GL_TRUE);
    glPixelStorei(row, 37);
    glPixelStorei(height, 41);
    glPixelStorei(pixels, 3);
    glPixelStorei(rows, 2);
    glPixelStorei(images, 1);
    glPixelStorei(alignment, 8);
}

}  // namespace

HostState read_state(bool compatibility)
{
    HostState state;
    const auto get = [&](const Named &named) {
        GLfloat value = 0;
        glGetFloatv(named.name, &value);
        return double(value);
    };
    for (const Named &named : plain)
        state[named.text] = {get(named)};
    if (compatibility)
        for (const Named &named : pixel_transfer)
            state[named.text] = {get(named)};

    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < texture_units; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (const Named &named : per_texture_unit)
            state[named.text].push_back(get(named));
    }
    glActiveTexture(GLenum(active));
    for (GLuint unit = 0; unit < image_units; ++unit)
        for (const Named &named : per_image_unit) {
            GLint value = 0;
            glGetIntegeri_v(named.name, unit, &value);
            state[named.text].push_back(value);
        }
    return state;
}

DirtyState dirty_state(bool compatibility)
{
    DirtyState dirty{};
    dirty.program = make_program();
    glUseProgram(dirty.program);
    glGenProgramPipelines(1, &dirty.pipeline);
    glBindProgramPipeline(dirty.pipeline);

    glCreateSamplers(1, &dirty.sampler);
    glSamplerParameteri(dirty.sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(dirty.sampler, GL_TEXTURE_WRAP_S, GL_REPEAT);
    for (GLuint unit = 0; unit < texture_units; ++unit) {
        GLuint cube = 0;
        glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
        const GLuint flat = make_texture(GL_RGBA8, 4, 4);
        glBindTextureUnit(unit, flat);
        glBindTextureUnit(unit, cube);
        glBindSampler(unit, dirty.sampler);
        dirty.textures.insert(dirty.textures.end(), {flat, cube});
    }
    for (GLuint unit = 0; unit < image_units; ++unit) {
        GLuint layers = 0;
        glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &layers);
        glTextureStorage3D(layers, 2, GL_RGBA16F, 4, 4, 3);
        glBindImageTexture(unit, layers, 1, GL_FALSE, 2, GL_READ_WRITE, GL_RGBA16F);
        dirty.textures.push_back(layers);
    }
    glActiveTexture(GL_TEXTURE5);

    dirty_pixel_store(GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_PIXELS,
                      GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES, GL_PACK_ALIGNMENT);
    dirty_pixel_store(GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT,
                      GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT);
    if (compatibility) {
        for (const Named &named : pixel_transfer)
            if (named.name != GL_MAP_COLOR)
                glPixelTransferf(named.name, 0.5f);
        glPixelTransferi(GL_MAP_COLOR, GL_TRUE);
    }
    dirty.pack = make_buffer();
    dirty.unpack = make_buffer();
    dirty.storage = make_buffer();
    glBindBuffer(GL_PIXEL_PACK_BUFFER, dirty.pack);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, dirty.unpack);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, dirty.storage);
    glCreateVertexArrays(1, &dirty.vertex_array);
    glBindVertexArray(dirty.vertex_array);
    glCreateFramebuffers(1, &dirty.framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, dirty.framebuffer);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glEnable(GL_RASTERIZER_DISCARD);
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 1, -1, "host");
    return dirty;
}

std::string difference(const HostState &before, const HostState &after)
{
    std::ostringstream text;
    for (const auto &[name, values] : before) {
        const auto &now = after.at(name);
        for (size_t i = 0; i < values.size(); ++i)
            if (values[i] != now[i])
                text << name << "[" << i << "]: " << values[i] << " -> " << now[i] << "\n";
    }
    return text.str();
}

}  // namespace brume::test
