#include "colour/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {

void write_png(const std::filesystem::path &file, int width, int height, const std::vector<std::uint8_t> &rgb)
{
    PendingFile pending(file);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width);
    image.height = png_uint_32(height);
    image.format = PNG_FORMAT_RGB;
    if (!png_image_write_to_file(&image, pending.path().c_str(), 0, rgb.data(), 0, nullptr))
        throw FrameError(fmt::format("{}: cannot be written: {}", file.string(), image.message));
    pending.commit();
}

}  // namespace brume::tool
