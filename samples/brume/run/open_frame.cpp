#include <fmt/format.h>

#include "image/depth_window.hpp"
#include "run/sequence.hpp"
#include "support/error.hpp"

namespace brume::tool {

OpenFrame open_frame(const FrameFile &files, const PictureOptions &picture, const ReadLimits &limits)
{
    ImageFile file(files.input, limits);
    ColorChoice color = resolve_color(file, picture.layers);
    const std::string own_file = picture.depth_file();
    if (own_file.empty()) {
        DepthChoice depth = resolve_depth(file, picture.layers, &color);
        picture.take_depth_scale(depth, file);
        check_depth_window(file, color, file, depth);
        return {std::move(file), std::move(color), std::nullopt, std::move(depth)};
    }
    const FilePattern depth_pattern(own_file);
    if (std::error_code error; !depth_pattern.is_sequence() && !std::filesystem::exists(own_file, error))
        throw RequestError(fmt::format("--depth {}: {}", own_file, error ? error.message() : "no such file"));
    ImageFile depth_file(depth_pattern.existing_at(files.frame), limits);
    DepthChoice depth = resolve_depth(depth_file, picture.depth_request(), nullptr);
    picture.take_depth_scale(depth, depth_file);
    check_depth_window(file, color, depth_file, depth);
    return {std::move(file), std::move(color), std::move(depth_file), std::move(depth)};
}

}  // namespace brume::tool
