#include "image/depth_window.hpp"

#include <cmath>

#include <fmt/format.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

double width(const Window &w)
{
    return double(w.max.x) - w.min.x + 1;
}

double height(const Window &w)
{
    return double(w.max.y) - w.min.y + 1;
}

/// A crop has some size and place of its own; the same share of both sides, from the scaled corner, is no chance. Very small
/// windows are what writers put where nothing was hit.
bool is_scaled(const Window &from, const Window &to)
{
    const double x = width(to) / width(from), y = height(to) / height(from);
    const auto about = [](double a, double b) { return std::abs(a - b) <= 1; };
    return (x <= 0.75 || x >= 4 / 3.) && x >= 1 / 9. && x <= 9 && width(to) >= 4 && height(to) >= 4 &&
           about(height(to), height(from) * x) && about(width(to), width(from) * y) && about(to.min.x, from.min.x * x) &&
           about(to.min.y, from.min.y * y);
}

std::string text(const Window &w)
{
    return fmt::format("{:.0f} x {:.0f} at ({}, {})", width(w), height(w), w.min.x, w.min.y);
}

}  // namespace

void check_depth_window(const ImageFile &file, const ColorChoice &color, const ImageFile &depth_file,
                        const DepthChoice &depth)
{
    const PartInfo &picture = file.part(color.part), &other = depth_file.part(depth.part);
    const Window &a = picture.data_window, &b = other.data_window;
    if (a == b)
        return;
    const Window &display = picture.display_window, &other_display = other.display_window;
    if (display == other_display && !is_scaled(a, b))
        return;
    throw RequestError(fmt::format(
        "{}: depth '{}' has another size than the picture {}: data window {} (display {}) for {} (display {}); expected "
        "depth of the picture's size",
        depth_file.path().string(), depth.channel, file.path().string(), text(b), text(other_display), text(a),
        text(display)));
}

}  // namespace brume::tool
