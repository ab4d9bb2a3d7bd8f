#include "run/sequence.hpp"

namespace brume::tool {

OpenFrame open_frame(const FrameFile &files, const PictureOptions &picture, const ReadLimits &limits)
{
    ExrFile file(files.input, limits);
    ColorChoice color = resolve_color(file, picture.layers);
    const std::string own_file = picture.depth_file();
    if (own_file.empty()) {
        DepthChoice depth = resolve_depth(file, picture.layers, &color);
        return {std::move(file), std::move(color), std::nullopt, std::move(depth)};
    }
    ExrFile depth_file(FilePattern(own_file).at(files.frame), limits);
    DepthChoice depth = resolve_depth(depth_file, picture.depth_request(), nullptr);
    return {std::move(file), std::move(color), std::move(depth_file), std::move(depth)};
}

}  // namespace brume::tool
