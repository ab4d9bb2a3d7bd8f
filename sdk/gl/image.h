#pragma once
#include <cstdint>
#include <memory>

#include <epoxy/gl.h>

#include "plan/backend.h"
#include "plan/idle_images.h"
#include "gl/disposal.h"

namespace brume::gl {

// Level 0 of a two-dimensional texture: a pooled one, or one of the host's.
struct GlImage : Image {
    GLuint texture = 0;
    GLenum format = 0;  // sized internal format
    uint64_t idle_since = 0;
    std::shared_ptr<Disposal> disposal;  // none: the host's

    GlImage() = default;
    ~GlImage() override;
    GlImage(const GlImage &) = delete;
    GlImage &operator=(const GlImage &) = delete;
};

// The format of an image of 1, 2 or 4 channels; throws Error(BRUME_ERROR_ARGUMENT).
GLenum image_format(int32_t channels, uint32_t pixel);

// Textures by size and format.
class ImagePool : public std::enable_shared_from_this<ImagePool> {
public:
    explicit ImagePool(std::shared_ptr<Disposal> disposal);

    // Where GL calls may be made. The image may be let go anywhere.
    std::shared_ptr<GlImage> take(int32_t width, int32_t height, int32_t channels, uint32_t pixel);
    void age() { idle_.age(); }
    void trim() { idle_.trim(); }
    // Frees what is idle and keeps nothing more; images still held outlive the pool.
    void close() { idle_.close(); }

    uint64_t bytes() const { return idle_.bytes(); }
    int32_t largest_size() const { return largest_size_; }

private:
    // None where the device has no memory left.
    std::unique_ptr<GlImage> allocate(int32_t width, int32_t height, int32_t channels, GLenum format);

    const std::shared_ptr<Disposal> disposal_;
    GLint largest_size_ = 0;
    IdleImages<GlImage> idle_;
};

}  // namespace brume::gl
