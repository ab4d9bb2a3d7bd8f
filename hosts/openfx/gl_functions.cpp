// OpenGL's functions in place of libepoxy, which the bundle would have to bring: the pointers that its header declares,
// filled from the window-system library that the host has loaded.
#include "gl_functions.h"

#include <cstdlib>
#include <cstring>
#include <mutex>

#include <dlfcn.h>
#include <epoxy/gl.h>

#include "base/error.h"
#include "gl/egl_context.h"

// clang-format off
#define FUNCTIONS(F) \
    F(ActiveTexture) F(AttachShader) F(BindBuffer) F(BindImageTexture) F(BindSampler) F(BindTexture) \
    F(BindTextureUnit) F(ClearTexImage) F(CompileShader) F(CopyImageSubData) F(CreateProgram) \
    F(CreateProgramPipelines) F(CreateQueries) F(CreateSamplers) F(CreateShader) F(CreateShaderProgramv) \
    F(CreateTextures) F(DebugMessageControl) F(DeleteProgram) F(DeleteProgramPipelines) F(DeleteQueries) \
    F(DeleteSamplers) F(DeleteShader) F(DeleteTextures) F(DetachShader) F(DispatchCompute) F(GetError) F(GetFloatv) \
    F(GetIntegeri_v) F(GetIntegerv) F(GetObjectLabel) F(GetProgramInfoLog) F(GetProgramInterfaceiv) \
    F(GetProgramResourceName) F(GetProgramResourceiv) F(GetProgramiv) F(GetQueryObjectui64v) F(GetShaderInfoLog) \
    F(GetShaderiv) F(GetString) F(GetTextureLevelParameteriv) F(GetTextureParameteriv) F(GetTextureSubImage) \
    F(IsProgramPipeline) F(IsTexture) F(LinkProgram) F(MemoryBarrier) F(ObjectLabel) F(PauseTransformFeedback) \
    F(PixelStorei) F(PixelTransferf) F(PopDebugGroup) F(ProgramUniform1fv) F(ProgramUniform1i) F(ProgramUniform1iv) \
    F(ProgramUniform2fv) F(ProgramUniform2iv) F(ProgramUniform3fv) F(ProgramUniform3iv) F(ProgramUniform4fv) \
    F(ProgramUniform4iv) F(PushDebugGroup) F(QueryCounter) F(ResumeTransformFeedback) F(SamplerParameteri) \
    F(ShaderSource) F(TextureStorage2D) F(TextureSubImage2D) F(UseProgram)
// clang-format on

#define DEFINE(name) decltype(epoxy_gl##name) epoxy_gl##name = nullptr;
extern "C" {
FUNCTIONS(DEFINE)

bool epoxy_is_desktop_gl()
{
    const auto *version = reinterpret_cast<const char *>(glGetString(GL_VERSION));
    return version && std::strncmp(version, "OpenGL ES", 9) != 0;
}

int epoxy_gl_version()
{
    const auto *version = reinterpret_cast<const char *>(glGetString(GL_VERSION));
    char *minor = nullptr;
    const long major = version ? std::strtol(version, &minor, 10) : 0;
    return int(10 * major + (minor && *minor == '.' ? std::strtol(minor + 1, nullptr, 10) : 0));
}
}

namespace openfx {
namespace {

using Function = void (*)();

// True where all were found. A library that the host has not loaded has no context that could be current.
bool fill_from(const char *library, const char *lookup)
{
    void *handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
    if (!handle)
        return false;
    const auto get = reinterpret_cast<Function (*)(const char *)>(dlsym(handle, lookup));
    bool all = get != nullptr;
#define FILL(name) all = all && (epoxy_gl##name = reinterpret_cast<decltype(epoxy_gl##name)>(get("gl" #name)));
    FUNCTIONS(FILL)
    dlclose(handle);
    return all;
}

}  // namespace

bool load_gl()
{
    static std::mutex mutex;
    static bool loaded = false;
    const std::lock_guard lock(mutex);
    if (!loaded)
        loaded = fill_from("libEGL.so.1", "eglGetProcAddress") || fill_from("libGLX.so.0", "glXGetProcAddressARB") ||
                 fill_from("libGL.so.1", "glXGetProcAddressARB");
    return loaded;
}

}  // namespace openfx

// The bundle has no context but the host's.
namespace brume::gl {

EglContext::EglContext()
{
    throw Error(BRUME_ERROR_GL, "the OpenFX bundle makes no OpenGL context of its own; expected BRUME_GL_BORROWED");
}

EglContext::~EglContext() = default;

}  // namespace brume::gl
