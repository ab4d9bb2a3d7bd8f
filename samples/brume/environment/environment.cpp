#include "environment/environment.hpp"

#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "environment/harmonics.hpp"
#include "image/frame.hpp"
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

void resolve_environment(const Context &context, Scene &scene)
{
    const std::string path = scene.environment_file();
    if (path.empty())
        return;
    try {
        const HarmonicsRgb coefficients = project_file(path, scene.info().environment_up);
        check_request(context, scene.set_environment({coefficients.begin(), coefficients.end()}), path);
    } catch (const FrameError &error) {
        throw RequestError(fmt::format("environment: {}", error.what()));
    }
}

}  // namespace brume::tool
