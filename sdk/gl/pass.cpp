#include "gl/pass.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "gl/debug_group.h"
#include "gl/image.h"
#include "gl/program.h"

namespace brume::gl {
namespace {

constexpr int32_t group_side = 8;  // local_size in prelude.glsl

class Dispatch {
public:
    Dispatch(const brume_plugin_pass &pass, const Samplers &samplers, StateGuard &guard)
        : pass_(pass), samplers_(samplers), guard_(guard), name_("pass \"" + std::string(pass.name ? pass.name : "") + "\"")
    {
    }

    void run(const brume_plugin_scene &scene)
    {
        check();
        auto &program = static_cast<GlProgram &>(*pass_.program);
        const DebugGroup group("brume: " + name_, guard_);
        set_uniforms(program, scene);
        bind(program);
        guard_.program();
        glUseProgram(program.id());
        glDispatchCompute(GLuint((pass_.width + group_side - 1) / group_side),
                          GLuint((pass_.height + group_side - 1) / group_side), 1);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }

private:
    [[noreturn]] void refuse(const std::string &problem) const { throw Error(BRUME_ERROR_ARGUMENT, name_ + ": " + problem); }

    void check() const
    {
        if (!pass_.name)
            refuse("its name is NULL");
        if (!pass_.program)
            refuse("its program is NULL");
        if (pass_.width < 1 || pass_.height < 1)
            refuse("its size is " + std::to_string(pass_.width) + " x " + std::to_string(pass_.height) +
                   "; expected at least 1 x 1");
        if (pass_.binding_count > 0 && !pass_.bindings)
            refuse(std::to_string(pass_.binding_count) + " bindings, but bindings is NULL");
        if (pass_.uniform_count > 0 && !pass_.uniforms)
            refuse(std::to_string(pass_.uniform_count) + " uniforms, but uniforms is NULL");
    }

    void set_uniforms(GlProgram &program, const brume_plugin_scene &scene) const
    {
        for (uint32_t i = 0; i < pass_.uniform_count; ++i) {
            const brume_plugin_uniform &uniform = pass_.uniforms[i];
            const std::string item = "uniforms[" + std::to_string(i) + "]";
            if (!uniform.name)
                refuse(item + ": its name is NULL");
            const std::string label = item + " \"" + uniform.name + "\"";
            if (std::string_view(uniform.name).starts_with("brume_"))
                refuse(label + ": names that start with brume_ are set by the host");
            if (uniform.type != BRUME_UNIFORM_FLOAT && uniform.type != BRUME_UNIFORM_INT)
                refuse(label + ": type " + std::to_string(uniform.type) + "; expected BRUME_UNIFORM_FLOAT or _INT");
            if (uniform.components < 1 || uniform.components > 4)
                refuse(label + ": " + std::to_string(uniform.components) + " components; expected 1 to 4");
            if (uniform.count < 1)
                refuse(label + ": count 0; expected at least 1");
            if (!uniform.data)
                refuse(label + ": data is NULL");
            program.set(uniform.name, uniform.type, uniform.components, uniform.count, uniform.data);
        }
        program.set_scene(scene);
        program.set_grid(pass_.width, pass_.height);
    }

    void bind(const GlProgram &program) const
    {
        std::vector<const GlProgram::Slot *> bound;
        for (uint32_t i = 0; i < pass_.binding_count; ++i) {
            const brume_plugin_binding &binding = pass_.bindings[i];
            const std::string item = "bindings[" + std::to_string(i) + "]";
            if (!binding.name)
                refuse(item + ": its name is NULL");
            const std::string label = item + " \"" + binding.name + "\"";
            if (!binding.image)
                refuse(label + ": its image is NULL");
            if (binding.access > BRUME_ACCESS_WRITE)
                refuse(label + ": access " + std::to_string(binding.access) +
                       "; expected BRUME_ACCESS_FETCH, _LINEAR or _WRITE");
            const auto slot = program.slots().find(std::string_view(binding.name));
            if (slot == program.slots().end())
                continue;
            const bool write = binding.access == BRUME_ACCESS_WRITE;
            if (write != slot->second.image)
                refuse(label + (write ? ": bound for writing; the program has a sampler2D there"
                                      : ": bound for reading; the program has an image2D there"));
            bind(slot->second, static_cast<const GlImage &>(*binding.image), binding.access);
            bound.push_back(&slot->second);
        }
        // What an effect leaves out must not be what the host has on that unit.
        for (const auto &[name, slot] : program.slots())
            if (std::find(bound.begin(), bound.end(), &slot) == bound.end())
                bind_nothing(slot);
    }

    // Reads give (0, 0, 0, 1), writes are dropped.
    void bind_nothing(const GlProgram::Slot &slot) const
    {
        if (slot.image) {
            guard_.image_unit(slot.unit);
            glBindImageTexture(slot.unit, 0, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
        } else {
            guard_.texture_unit(slot.unit);
            glActiveTexture(GL_TEXTURE0 + slot.unit);  // glBindTextureUnit would clear the unit's other targets too
            glBindTexture(GL_TEXTURE_2D, 0);
            glBindSampler(slot.unit, samplers_.nearest);
        }
    }

    void bind(const GlProgram::Slot &slot, const GlImage &image, uint32_t access) const
    {
        if (slot.image) {
            guard_.image_unit(slot.unit);
            glBindImageTexture(slot.unit, image.texture, 0, GL_FALSE, 0, GL_WRITE_ONLY, image.format);
        } else {
            guard_.texture_unit(slot.unit);
            glBindTextureUnit(slot.unit, image.texture);
            glBindSampler(slot.unit, access == BRUME_ACCESS_LINEAR ? samplers_.linear : samplers_.nearest);
        }
    }

    const brume_plugin_pass &pass_;
    const Samplers &samplers_;
    StateGuard &guard_;
    const std::string name_;
};

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

void run_pass(const brume_plugin_pass &pass, const brume_plugin_scene &scene, const Samplers &samplers, StateGuard &guard)
{
    Dispatch(pass, samplers, guard).run(scene);
}

}  // namespace brume::gl
