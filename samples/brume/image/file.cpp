#include "image/file.hpp"

#include "exr/file.hpp"
#include "image/arrays.hpp"
#include "image/formats.hpp"
#include "image/library.hpp"

namespace brume::tool {
namespace {

std::shared_ptr<const PictureSource> open(const std::filesystem::path &path, const ReadLimits &limits)
{
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
