#include "gl/image.h"

#include <algorithm>
#include <limits>
#include <string>

#include "core/error.h"
#include "gl/error.h"

namespace brume::gl {
namespace {

// Plans used in turn, or a resized window that snaps back, find their images again within this many frames.
constexpr uint64_t idle_frames = 8;

struct Format {
    GLenum name;
    int32_t channels;
    uint32_t pixel;
    const char *text;
};

constexpr Format formats[] = {
    {GL_R32F, 1, BRUME_PIXEL_F32, "R32F"},       {GL_R16F, 1, BRUME_PIXEL_F16, "R16F"},
    {GL_RG32F, 2, BRUME_PIXEL_F32, "RG32F"},     {GL_RG16F, 2, BRUME_PIXEL_F16, "RG16F"},
    {GL_RGBA32F, 4, BRUME_PIXEL_F32, "RGBA32F"}, {GL_RGBA16F, 4, BRUME_PIXEL_F16, "RGBA16F"},
};

const Format &format_of(GLenum name)
{
    return *std::find_if(std::begin(formats), std::end(formats), [&](const Format &f) { return f.name == name; });
}

}  // namespace

GlImage::~GlImage()
{
    if (disposal)
        disposal->add(Disposal::Kind::texture, texture);
}

GLenum image_format(int32_t channels, uint32_t pixel)
{
    for (const Format &format : formats)
        if (format.channels == channels && format.pixel == pixel)
            return format.name;
    throw Error(BRUME_ERROR_ARGUMENT, "an image of " + std::to_string(channels) + " channels and pixel type " +
                                          std::to_string(pixel) +
                                          "; expected 1, 2 or 4 channels of BRUME_PIXEL_F32 or _F16");
}

ImagePool::ImagePool(std::shared_ptr<Disposal> disposal) : disposal_(std::move(disposal))
{
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_size_);
}

std::shared_ptr<GlImage> ImagePool::take(int32_t width, int32_t height, int32_t channels, uint32_t pixel)
{
    const GLenum format = image_format(channels, pixel);
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1)
        throw Error(BRUME_ERROR_ARGUMENT, "an image of " + size + "; expected at least 1 x 1");
    if (width > largest_size_ || height > largest_size_)
        throw Error(BRUME_ERROR_UNSUPPORTED, "an image of " + size +
                                                 " is larger than this device's textures, which have at most " +
                                                 std::to_string(largest_size_) + " pixels a side");

    std::unique_ptr<GlImage> image = find_idle(width, height, format);
    if (!image)
        image = allocate(width, height, channels, format);
    if (!image) {
        free_idle(std::numeric_limits<uint64_t>::max());
        disposal_->collect();
        image = allocate(width, height, channels, format);
    }
    if (!image)
        throw Error(BRUME_ERROR_MEMORY, "no device memory for an image of " + size + " " + format_of(format).text + "; " +
                                            std::to_string(bytes_ >> 20) + " MiB are in use");
    return {image.release(), [pool = shared_from_this()](GlImage *back) { pool->put_back(std::unique_ptr<GlImage>(back)); }};
}

void ImagePool::age()
{
    uint64_t frame;
    {
        std::lock_guard lock(mutex_);
        frame = ++frame_;
    }
    if (frame > idle_frames)
        free_idle(frame - idle_frames);
}

void ImagePool::close()
{
    {
        std::lock_guard lock(mutex_);
        closed_ = true;
    }
    free_idle(std::numeric_limits<uint64_t>::max());
}

std::unique_ptr<GlImage> ImagePool::find_idle(int32_t width, int32_t height, GLenum format)
{
    std::lock_guard lock(mutex_);
    auto found = std::find_if(idle_.begin(), idle_.end(), [&](const auto &image) {
        return image->width == width && image->height == height && image->format == format;
    });
    if (found == idle_.end())
        return nullptr;
    std::unique_ptr<GlImage> image = std::move(*found);
    idle_.erase(found);
    return image;
}

std::unique_ptr<GlImage> ImagePool::allocate(int32_t width, int32_t height, int32_t channels, GLenum format)
{
    const Format &layout = format_of(format);
    throw_on_error("before an allocation");

    auto image = std::make_unique<GlImage>();
    glCreateTextures(GL_TEXTURE_2D, 1, &image->texture);
    image->disposal = disposal_;
    glTextureStorage2D(image->texture, 1, format, width, height);
    const GLenum error = take_error();
    if (error == GL_OUT_OF_MEMORY)
        return nullptr;
    if (error != GL_NO_ERROR)
        throw Error(BRUME_ERROR_GL, "glTextureStorage2D, " + std::to_string(width) + " x " + std::to_string(height) + " " +
                                        layout.text + ": OpenGL reports " + error_name(error));

    image->width = width;
    image->height = height;
    image->channels = channels;
    image->format = format;
    image->bytes = uint64_t(width) * uint64_t(height) * uint64_t(channels) * (layout.pixel == BRUME_PIXEL_F16 ? 2 : 4);
    {
        std::lock_guard lock(mutex_);
        idle_.reserve(++count_);  // so that put_back() cannot fail
    }
    bytes_ += image->bytes;
    return image;
}

void ImagePool::put_back(std::unique_ptr<GlImage> image) noexcept
{
    std::unique_lock lock(mutex_);
    if (closed_) {
        bytes_ -= image->bytes;
        lock.unlock();
        return;
    }
    image->idle_since = frame_;
    idle_.push_back(std::move(image));
}

void ImagePool::free_idle(uint64_t idle_before)
{
    std::lock_guard lock(mutex_);
    std::erase_if(idle_, [&](const auto &image) {
        if (image->idle_since >= idle_before)
            return false;
        bytes_ -= image->bytes;
        --count_;
        return true;
    });
}

}  // namespace brume::gl
