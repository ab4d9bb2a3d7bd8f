#pragma once
#include <cstdint>

#include "gl/borrowed_context.h"

namespace openfx {

// One channel of a texture, in a texture of its own, as the library takes depth. Lives in the context that was current when
// it was made.
class ChannelTexture {
public:
    ChannelTexture();
    ~ChannelTexture();
    ChannelTexture(const ChannelTexture &) = delete;
    ChannelTexture &operator=(const ChannelTexture &) = delete;

    // The name of the copy, which the next one overwrites. The texture is a GL_TEXTURE_2D of this size.
    uint32_t copy(uint32_t texture, int channel, int width, int height);

private:
    const brume::gl::BorrowedContext context_;
    uint32_t program_ = 0, sampler_ = 0, copy_ = 0;
    int width_ = 0, height_ = 0;
};

}  // namespace openfx
