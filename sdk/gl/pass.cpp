#include "gl/pass.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "gl/debug_group.h"
#include "gl/image.h"

namespace brume::gl {
namespace {

constexpr int32_t group_side = 8;  // local_size in prelude.glsl

// Reads give (0, 0, 0, 1), writes are dropped; what the host has on that unit is not seen.
void bind_nothing(GLuint unit, bool write, const Samplers &samplers, StateGuard &guard)
{
    if (write) {
        guard.image_unit(unit);
        glBindImageTexture(unit, 0, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    } else {
        guard.texture_unit(unit);
        glActiveTexture(GL_TEXTURE0 + unit);  // glBindTextureUnit would clear the unit's other targets too
        glBindTexture(GL_TEXTURE_2D, 0);
        glBindSampler(unit, samplers.nearest);
    }
}

void bind(const GlImage &image, GLuint unit, uint32_t access, const Samplers &samplers, StateGuard &guard)
{
    if (access == BRUME_ACCESS_WRITE) {
        guard.image_unit(unit);
        glBindImageTexture(unit, image.texture, 0, GL_FALSE, 0, GL_WRITE_ONLY, image.format);
    } else {
        guard.texture_unit(unit);
        glBindTextureUnit(unit, image.texture);
        glBindSampler(unit, access == BRUME_ACCESS_LINEAR ? samplers.linear : samplers.nearest);
    }
}

GLuint create_sampler(GLint filter)
{
    GLuint sampler = 0;
    glCreateSamplers(1, &sampler);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return sampler;
}

template <class... Arguments>
[[noreturn]] void refuse(const GlProgram &program, fmt::format_string<Arguments...> format, Arguments &&...arguments)
{
    throw Error(BRUME_ERROR_ARGUMENT, fmt::format("program \"{}\": {}", program.name(),
                                                  fmt::format(format, std::forward<Arguments>(arguments)...)));
}

}  // namespace

void Samplers::create()
{
    nearest = create_sampler(GL_NEAREST);
    linear = create_sampler(GL_LINEAR);
}

void Samplers::destroy()
{
    const GLuint names[] = {nearest, linear};
    glDeleteSamplers(2, names);
}

GlPass::GlPass(std::shared_ptr<GlProgram> program, PassLayout described)
    : program_(std::move(program)), label_(fmt::format("brume: pass \"{}\"", described.name).substr(0, 200))
{
    layout = std::move(described);
    find_slots();
    find_constants();
}

void GlPass::find_slots()
{
    for (auto &[name, declared] : program_->slots()) {
        const auto found =
            std::find_if(layout.slots.begin(), layout.slots.end(), [&](auto &slot) { return slot.name == name; });
        if (found == layout.slots.end())
            refuse(*program_, "declares {} {}, which is not among the slots of pass \"{}\"",
                   declared.image ? "image2D" : "sampler2D", name, layout.name);
        const bool write = found->access == BRUME_ACCESS_WRITE;
        if (write != declared.image)
            refuse(*program_, "declares {} as {}; pass \"{}\" has a slot for {} there", name,
                   declared.image ? "image2D" : "sampler2D", layout.name, write ? "writing" : "reading");
        bindings_.push_back({size_t(found - layout.slots.begin()), &declared, found->access});
    }
}

void GlPass::find_constants()
{
    for (const auto &[name, uniform] : program_->uniforms()) {
        const auto found = std::find_if(layout.constants.begin(), layout.constants.end(),
                                        [&](auto &constant) { return constant.name == name; });
        if (found == layout.constants.end())
            refuse(*program_, "declares {} {}, which is not among the constants of pass \"{}\"", type_text(uniform), name,
                   layout.name);
        if (!holds(uniform, found->type, found->components))
            refuse(*program_, "declares {} as {}; pass \"{}\" has {} of {} components there", name, type_text(uniform),
                   layout.name, found->type == BRUME_CONSTANT_FLOAT ? "floats" : "ints", found->components);
        // Compilers shorten arrays to what is used.
        GlProgram::Uniform set = uniform;
        set.size = std::min(GLint(found->count), uniform.size);
        constants_.push_back({set, found->offset, found->components * uint32_t(set.size) * 4});
    }
}

void GlPass::set_constants(const void *constants)
{
    for (const Constant &constant : constants_)
        program_->set(constant.uniform, static_cast<const char *>(constants) + constant.offset);
}

// Units from 0 up for what is bound, and one more for all that is not: what the host has on a unit costs questions to keep.
void GlPass::bind_images(const brume_plugin_image *images, const Samplers &samplers, StateGuard &guard)
{
    GLuint units[2] = {0, 0};  // for reading, for writing
    for (const Binding &binding : bindings_)
        if (const brume_plugin_image image = images[binding.slot]) {
            const GLuint unit = units[binding.access == BRUME_ACCESS_WRITE]++;
            program_->set_unit(*binding.uniform, unit);
            bind(static_cast<const GlImage &>(*image), unit, binding.access, samplers, guard);
        }
    bool nothing[2] = {false, false};
    for (const Binding &binding : bindings_)
        if (!images[binding.slot]) {
            const bool write = binding.access == BRUME_ACCESS_WRITE;
            program_->set_unit(*binding.uniform, units[write]);
            if (!std::exchange(nothing[write], true))
                bind_nothing(units[write], write, samplers, guard);
        }
}

void GlPass::run(const brume_plugin_image *images, const void *constants, int32_t width, int32_t height,
                 const brume_plugin_scene &scene, const Samplers &samplers, StateGuard &guard)
{
    const DebugGroup group(label_, guard);
    set_constants(constants);
    program_->set_scene(scene);
    program_->set_grid(width, height);
    bind_images(images, samplers, guard);
    guard.program();
    glUseProgram(program_->id());
    glDispatchCompute(GLuint((width + group_side - 1) / group_side), GLuint((height + group_side - 1) / group_side), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace brume::gl
