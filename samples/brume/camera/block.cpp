#include "camera/block.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/error.hpp"

namespace brume::tool {
namespace {

using nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAny = std::numeric_limits<double>::max();

}  // namespace

double CameraBlock::Number::at(double frame) const
{
    const auto after = keys.upper_bound(frame);
    if (after == keys.begin())
        return after->second;
    const auto before = std::prev(after);
    if (after == keys.end())
        return before->second;
    return std::lerp(before->second, after->second, (frame - before->first) / (after->first - before->first));
}

CameraBlock::Number CameraBlock::read(const json &value, const std::string &what, const char *expected, double low,
                                      double high)
{
    Number number;
    const auto add = [&](double frame, const json &v) {
        if (!v.is_number() || !(v.get<double>() >= low && v.get<double>() <= high))
            throw RequestError(fmt::format("{} is {} (expected {})", what, v.dump(), expected));
        number.keys[frame] = v.get<double>();
    };
    if (!value.is_object()) {
        add(0, value);
        return number;
    }
    if (value.size() == 1 && value.contains("keys") && value["keys"].is_array())
        for (const json &key : value["keys"]) {
            if (!key.is_array() || key.size() != 2 || !key[0].is_number())
                throw RequestError(fmt::format("{}: key {} (expected [frame, value])", what, key.dump()));
            add(key[0].get<double>(), key[1]);
        }
    if (number.keys.empty())
        throw RequestError(
            fmt::format("{} is {} (expected {}, or {{\"keys\": [[frame, value], ...]}})", what, value.dump(), expected));
    return number;
}

CameraBlock::CameraBlock(const json &block, const std::string &file)
{
    const auto what = [&](const std::string &key) { return file + ": " + key; };
    constexpr const char *kAngle = "degrees, above 0 and below 180";
    constexpr const char *kRows = "four rows of four numbers";
    if (!block.is_object())
        throw RequestError(fmt::format("{}: expected a camera block: {{\"vertical_fov\": 50, ...}}", file));
    for (const auto &[key, value] : block.items()) {
        if (key == "vertical_fov" || key == "horizontal_fov") {
            (key[0] == 'v' ? vertical_fov_ : horizontal_fov_) = read(value, what(key), kAngle, 1e-4, 179.9999);
        } else if (key == "pixel_aspect") {
            pixel_aspect_ = read(value, what(key), "a number from 0.001 to 1000", 1e-3, 1e3);
        } else if (key == "center") {
            if (!value.is_array() || value.size() != 2)
                throw RequestError(fmt::format("{} is {} (expected two numbers)", what(key), value.dump()));
            center_.emplace();
            for (std::size_t i = 0; i < 2; ++i)
                (*center_)[i] = read(value[i], what(key), "numbers from -1e6 to 1e6", -1e6, 1e6);
        } else if (key == "camera_to_world") {
            pose_.emplace();
            if (!value.is_array() || value.size() != 4)
                throw RequestError(fmt::format("{}: expected {}", what(key), kRows));
            for (std::size_t r = 0; r < 4; ++r) {
                if (!value[r].is_array() || value[r].size() != 4)
                    throw RequestError(fmt::format("{}: expected {}", what(key), kRows));
                for (std::size_t c = 0; c < 4; ++c)
                    (*pose_)[4 * r + c] = read(value[r][c], what(key), kRows, -kAny, kAny);
            }
        } else {
            throw RequestError(fmt::format(
                "{}: unknown key '{}' (expected vertical_fov, horizontal_fov, pixel_aspect, center and camera_to_world)",
                file, key));
        }
    }
    if (vertical_fov_ && horizontal_fov_)
        throw RequestError(fmt::format("{}: vertical_fov and horizontal_fov exclude each other", file));
    if (!pose_)
        return;
    std::set<double> frames;
    for (const Number &n : *pose_)
        for (const auto &[frame, value] : n.keys)
            frames.insert(frame);
    for (const double frame : frames) {
        Pose pose;
        for (std::size_t i = 0; i < 16; ++i)
            pose[i] = (*pose_)[i].at(frame);
        if (const std::string defect = rigid_defect(pose); !defect.empty())
            throw RequestError(
                fmt::format("{}: {}{} (expected a rigid motion: orthonormal columns, determinant 1, last row 0 0 0 1)",
                            what("camera_to_world"), defect, frames.size() > 1 ? fmt::format(" at frame {}", frame) : ""));
    }
}

CameraBlock CameraBlock::of_scene(const std::string &text, const std::string &file)
{
    const json root = json::parse(text, nullptr, false);
    return root.is_object() && root.contains("camera") ? CameraBlock(root["camera"], file) : CameraBlock();
}

double CameraBlock::aspect(double frame, const PartInfo &picture) const
{
    if (pixel_aspect_)
        return pixel_aspect_->at(frame);
    const double ratio = picture.pixel_aspect;
    return ratio >= 1e-3 && ratio <= 1e3 ? ratio : 1;
}

std::array<double, 2> CameraBlock::center(double frame) const
{
    return center_ ? std::array{(*center_)[0].at(frame), (*center_)[1].at(frame)} : std::array{0.5, 0.5};
}

Projection CameraBlock::with_vertical_fov(double radians, double frame, const PartInfo &picture) const
{
    return Projection::from_vertical_fov(radians, picture.display_window, aspect(frame, picture), center(frame));
}

Camera CameraBlock::at(double frame, const PartInfo &picture, const std::string &source) const
{
    Camera camera;
    if (vertical_fov_)
        camera.projection = with_vertical_fov(vertical_fov_->at(frame) * kDegree, frame, picture);
    else if (horizontal_fov_)
        camera.projection = Projection::from_horizontal_fov(horizontal_fov_->at(frame) * kDegree, picture.display_window,
                                                            aspect(frame, picture), center(frame));
    if (camera.projection)
        camera.projection_source = source;
    if (pose_) {
        camera.pose.emplace();
        for (std::size_t i = 0; i < 16; ++i)
            (*camera.pose)[i] = (*pose_)[i].at(frame);
        camera.pose_source = source;
    }
    return camera;
}

}  // namespace brume::tool
