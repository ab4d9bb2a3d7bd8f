#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <ImathBox.h>
#include <ImfHeader.h>

namespace brume::tool {

/// What the display window sees: slopes of its edges at unit distance along the axis.
struct Projection {
    double left, right, bottom, top;

    double vertical_fov() const;           ///< [rad]
    std::array<double, 2> center() const;  ///< of the window, from its left and its top
    double pixel_aspect(const Imath::Box2i &display) const;

    static Projection from_vertical_fov(double radians, const Imath::Box2i &display, double pixel_aspect);
    static Projection from_horizontal_fov(double radians, const Imath::Box2i &display, double pixel_aspect);
};

/// Right-handed, looks down -z, +y up; row-major, points are columns.
using Pose = std::array<double, 16>;

struct Camera {
    std::optional<Projection> projection;
    std::optional<Pose> pose;
    std::string projection_source, pose_source;  ///< "worldToNDC", "--vfov", ...
    std::vector<std::string> notes;              ///< metadata that was there and could not be used

    /// Takes from `other` what is missing here.
    void fill_from(const Camera &other);
};

/// In this order, each part from the first that has it: worldToCamera and worldToNDC (the OpenEXR standard's), then V-Ray's
/// cameraTransform (camera-to-world) with cameraFov, or cameraAperture and cameraFocalLength.
Camera camera_from_metadata(const Imf::Header &header);

/// A scene file's camera block, alone or inside a whole scene file; or an EXR file whose metadata is meant.
Camera camera_from_file(const std::filesystem::path &file, const Imf::Header &picture);

}  // namespace brume::tool
