#include "camera/camera.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "image/file.hpp"

namespace brume::tool {
namespace {

Projection around(const std::array<double, 2> &center, double x, double y)
{
    return {-center[0] * 2 * x, (1 - center[0]) * 2 * x, -(1 - center[1]) * 2 * y, center[1] * 2 * y};
}

}  // namespace

double Projection::vertical_fov() const
{
    return 2 * std::atan(0.5 * (top - bottom));
}

std::array<double, 2> Projection::center() const
{
    return {-left / (right - left), top / (top - bottom)};
}

double Projection::pixel_aspect(const Window &display) const
{
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    return (right - left) / width / ((top - bottom) / height);
}

Projection Projection::from_vertical_fov(double radians, const Window &display, double pixel_aspect,
                                         std::array<double, 2> center)
{
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    const double y = std::tan(0.5 * radians);
    return around(center, y * width * pixel_aspect / height, y);
}

Projection Projection::from_horizontal_fov(double radians, const Window &display, double pixel_aspect,
                                           std::array<double, 2> center)
{
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    const double x = std::tan(0.5 * radians);
    return around(center, x, x * height / (width * pixel_aspect));
}

std::string rigid_defect(const Pose &m)
{
    constexpr double kTolerance = 1e-3;
    for (const double v : m)
        if (!std::isfinite(v))
            return fmt::format("it has the element {}", v);
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
        return fmt::format("its last row is {} {} {} {}", m[12], m[13], m[14], m[15]);
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = a; b < 3; ++b) {
            const double product = m[a] * m[b] + m[4 + a] * m[4 + b] + m[8 + a] * m[8 + b];
            if (!(std::abs(product - (a == b)) <= kTolerance))
                return a == b ? fmt::format("its column {} has length {:.6g}", a, std::sqrt(product))
                              : fmt::format("its columns {} and {} have the product {:.6g}", a, b, product);
        }
    const double determinant =
        m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
    return determinant > 0 ? "" : "it mirrors: its determinant is negative";
}

void Camera::fill_from(const Camera &other)
{
    if (!projection && other.projection) {
        projection = other.projection;
        projection_source = other.projection_source;
    }
    if (!pose && other.pose) {
        pose = other.pose;
        pose_source = other.pose_source;
    }
    for (const std::string &note : other.notes)
        if (std::find(notes.begin(), notes.end(), note) == notes.end())
            notes.push_back(note);
}

std::string Camera::notes_text() const
{
    return fmt::format("{}", fmt::join(notes, "; "));
}

Camera camera_from_metadata(const ImageFile &file, int part, Implausible implausible)
{
    Camera camera = camera_from_metadata(file.part(part), implausible);
    const std::string &view = file.part(part).view;
    for (const PartInfo &other : file.parts()) {
        if (other.index == part || (!view.empty() && !other.view.empty() && other.view != view))
            continue;
        Camera found = camera_from_metadata(other, implausible);
        found.projection_source += " of " + other.label();
        found.pose_source += " of " + other.label();
        camera.fill_from(found);
    }
    return camera;
}

}  // namespace brume::tool
