#include "gl/image.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "gl/error.h"

namespace brume::gl {
namespace {

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

uint64_t bytes_of(int32_t width, int32_t height, GLenum name)
{
    const Format &format = format_of(name);
    return uint64_t(width) * uint64_t(height) * uint64_t(format.channels) * (format.pixel == BRUME_PIXEL_F16 ? 2 : 4);
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
    if (width < 1 || height < 1)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("an image of {} x {}; expected at least 1 x 1", width, height));
    if (width > largest_size_ || height > largest_size_)
        throw Error(
            BRUME_ERROR_UNSUPPORTED,
            fmt::format("an image of {} x {} is larger than this device's textures, which have at most {} pixels a side",
                        width, height, largest_size_));

    std::unique_ptr<GlImage> image =
        idle_.take([&](const GlImage &one) { return one.width == width && one.height == height && one.format == format; });
    if (!image) {
        image = allocate(width, height, channels, format);
        if (!image) {
            idle_.trim();
            disposal_->collect();
            image = allocate(width, height, channels, format);
        }
        if (!image)
            throw Error(BRUME_ERROR_MEMORY, image_text(width, height, channels, pixel == BRUME_PIXEL_F16 ? "half" : "float",
                                                       bytes_of(width, height, format)) +
                                                ": out of device memory, of which " + std::to_string(bytes() / 1000000) +
                                                " MB are in use");
        idle_.add(*image);
    }
    return {image.release(),
            [pool = shared_from_this()](GlImage *back) { pool->idle_.put_back(std::unique_ptr<GlImage>(back)); },
            RecyclingAllocator<GlImage>()};
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
    image->bytes = bytes_of(width, height, format);
    return image;
}

}  // namespace brume::gl
