#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/types.hpp"

namespace brume::tool {

class ImageFile;

/// What the display window sees: slopes of its edges at unit distance along the axis.
struct Projection {
    double left, right, bottom, top;

    double vertical_fov() const;           ///< [rad]
    std::array<double, 2> center() const;  ///< of the window, from its left and its top
    double pixel_aspect(const Window &display) const;

    static Projection from_vertical_fov(double radians, const Window &display, double pixel_aspect,
                                        std::array<double, 2> center = {0.5, 0.5});
    static Projection from_horizontal_fov(double radians, const Window &display, double pixel_aspect,
                                          std::array<double, 2> center = {0.5, 0.5});
};

/// Right-handed, looks down -z, +y up; row-major, points are columns.
using Pose = std::array<double, 16>;

/// What is wrong with it as a rigid motion; empty where nothing is.
std::string rigid_defect(const Pose &pose);

struct Camera {
    std::optional<Projection> projection;
    std::optional<Pose> pose;
    std::string projection_source, pose_source;  ///< "worldToNDC", "--vfov", ...
    std::vector<std::string> notes;              ///< metadata that was there and could not be used

    /// Takes from `other` what is missing here.
    void fill_from(const Camera &other);
    std::string notes_text() const;
};

/// Whether a field of view that no real camera has is taken as it stands, or noted and left.
enum class Implausible { kRefused, kTaken };

/// In this order, each part from the first that has it: worldToCamera and worldToNDC (the OpenEXR standard's), then V-Ray's
/// cameraTransform (camera-to-world) with cameraFov, or cameraAperture and cameraFocalLength.
Camera camera_from_metadata(const PartInfo &part, Implausible implausible = Implausible::kRefused);

/// The same of a part and, for what that lacks, of the other parts of its view.
Camera camera_from_metadata(const ImageFile &file, int part, Implausible implausible = Implausible::kRefused);

}  // namespace brume::tool
