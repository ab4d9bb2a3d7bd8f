#include "gl/state_guard.h"

#include <iterator>

#include <brume/brume.h>

namespace brume::gl {
namespace {

struct Parameter {
    GLenum name;
    const char *text;
    GLint initial;
};

constexpr Parameter pixel_store[] = {
    {GL_PACK_SWAP_BYTES, "GL_PACK_SWAP_BYTES", 0},     {GL_UNPACK_SWAP_BYTES, "GL_UNPACK_SWAP_BYTES", 0},
    {GL_PACK_LSB_FIRST, "GL_PACK_LSB_FIRST", 0},       {GL_UNPACK_LSB_FIRST, "GL_UNPACK_LSB_FIRST", 0},
    {GL_PACK_ROW_LENGTH, "GL_PACK_ROW_LENGTH", 0},     {GL_UNPACK_ROW_LENGTH, "GL_UNPACK_ROW_LENGTH", 0},
    {GL_PACK_IMAGE_HEIGHT, "GL_PACK_IMAGE_HEIGHT", 0}, {GL_UNPACK_IMAGE_HEIGHT, "GL_UNPACK_IMAGE_HEIGHT", 0},
    {GL_PACK_SKIP_PIXELS, "GL_PACK_SKIP_PIXELS", 0},   {GL_UNPACK_SKIP_PIXELS, "GL_UNPACK_SKIP_PIXELS", 0},
    {GL_PACK_SKIP_ROWS, "GL_PACK_SKIP_ROWS", 0},       {GL_UNPACK_SKIP_ROWS, "GL_UNPACK_SKIP_ROWS", 0},
    {GL_PACK_SKIP_IMAGES, "GL_PACK_SKIP_IMAGES", 0},   {GL_UNPACK_SKIP_IMAGES, "GL_UNPACK_SKIP_IMAGES", 0},
    {GL_PACK_ALIGNMENT, "GL_PACK_ALIGNMENT", 4},       {GL_UNPACK_ALIGNMENT, "GL_UNPACK_ALIGNMENT", 4},
};

// Compatibility profiles apply these to what is uploaded and read back.
constexpr Parameter pixel_scale[] = {
    {GL_RED_SCALE, "GL_RED_SCALE", 1},     {GL_RED_BIAS, "GL_RED_BIAS", 0},     {GL_GREEN_SCALE, "GL_GREEN_SCALE", 1},
    {GL_GREEN_BIAS, "GL_GREEN_BIAS", 0},   {GL_BLUE_SCALE, "GL_BLUE_SCALE", 1}, {GL_BLUE_BIAS, "GL_BLUE_BIAS", 0},
    {GL_ALPHA_SCALE, "GL_ALPHA_SCALE", 1}, {GL_ALPHA_BIAS, "GL_ALPHA_BIAS", 0},
};

GLint get(GLenum name)
{
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

GLint get(GLenum name, GLuint index)
{
    GLint value = 0;
    glGetIntegeri_v(name, index, &value);
    return value;
}

}  // namespace

StateGuard::StateGuard(uint32_t mode, bool compatibility) : mode_(mode), compatibility_(compatibility)
{
    static_assert(std::size(pixel_store) == pixel_store_count && std::size(pixel_scale) == pixel_scale_count);
    // Programs may not be changed while transform feedback runs.
    if (mode_ != BRUME_GL_STATE_OWNED && get(GL_TRANSFORM_FEEDBACK_ACTIVE) && !get(GL_TRANSFORM_FEEDBACK_PAUSED)) {
        glPauseTransformFeedback();
        resume_transform_feedback_ = true;
    }
}

StateGuard::~StateGuard()
{
    for (const auto &[unit, state] : texture_units_) {
        // Not glBindTextureUnit: with texture 0 that would also clear the unit's other targets.
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, GLuint(state.texture));
        glBindSampler(unit, GLuint(state.sampler));
    }
    if (active_texture_)
        glActiveTexture(GLenum(*active_texture_));
    for (const auto &[unit, state] : image_units_)
        glBindImageTexture(unit, GLuint(state.texture), state.level, GLboolean(state.layered), state.layer,
                           GLenum(state.access), GLenum(state.format));
    if (pixel_transfer_)
        set_pixel_transfer(*pixel_transfer_);
    if (program_)
        glUseProgram(GLuint(*program_));
    if (resume_transform_feedback_)
        glResumeTransformFeedback();
}

void StateGuard::program()
{
    if (mode_ != BRUME_GL_STATE_OWNED && !program_)
        program_ = mode_ == BRUME_GL_STATE_PRESERVE ? get(GL_CURRENT_PROGRAM) : 0;
}

void StateGuard::texture_unit(GLuint unit)
{
    if (mode_ == BRUME_GL_STATE_OWNED || texture_units_.contains(unit))
        return;
    if (mode_ == BRUME_GL_STATE_DEFAULTS) {
        active_texture_ = GL_TEXTURE0;
        texture_units_[unit] = {0, 0};
        return;
    }
    if (!active_texture_)
        active_texture_ = get(GL_ACTIVE_TEXTURE);
    glActiveTexture(GL_TEXTURE0 + unit);
    texture_units_[unit] = {get(GL_TEXTURE_BINDING_2D), get(GL_SAMPLER_BINDING)};
}

void StateGuard::image_unit(GLuint unit)
{
    if (mode_ == BRUME_GL_STATE_OWNED || image_units_.contains(unit))
        return;
    if (mode_ == BRUME_GL_STATE_DEFAULTS)
        image_units_[unit] = {0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8};
    else
        image_units_[unit] = {get(GL_IMAGE_BINDING_NAME, unit),    get(GL_IMAGE_BINDING_LEVEL, unit),
                              get(GL_IMAGE_BINDING_LAYERED, unit), get(GL_IMAGE_BINDING_LAYER, unit),
                              get(GL_IMAGE_BINDING_ACCESS, unit),  get(GL_IMAGE_BINDING_FORMAT, unit)};
}

void StateGuard::pixel_transfer()
{
    if (mode_ != BRUME_GL_STATE_OWNED && !pixel_transfer_)
        pixel_transfer_ = mode_ == BRUME_GL_STATE_PRESERVE ? read_pixel_transfer() : initial_pixel_transfer();
    set_pixel_transfer(initial_pixel_transfer());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

StateGuard::PixelTransfer StateGuard::initial_pixel_transfer() const
{
    PixelTransfer state{};
    for (size_t i = 0; i < pixel_store_count; ++i)
        state.store[i] = pixel_store[i].initial;
    for (size_t i = 0; i < pixel_scale_count; ++i)
        state.scale[i] = GLfloat(pixel_scale[i].initial);
    return state;
}

StateGuard::PixelTransfer StateGuard::read_pixel_transfer() const
{
    PixelTransfer state = initial_pixel_transfer();
    for (size_t i = 0; i < pixel_store_count; ++i)
        state.store[i] = get(pixel_store[i].name);
    if (compatibility_) {
        for (size_t i = 0; i < pixel_scale_count; ++i)
            glGetFloatv(pixel_scale[i].name, &state.scale[i]);
        state.map_color = get(GL_MAP_COLOR);
    }
    state.pack_buffer = get(GL_PIXEL_PACK_BUFFER_BINDING);
    state.unpack_buffer = get(GL_PIXEL_UNPACK_BUFFER_BINDING);
    return state;
}

void StateGuard::set_pixel_transfer(const PixelTransfer &state) const
{
    for (size_t i = 0; i < pixel_store_count; ++i)
        glPixelStorei(pixel_store[i].name, state.store[i]);
    if (compatibility_) {
        for (size_t i = 0; i < pixel_scale_count; ++i)
            glPixelTransferf(pixel_scale[i].name, state.scale[i]);
        glPixelTransferi(GL_MAP_COLOR, state.map_color);
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(state.pack_buffer));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(state.unpack_buffer));
}

std::vector<std::string> StateGuard::names()
{
    std::vector<std::string> names = {"GL_CURRENT_PROGRAM",
                                      "GL_ACTIVE_TEXTURE",
                                      "GL_TEXTURE_BINDING_2D",
                                      "GL_SAMPLER_BINDING",
                                      "GL_IMAGE_BINDING_NAME",
                                      "GL_IMAGE_BINDING_LEVEL",
                                      "GL_IMAGE_BINDING_LAYERED",
                                      "GL_IMAGE_BINDING_LAYER",
                                      "GL_IMAGE_BINDING_ACCESS",
                                      "GL_IMAGE_BINDING_FORMAT",
                                      "GL_MAP_COLOR",
                                      "GL_PIXEL_PACK_BUFFER_BINDING",
                                      "GL_TRANSFORM_FEEDBACK_PAUSED",
                                      "GL_PIXEL_UNPACK_BUFFER_BINDING"};
    for (const Parameter &parameter : pixel_store)
        names.push_back(parameter.text);
    for (const Parameter &parameter : pixel_scale)
        names.push_back(parameter.text);
    return names;
}

}  // namespace brume::gl
