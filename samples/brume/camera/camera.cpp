#include "camera/camera.hpp"

#include <cmath>

namespace brume::tool {

double Projection::vertical_fov() const
{
    return 2 * std::atan(0.5 * (top - bottom));
}

std::array<double, 2> Projection::center() const
{
    return {-left / (right - left), top / (top - bottom)};
}

double Projection::pixel_aspect(const Imath::Box2i &display) const
{
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    return (right - left) / width / ((top - bottom) / height);
}

Projection Projection::from_vertical_fov(double radians, const Imath::Box2i &display, double pixel_aspect)
{
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    const double y = std::tan(0.5 * radians), x = y * width * pixel_aspect / height;
    return {-x, x, -y, y};
}

Projection Projection::from_horizontal_fov(double radians, const Imath::Box2i &display, double pixel_aspect)
{
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    const double x = std::tan(0.5 * radians), y = x * height / (width * pixel_aspect);
    return {-x, x, -y, y};
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
    notes.insert(notes.end(), other.notes.begin(), other.notes.end());
}

}  // namespace brume::tool
