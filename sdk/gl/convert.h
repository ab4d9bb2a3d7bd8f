#pragma once
#include <memory>

#include "gl/image.h"
#include "gl/pass.h"

namespace brume::gl {

struct Rectangle {
    int32_t x, y, width, height;
};

inline Rectangle all_of(const GlImage &image)
{
    return {0, 0, image.width, image.height};
}

// Copies pixels between images of different formats: halves and packed formats round to nearest even whatever the driver
// does, one channel is spread over RGB with alpha 1, and of several the first becomes the one. Where the rectangles differ
// in size, each pixel of the second becomes that of the first in which its centre lies.
class Converter {
public:
    explicit Converter(std::shared_ptr<Disposal> disposal);

    void convert(const GlImage &from, const Rectangle &source, const GlImage &to, const Rectangle &target,
                 const Samplers &samplers, StateGuard &guard);
    // The same with the rounding left to the driver's image stores.
    void store(const GlImage &from, const GlImage &to, const Samplers &samplers, StateGuard &guard);

private:
    void run(const GlImage &from, const Rectangle &source, const GlImage &to, const Rectangle &target, int32_t rounding,
             const Samplers &samplers, StateGuard &guard);

    GlPass pass_;
};

bool is_half(GLenum format);
// GL_R11F_G11F_B10F or GL_RGB10_A2, which only the converter writes.
bool is_packed(GLenum format);

}  // namespace brume::gl
