#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "gl/gl_backend.h"
#include "host_context.h"

namespace brume::test {

std::unique_ptr<Backend> owned_backend();
std::unique_ptr<Backend> borrowed_backend(uint32_t state = BRUME_GL_STATE_PRESERVE);

// Status of what `work` throws, and its message; BRUME_OK and "" if nothing.
struct Failure {
    brume_status status;
    std::string message;
};
Failure failure_of(const std::function<void()> &work);

// An image of the caller's memory; strides 0 for packed ones.
brume_image host_image(void *data, int32_t width, int32_t height, uint32_t channels, uint32_t pixel = BRUME_PIXEL_F32);
brume_image texture_image(GLuint texture, int32_t width, int32_t height, uint32_t channels = 4);

// A pass with its bindings and uniforms, as effects build them.
struct Pass {
    Pass(const char *name, Program &program, int32_t width, int32_t height);
    Pass &bind(const char *name, Image &image, uint32_t access);
    Pass &set(const char *name, const std::vector<float> &values);
    Pass &set(const char *name, const std::vector<int32_t> &values);
    void run(Backend &backend, const brume_plugin_scene &scene = {});

    brume_plugin_pass pass{};
    std::vector<brume_plugin_binding> bindings;
    std::vector<brume_plugin_uniform> uniforms;
    std::vector<std::vector<float>> floats;
    std::vector<std::vector<int32_t>> ints;
};

// target = source * factor, pixel by pixel.
extern const char *const scale_source;

std::vector<float> ramp(size_t count);

}  // namespace brume::test
