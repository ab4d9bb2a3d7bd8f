#include "image/file.hpp"

#include <fmt/format.h>

#include "exr/file.hpp"
#include "image/arrays.hpp"
#include "image/formats.hpp"
#include "image/library.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

std::shared_ptr<const PictureSource> open(const std::filesystem::path &path, const ReadLimits &limits)
{
    // Whoever opens a pipe waits for who fills it, and no format is read in one go.
    std::error_code none;
    if (const auto status = std::filesystem::status(path, none); exists(status) && !is_regular_file(status))
        throw FrameError(fmt::format("{}: is {} (expected a picture's file)", path.string(),
                                     is_directory(status) ? "a folder" : "a device or a pipe"));
    const Format *format = format_of(path);
    if (!format || is_exr(*format))
        return std::make_shared<ExrSource>(path, limits);
    if (is_array(*format))
        return open_array(path, *format, limits);
    return image_library().open(path, format->name, limits);
}

}  // namespace

ImageFile::ImageFile(std::filesystem::path path, const ReadLimits &limits)
    : path_(std::move(path)), source_(open(path_, limits))
{
}

}  // namespace brume::tool
