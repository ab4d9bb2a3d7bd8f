#include "environment/environment.hpp"

#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "environment/harmonics.hpp"
#include "image/frame.hpp"
#include "support/sdk.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

HarmonicsRgb project_file(const std::string &path, std::uint32_t up)
{
    ImageFile file(path);
    const ColorChoice color = resolve_color(file, {});
    Frame frame = read_frame(std::move(file), color, nullptr);
    ColorManager().file_to_working(frame);
    const Window whole = frame.file.part(color.part).display_window, &data = frame.part().data_window;
    if (!whole.contains(data.min) || !whole.contains(data.max))
        throw FrameError(fmt::format("{}: pixels outside the display window; expected a lat-long image within it", path));
    return project_latlong({whole.width(), whole.height(), data.min.x - whole.min.x, data.min.y - whole.min.y, frame.width,
                            frame.height, frame.pixels, frame.channels},
                           up);
}

}  // namespace

void resolve_environment(brume_context context, brume_scene scene)
{
    std::string path(brume_scene_environment_file(scene, nullptr, 0), '\0');
    brume_scene_environment_file(scene, path.data(), path.size());
    path.pop_back();
    if (path.empty())
        return;
    brume_scene_info info = BRUME_SCENE_INFO_INIT;
    check_request(context, brume_scene_get_info(scene, &info), "environment");
    try {
        const HarmonicsRgb coefficients = project_file(path, info.environment_up);
        check_request(context, brume_scene_set_environment(scene, coefficients[0].data(), kHarmonics), path);
    } catch (const FrameError &error) {
        throw RequestError(fmt::format("environment: {}", error.what()));
    }
}

}  // namespace brume::tool
