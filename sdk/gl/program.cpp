#include "gl/program.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "scene/scene_constants.h"
#include "gl/device.h"
#include "gl/program_source.h"

namespace brume::gl {
namespace {

struct Type {
    GLenum name;
    uint32_t type;
    uint32_t components;
    const char *text;
};

constexpr Type types[] = {
    {GL_FLOAT, BRUME_CONSTANT_FLOAT, 1, "float"},     {GL_FLOAT_VEC2, BRUME_CONSTANT_FLOAT, 2, "vec2"},
    {GL_FLOAT_VEC3, BRUME_CONSTANT_FLOAT, 3, "vec3"}, {GL_FLOAT_VEC4, BRUME_CONSTANT_FLOAT, 4, "vec4"},
    {GL_INT, BRUME_CONSTANT_INT, 1, "int"},           {GL_INT_VEC2, BRUME_CONSTANT_INT, 2, "ivec2"},
    {GL_INT_VEC3, BRUME_CONSTANT_INT, 3, "ivec3"},    {GL_INT_VEC4, BRUME_CONSTANT_INT, 4, "ivec4"},
    {GL_BOOL, BRUME_CONSTANT_INT, 1, "bool"},
};

const Type *find_type(GLenum name)
{
    auto found = std::find_if(std::begin(types), std::end(types), [&](const Type &type) { return type.name == name; });
    return found == std::end(types) ? nullptr : found;
}

std::string log_of(GLuint object, decltype(glGetShaderiv) get, decltype(glGetShaderInfoLog) get_log)
{
    GLint length = 0;
    get(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(size_t(std::max(length, 1)), '\0');
    get_log(object, GLsizei(log.size()), nullptr, log.data());
    return log.c_str();
}

}  // namespace

GlProgram::GlProgram(const std::string &name, const std::string &source, const std::string &defines,
                     std::shared_ptr<Disposal> disposal)
    : name_(name), disposal_(std::move(disposal)), id_(glCreateProgram())
{
    try {
        link(source, defines);
        refuse_buffers();
        list_uniforms();
    } catch (...) {
        glDeleteProgram(id_);
        throw;
    }
    glObjectLabel(GL_PROGRAM, id_, -1, name_.substr(0, 200).c_str());
}

GlProgram::~GlProgram()
{
    disposal_->add(Disposal::Kind::program, id_);
}

void GlProgram::link(const std::string &source, const std::string &defines)
{
    const std::string limit = renders_in_software() ? "#define BRUME_MOST_TURNS 65535\n" : "";
    const ProgramSource assembled = assemble_program(name_, source, limit + defines);
    const char *const lines = assembled.text.c_str();
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    glShaderSource(shader, 1, &lines, nullptr);
    glCompileShader(shader);
    GLint compiled = 0, linked = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        const std::string log = log_of(shader, glGetShaderiv, glGetShaderInfoLog);
        glDeleteShader(shader);
        throw Error(BRUME_ERROR_GL, "program \"" + name_ + "\" does not compile:\n" + with_file_names(log, assembled));
    }
    glAttachShader(id_, shader);
    glLinkProgram(id_);
    glDetachShader(id_, shader);
    glDeleteShader(shader);
    glGetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (!linked)
        throw Error(BRUME_ERROR_GL, "program \"" + name_ + "\" does not link:\n" +
                                        with_file_names(log_of(id_, glGetProgramiv, glGetProgramInfoLog), assembled));
}

// Buffers would be read from and written to the host's binding points.
void GlProgram::refuse_buffers() const
{
    for (GLenum interface : {GL_UNIFORM_BLOCK, GL_SHADER_STORAGE_BLOCK, GL_ATOMIC_COUNTER_BUFFER}) {
        GLint count = 0;
        glGetProgramInterfaceiv(id_, interface, GL_ACTIVE_RESOURCES, &count);
        if (count > 0)
            throw Error(BRUME_ERROR_GL, "program \"" + name_ +
                                            "\" uses uniform blocks, storage blocks or atomic counters; "
                                            "expected plain uniforms, sampler2D and image2D only");
    }
}

void GlProgram::list_uniforms()
{
    GLint count = 0, longest = 0;
    glGetProgramInterfaceiv(id_, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    glGetProgramInterfaceiv(id_, GL_UNIFORM, GL_MAX_NAME_LENGTH, &longest);
    for (GLuint i = 0; i < GLuint(count); ++i) {
        std::string buffer(size_t(longest) + 1, '\0');
        glGetProgramResourceName(id_, GL_UNIFORM, i, GLsizei(buffer.size()), nullptr, buffer.data());
        std::string name = buffer.c_str();
        if (name.ends_with("[0]"))
            name.resize(name.size() - 3);
        const GLenum asked[] = {GL_LOCATION, GL_TYPE, GL_ARRAY_SIZE};
        GLint answer[3] = {};
        glGetProgramResourceiv(id_, GL_UNIFORM, i, 3, asked, 3, nullptr, answer);
        const Uniform uniform{answer[0], GLenum(answer[1]), answer[2]};

        if (name.starts_with("brume_")) {
            take_host_uniform(name, uniform);
        } else if (find_type(uniform.type)) {
            uniforms_[name] = uniform;
        } else if ((uniform.type == GL_SAMPLER_2D || uniform.type == GL_IMAGE_2D) && uniform.size == 1) {
            slots_[name] = {uniform.location, uniform.type == GL_IMAGE_2D};
        } else {
            throw Error(BRUME_ERROR_GL, "program \"" + name_ + "\": uniform " + name +
                                            " has a type that passes cannot set; "
                                            "expected float, int, their vectors, bool, sampler2D or image2D");
        }
    }
}

// A misspelt one would stay zero, and nobody would know why the picture is black.
void GlProgram::take_host_uniform(const std::string &name, const Uniform &uniform)
{
    const auto member_of = [&](std::string_view prefix, const auto &members, std::vector<Member> &out) {
        if (!std::string_view(name).starts_with(prefix))
            return false;
        for (const brume_constant &member : members)
            if (name.substr(prefix.size()) == member.name && holds(uniform, member.type, member.components)) {
                out.push_back({uniform, member.offset});
                out.back().uniform.size = std::min(GLint(member.count), uniform.size);
                return true;
            }
        return false;
    };
    if (name == "brume_grid" && uniform.type == GL_INT_VEC2)
        grid_ = uniform;
    else if (name == "brume_output_limit" && uniform.type == GL_FLOAT)
        output_limit_ = uniform;
    else if (!member_of("brume_medium.", medium_members, medium_members_) &&
             !member_of("brume_camera.", camera_members, camera_members_))
        throw Error(BRUME_ERROR_GL,
                    "program \"" + name_ + "\": uniform " + name +
                        " is none that the host sets; expected ivec2 brume_grid, Medium brume_medium, Camera "
                        "brume_camera, float brume_output_limit, or a name that does not begin with brume_");
}

void GlProgram::set_unit(Slot &slot, GLuint unit) const
{
    if (slot.unit == unit)
        return;
    glProgramUniform1i(id_, slot.location, GLint(unit));
    slot.unit = unit;
}

void GlProgram::set(const Uniform &uniform, const void *data) const
{
    const GLsizei n = uniform.size;
    const auto *floats = static_cast<const GLfloat *>(data);
    const auto *ints = static_cast<const GLint *>(data);
    switch (uniform.type) {
    case GL_FLOAT:
        glProgramUniform1fv(id_, uniform.location, n, floats);
        break;
    case GL_FLOAT_VEC2:
        glProgramUniform2fv(id_, uniform.location, n, floats);
        break;
    case GL_FLOAT_VEC3:
        glProgramUniform3fv(id_, uniform.location, n, floats);
        break;
    case GL_FLOAT_VEC4:
        glProgramUniform4fv(id_, uniform.location, n, floats);
        break;
    case GL_BOOL:
    case GL_INT:
        glProgramUniform1iv(id_, uniform.location, n, ints);
        break;
    case GL_INT_VEC2:
        glProgramUniform2iv(id_, uniform.location, n, ints);
        break;
    case GL_INT_VEC3:
        glProgramUniform3iv(id_, uniform.location, n, ints);
        break;
    case GL_INT_VEC4:
        glProgramUniform4iv(id_, uniform.location, n, ints);
        break;
    }
}

void GlProgram::set_grid(int32_t width, int32_t height) const
{
    const GLint grid[2] = {width, height};
    if (grid_.location >= 0)
        set(grid_, grid);
}

void GlProgram::set_scene(const brume_plugin_scene &scene)
{
    const auto set_members = [&](const std::vector<Member> &members, const void *from) {
        for (const Member &member : members)
            set(member.uniform, static_cast<const char *>(from) + member.offset);
    };
    if (!medium_members_.empty() && (!set_ || std::memcmp(&medium_, scene.medium, sizeof medium_) != 0)) {
        medium_ = *scene.medium;
        set_members(medium_members_, &medium_);
    }
    if (!camera_members_.empty() && (!set_ || std::memcmp(&camera_, scene.camera, sizeof camera_) != 0)) {
        camera_ = *scene.camera;
        set_members(camera_members_, &camera_);
    }
    if (output_limit_.location >= 0 && (!set_ || limit_ != scene.output_limit)) {
        limit_ = scene.output_limit;
        set(output_limit_, &limit_);
    }
    set_ = true;
}

bool holds(const GlProgram::Uniform &uniform, uint32_t type, uint32_t components)
{
    const Type *declared = find_type(uniform.type);
    return declared && declared->type == type && declared->components == components;
}

const char *type_text(const GlProgram::Uniform &uniform)
{
    return find_type(uniform.type)->text;
}

}  // namespace brume::gl
