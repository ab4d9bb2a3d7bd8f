#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "camera/camera.hpp"

namespace brume::tool {

/// A scene file's camera block: what it gives, which may be keyed by frame. Throws RequestError, which names `file`.
class CameraBlock {
public:
    CameraBlock() = default;
    CameraBlock(const nlohmann::json &block, const std::string &file);

    /// The block inside a scene file's text; empty where that has none. The library checks scenes.
    static CameraBlock of_scene(const std::string &text, const std::string &file);

    bool gives_field_of_view() const { return vertical_fov_ || horizontal_fov_; }
    bool gives_pose() const { return pose_.has_value(); }

    /// Pixels have the picture's aspect where the block has none.
    Camera at(double frame, const PartInfo &picture, const std::string &source) const;

    /// Another field of view with the block's centre and aspect.
    Projection with_vertical_fov(double radians, double frame, const PartInfo &picture) const;

private:
    /// Linear between keys, constant beyond them.
    struct Number {
        std::map<double, double> keys;
        double at(double frame) const;
    };
    static Number read(const nlohmann::json &value, const std::string &what, const char *expected, double low, double high);

    double aspect(double frame, const PartInfo &picture) const;
    std::array<double, 2> center(double frame) const;

    std::optional<Number> vertical_fov_, horizontal_fov_, pixel_aspect_;  ///< angles in degrees
    std::optional<std::array<Number, 2>> center_;
    std::optional<std::array<Number, 16>> pose_;
};

/// --camera: a scene file's camera block, alone or inside a whole scene file; or an EXR file whose metadata is meant, that
/// of its part with `view` where it has several.
Camera camera_from_file(const std::filesystem::path &file, const PartInfo &picture, const std::string &view = "",
                        double frame = 0);

}  // namespace brume::tool
