#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
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

// A pass as plans make theirs.
std::shared_ptr<Pass> make_pass(Backend &backend, const brume_pass_desc &desc);

// What a pass of the tests has: a name, slots, constants and a shader.
brume_pass_desc describe(const char *name, const std::vector<brume_slot> &slots,
                         const std::vector<brume_constant> &constants, uint32_t constant_size, const char *source);

// to = from * factor, pixel by pixel; the pass's shader samples `from` by `access`.
void scale(Backend &backend, Image &from, Image &to, float factor, uint32_t access = BRUME_ACCESS_FETCH);

std::vector<float> ramp(size_t count);

}  // namespace brume::test
