#include "gl/program.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
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
    {GL_FLOAT, BRUME_UNIFORM_FLOAT, 1, "float"},     {GL_FLOAT_VEC2, BRUME_UNIFORM_FLOAT, 2, "vec2"},
    {GL_FLOAT_VEC3, BRUME_UNIFORM_FLOAT, 3, "vec3"}, {GL_FLOAT_VEC4, BRUME_UNIFORM_FLOAT, 4, "vec4"},
    {GL_INT, BRUME_UNIFORM_INT, 1, "int"},           {GL_INT_VEC2, BRUME_UNIFORM_INT, 2, "ivec2"},
    {GL_INT_VEC3, BRUME_UNIFORM_INT, 3, "ivec3"},    {GL_INT_VEC4, BRUME_UNIFORM_INT, 4, "ivec4"},
    {GL_BOOL, BRUME_UNIFORM_INT, 1, "bool"},
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
    const ProgramSource assembled = assemble_program(name_, source, defines);
    const char *text = assembled.text.c_str();
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    glShaderSource(shader, 1, &text, nullptr);
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
    GLuint textures = 0, images = 0;
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

        if (find_type(uniform.type)) {
            uniforms_[name] = uniform;
        } else if ((uniform.type == GL_SAMPLER_2D || uniform.type == GL_IMAGE_2D) && uniform.size == 1) {
            const bool image = uniform.type == GL_IMAGE_2D;
            const GLuint unit = image ? images++ : textures++;
            glProgramUniform1i(id_, uniform.location, GLint(unit));
            slots_[name] = {unit, image};
        } else {
            throw Error(BRUME_ERROR_GL, "program \"" + name_ + "\": uniform " + name +
                                            " has a type that passes cannot set; "
                                            "expected float, int, their vectors, bool, sampler2D or image2D");
        }
    }
}

void GlProgram::set(const char *name, uint32_t type, uint32_t components, uint32_t count, const void *data)
{
    const auto found = uniforms_.find(std::string_view(name));
    if (found == uniforms_.end())
        return;
    const Uniform &uniform = found->second;
    const Type &declared = *find_type(uniform.type);
    if (declared.type != type || declared.components != components)
        throw Error(BRUME_ERROR_ARGUMENT, "program \"" + name_ + "\": uniform " + name + " is " + declared.text +
                                              "; the pass gives " + std::to_string(components) +
                                              (type == BRUME_UNIFORM_FLOAT ? " float" : " int") + " components");
    // Compilers shorten arrays to what is used.
    const GLsizei n = std::min(GLsizei(count), GLsizei(uniform.size));
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

void GlProgram::set_grid(int32_t width, int32_t height)
{
    const int32_t grid[2] = {width, height};
    set("brume_grid", BRUME_UNIFORM_INT, 2, 1, grid);
}

void GlProgram::set_scene(const brume_plugin_scene &scene)
{
    if (scene_ && std::memcmp(&*scene_, &scene, sizeof scene) == 0)
        return;
    const auto set_float = [&](const char *name, uint32_t components, const float *data, uint32_t count = 1) {
        set(name, BRUME_UNIFORM_FLOAT, components, count, data);
    };
    const auto set_int = [&](const char *name, const int32_t &value) { set(name, BRUME_UNIFORM_INT, 1, 1, &value); };

    const brume_plugin_medium &medium = scene.medium;
    set_float("brume_medium.scattering", 3, medium.scattering);
    set_float("brume_medium.absorption", 3, medium.absorption);
    set_float("brume_medium.emission", 3, medium.emission);
    set_float("brume_medium.luminance", 3, medium.luminance);
    set_float("brume_medium.phase", 4, medium.phase);
    set_float("brume_medium.noise", 4, medium.noise);
    set_float("brume_medium.noise_shift", 3, medium.noise_shift);
    set_float("brume_medium.asymmetry", 1, &medium.asymmetry);
    set_float("brume_medium.constant", 1, &medium.constant);
    set_int("brume_medium.term_count", medium.term_count);
    set_float("brume_medium.terms", 4, &medium.terms[0][0], BRUME_MAX_DENSITY_TERMS);

    const brume_plugin_camera &camera = scene.camera;
    set_float("brume_camera.focal", 2, camera.focal);
    set_float("brume_camera.tangent_scale", 2, camera.tangent_scale);
    set_float("brume_camera.center", 2, camera.center);
    set_int("brume_camera.depth_kind", camera.depth_kind);
    set_int("brume_camera.sky", camera.sky);
    set_float("brume_camera.depth_range", 2, camera.depth_range);
    set_float("brume_camera.far_distance", 1, &camera.far_distance);
    set_float("brume_camera.sky_distance", 1, &camera.sky_distance);
    set_float("brume_camera.metres_per_unit", 1, &camera.metres_per_unit);
    set_int("brume_camera.nonpositive", camera.nonpositive);
    set_float("brume_camera.right", 3, camera.right);
    set_float("brume_camera.up", 3, camera.up);
    set_float("brume_camera.back", 3, camera.back);

    set_float("brume_output_limit", 1, &scene.output_limit);
    scene_ = scene;
}

}  // namespace brume::gl
