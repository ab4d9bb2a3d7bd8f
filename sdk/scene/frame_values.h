#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "scene/scene.h"
#include "base/scene_ranges.h"
#include "base/value_name.h"

namespace brume {

// A scene's numbers at one frame, each checked.
class FrameValues {
public:
    explicit FrameValues(double frame) : frame_(frame) {}

    double frame() const { return frame_; }

    double check(double value, const Range &range, const ValueName &name) const
    {
        if (!range.contains(value))
            refuse(value, range, name.text());
        return value;
    }

    double get(const Number &number, const Range &range, const ValueName &name) const
    {
        return check(number.at(frame_), range, name);
    }

    std::array<double, 3> get(const Number3 &numbers, const Range &range, const ValueName &name) const
    {
        std::array<double, 3> values;
        for (size_t i = 0; i < 3; ++i) {
            values[i] = numbers[i].at(frame_);
            if (!range.contains(values[i]))
                refuse(values[i], range, fmt::format("{}[{}]", name.text(), i));
        }
        return values;
    }

    std::array<double, 3> unit_vector(const Number3 &numbers, const ValueName &name) const
    {
        std::array<double, 3> v = get(numbers, ranges::any, name);
        const double length = std::hypot(v[0], v[1], v[2]);
        if (length == 0.0)
            throw Error(BRUME_ERROR_ARGUMENT,
                        fmt::format("{}: (0, 0, 0) at frame {}; expected a vector that is not zero", name.text(), frame_));
        for (double &x : v)
            x /= length;
        return v;
    }

private:
    [[noreturn]] void refuse(double value, const Range &range, const std::string &name) const
    {
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}: {} at frame {}; expected {}", name, value, frame_, range.describe()));
    }

    double frame_;
};

// Of the camera, in metres.
struct Pose {
    std::array<double, 3> position;
    std::array<std::array<double, 3>, 3> axes;
    double metres_per_unit;

    Pose(const std::array<double, 16> &camera_to_world, double metres, const FrameValues &values) : metres_per_unit(metres)
    {
        const auto &m = camera_to_world;
        values.check(metres_per_unit, ranges::positive, "metres_per_unit");
        static constexpr std::string_view rows[] = {"camera.camera_to_world[0]", "camera.camera_to_world[1]",
                                                    "camera.camera_to_world[2]", "camera.camera_to_world[3]"};
        for (size_t i = 0; i < m.size(); ++i)
            values.check(m[i], ranges::any, {rows[i / 4], int64_t(i % 4)});
        for (size_t row = 0; row < 3; ++row) {
            position[row] = m[4 * row + 3] * metres_per_unit;
            for (size_t column = 0; column < 3; ++column)
                axes[column][row] = m[4 * row + column];
        }
    }

    std::array<double, 3> rotated(const std::array<double, 3> &v) const
    {
        std::array<double, 3> out;
        for (size_t axis = 0; axis < 3; ++axis)
            out[axis] = axes[axis][0] * v[0] + axes[axis][1] * v[1] + axes[axis][2] * v[2];
        return out;
    }

    // A point in scene units as seen from the camera [m]. Subtracts before it rounds: both may be far from the origin.
    std::array<double, 3> seen(const std::array<double, 3> &point) const
    {
        return rotated({point[0] * metres_per_unit - position[0], point[1] * metres_per_unit - position[1],
                        point[2] * metres_per_unit - position[2]});
    }
};

}  // namespace brume
