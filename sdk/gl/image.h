#pragma once
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include <epoxy/gl.h>

#include "core/backend.h"
#include "gl/disposal.h"

namespace brume::gl {

// Level 0 of a two-dimensional texture: a pooled one, or one of the host's.
struct GlImage : Image {
    GLuint texture = 0;
    GLenum format = 0;  // sized internal format
    uint64_t bytes = 0;
    std::shared_ptr<Disposal> disposal;  // none: the host's
    uint64_t idle_since = 0;             // of the pool

    GlImage() = default;
    ~GlImage() override;
    GlImage(const GlImage &) = delete;
    GlImage &operator=(const GlImage &) = delete;
};

// The format of an image of 1, 2 or 4 channels; throws Error(BRUME_ERROR_ARGUMENT).
GLenum image_format(int32_t channels, uint32_t pixel);

// Textures by size and format. What nobody holds waits for the next taker, and is freed after some frames without one.
class ImagePool : public std::enable_shared_from_this<ImagePool> {
public:
    explicit ImagePool(std::shared_ptr<Disposal> disposal);

    // Where GL calls may be made. The image may be let go anywhere.
    std::shared_ptr<GlImage> take(int32_t width, int32_t height, int32_t channels, uint32_t pixel);
    // A frame has ended.
    void age();
    // Frees what is idle and keeps nothing more; images still held outlive the pool.
    void close();

    uint64_t bytes() const { return bytes_; }
    int32_t largest_size() const { return largest_size_; }

private:
    // None where the device has no memory left.
    std::unique_ptr<GlImage> allocate(int32_t width, int32_t height, int32_t channels, GLenum format);
    std::unique_ptr<GlImage> find_idle(int32_t width, int32_t height, GLenum format);
    void put_back(std::unique_ptr<GlImage> image) noexcept;
    void free_idle(uint64_t idle_before);

    const std::shared_ptr<Disposal> disposal_;
    GLint largest_size_ = 0;
    std::mutex mutex_;
    std::vector<std::unique_ptr<GlImage>> idle_;
    size_t count_ = 0;  // of images, held ones included
    uint64_t frame_ = 0;
    bool closed_ = false;
    std::atomic<uint64_t> bytes_ = 0;
};

}  // namespace brume::gl
