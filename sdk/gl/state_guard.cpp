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

// Without what concerns bitmaps (GL_..._LSB_FIRST) and, for unpacking, images of more than two dimensions.
constexpr Parameter pack_store[] = {
    {GL_PACK_SWAP_BYTES, "GL_PACK_SWAP_BYTES", 0},     {GL_PACK_ROW_LENGTH, "GL_PACK_ROW_LENGTH", 0},
    {GL_PACK_IMAGE_HEIGHT, "GL_PACK_IMAGE_HEIGHT", 0}, {GL_PACK_SKIP_PIXELS, "GL_PACK_SKIP_PIXELS", 0},
    {GL_PACK_SKIP_ROWS, "GL_PACK_SKIP_ROWS", 0},       {GL_PACK_SKIP_IMAGES, "GL_PACK_SKIP_IMAGES", 0},
    {GL_PACK_ALIGNMENT, "GL_PACK_ALIGNMENT", 4},
};
constexpr Parameter unpack_store[] = {
    {GL_UNPACK_SWAP_BYTES, "GL_UNPACK_SWAP_BYTES", 0},   {GL_UNPACK_ROW_LENGTH, "GL_UNPACK_ROW_LENGTH", 0},
    {GL_UNPACK_SKIP_PIXELS, "GL_UNPACK_SKIP_PIXELS", 0}, {GL_UNPACK_SKIP_ROWS, "GL_UNPACK_SKIP_ROWS", 0},
    {GL_UNPACK_ALIGNMENT, "GL_UNPACK_ALIGNMENT", 4},
};

// Compatibility profiles apply these to what is uploaded and read back.
constexpr Parameter pixel_scale[] = {
    {GL_RED_SCALE, "GL_RED_SCALE", 1},     {GL_RED_BIAS, "GL_RED_BIAS", 0},     {GL_GREEN_SCALE, "GL_GREEN_SCALE", 1},
    {GL_GREEN_BIAS, "GL_GREEN_BIAS", 0},   {GL_BLUE_SCALE, "GL_BLUE_SCALE", 1}, {GL_BLUE_BIAS, "GL_BLUE_BIAS", 0},
    {GL_ALPHA_SCALE, "GL_ALPHA_SCALE", 1}, {GL_ALPHA_BIAS, "GL_ALPHA_BIAS", 0}, {GL_MAP_COLOR, "GL_MAP_COLOR", 0},
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

template <size_t count> FewValues<GLint> read_store(const Parameter (&parameters)[count], GLenum buffer)
{
    FewValues<GLint> values;
    for (const Parameter &parameter : parameters)
        values.push_back(get(parameter.name));
    values.push_back(get(buffer));
    return values;
}

template <size_t count> FewValues<GLint> initial_store(const Parameter (&parameters)[count])
{
    FewValues<GLint> values;
    for (const Parameter &parameter : parameters)
        values.push_back(parameter.initial);
    values.push_back(0);
    return values;
}

template <size_t count> void set_store(const Parameter (&parameters)[count], GLenum buffer, const FewValues<GLint> &values)
{
    for (size_t i = 0; i < count; ++i)
        glPixelStorei(parameters[i].name, values[i]);
    glBindBuffer(buffer, GLuint(values[count]));
}

void set_scales(const FewValues<GLfloat> &values)
{
    for (size_t i = 0; i < std::size(pixel_scale); ++i)
        glPixelTransferf(pixel_scale[i].name, values[i]);
}

}  // namespace

StateGuard::StateGuard(uint32_t mode, const ContextProperties &properties) : mode_(mode), properties_(properties)
{
    if (mode_ == BRUME_GL_STATE_OWNED)
        debug_groups_ = properties_.most_debug_groups > 2;  // the stack is ours
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
    if (pack_)
        set_store(pack_store, GL_PIXEL_PACK_BUFFER, *pack_);
    if (unpack_)
        set_store(unpack_store, GL_PIXEL_UNPACK_BUFFER, *unpack_);
    if (pixel_transfer_)
        set_scales(*pixel_transfer_);
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
    // What belongs to no image is not worth five more questions.
    if (const GLint name = mode_ == BRUME_GL_STATE_DEFAULTS ? 0 : get(GL_IMAGE_BINDING_NAME, unit); name == 0)
        image_units_[unit] = {0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8};
    else
        image_units_[unit] = {name,
                              get(GL_IMAGE_BINDING_LEVEL, unit),
                              get(GL_IMAGE_BINDING_LAYERED, unit),
                              get(GL_IMAGE_BINDING_LAYER, unit),
                              get(GL_IMAGE_BINDING_ACCESS, unit),
                              get(GL_IMAGE_BINDING_FORMAT, unit)};
}

void StateGuard::pack()
{
    const Values initial = initial_store(pack_store);
    if (mode_ != BRUME_GL_STATE_OWNED && !pack_)
        pack_ = mode_ == BRUME_GL_STATE_PRESERVE ? read_store(pack_store, GL_PIXEL_PACK_BUFFER_BINDING) : initial;
    set_store(pack_store, GL_PIXEL_PACK_BUFFER, initial);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    pixel_transfer();
}

void StateGuard::unpack()
{
    const Values initial = initial_store(unpack_store);
    if (mode_ != BRUME_GL_STATE_OWNED && !unpack_)
        unpack_ = mode_ == BRUME_GL_STATE_PRESERVE ? read_store(unpack_store, GL_PIXEL_UNPACK_BUFFER_BINDING) : initial;
    set_store(unpack_store, GL_PIXEL_UNPACK_BUFFER, initial);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    pixel_transfer();
}

void StateGuard::pixel_transfer()
{
    if (!properties_.compatibility)
        return;
    Scales initial;
    for (const Parameter &parameter : pixel_scale)
        initial.push_back(GLfloat(parameter.initial));
    if (mode_ != BRUME_GL_STATE_OWNED && !pixel_transfer_) {
        pixel_transfer_ = initial;
        if (mode_ == BRUME_GL_STATE_PRESERVE)
            for (size_t i = 0; i < std::size(pixel_scale); ++i)
                glGetFloatv(pixel_scale[i].name, &(*pixel_transfer_)[i]);
    }
    set_scales(initial);
}

bool StateGuard::debug_groups()
{
    if (!debug_groups_)
        debug_groups_ = get(GL_DEBUG_GROUP_STACK_DEPTH) < properties_.most_debug_groups;
    return *debug_groups_;
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
                                      "GL_PIXEL_PACK_BUFFER_BINDING",
                                      "GL_TRANSFORM_FEEDBACK_PAUSED",
                                      "GL_PIXEL_UNPACK_BUFFER_BINDING"};
    for (const Parameter &parameter : pack_store)
        names.push_back(parameter.text);
    for (const Parameter &parameter : unpack_store)
        names.push_back(parameter.text);
    for (const Parameter &parameter : pixel_scale)
        names.push_back(parameter.text);
    return names;
}

}  // namespace brume::gl
