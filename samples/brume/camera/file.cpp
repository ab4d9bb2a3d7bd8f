#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "exr/file.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

using nlohmann::json;

double degrees(const json &block, const char *key, const std::string &file)
{
    const json &value = block.at(key);
    if (!value.is_number() || !(value.get<double>() > 0 && value.get<double>() < 180))
        throw RequestError(fmt::format("{}: {} is {} (expected degrees, above 0 and below 180)", file, key, value.dump()));
    return value.get<double>() * std::numbers::pi / 180;
}

Pose pose_of(const json &rows, const std::string &file)
{
    Pose pose;
    const auto fail = [&] {
        throw RequestError(fmt::format("{}: camera_to_world: expected four rows of four numbers", file));
    };
    if (!rows.is_array() || rows.size() != 4)
        fail();
    for (std::size_t r = 0; r < 4; ++r) {
        if (!rows[r].is_array() || rows[r].size() != 4)
            fail();
        for (std::size_t c = 0; c < 4; ++c) {
            if (!rows[r][c].is_number())
                fail();
            pose[4 * r + c] = rows[r][c].get<double>();
        }
    }
    return pose;
}

}  // namespace

Camera camera_from_file(const std::filesystem::path &path, const Imf::Header &picture)
{
    const std::string file = path.string();
    if (path.extension() == ".exr") {
        Camera camera = camera_from_metadata(ExrFile(path).header(0));
        if (!camera.projection && !camera.pose)
            throw RequestError(fmt::format("--camera {}: its metadata has no camera", file));
        return camera;
    }
    std::ifstream in(path);
    if (!in)
        throw RequestError(fmt::format("--camera {}: cannot be opened for reading", file));
    json root;
    try {
        root = json::parse(in);
    } catch (const json::parse_error &e) {
        throw RequestError(fmt::format("--camera {}: {}", file, e.what()));
    }
    const json &block = root.is_object() && root.contains("camera") ? root["camera"] : root;
    Camera camera;
    const bool vertical = block.is_object() && block.contains("vertical_fov");
    if (vertical || (block.is_object() && block.contains("horizontal_fov"))) {
        const auto make = vertical ? Projection::from_vertical_fov : Projection::from_horizontal_fov;
        camera.projection = make(degrees(block, vertical ? "vertical_fov" : "horizontal_fov", file), picture.displayWindow(),
                                 picture.pixelAspectRatio());
        camera.projection_source = file;
    }
    if (block.is_object() && block.contains("camera_to_world")) {
        camera.pose = pose_of(block["camera_to_world"], file);
        camera.pose_source = file;
    }
    if (!camera.projection && !camera.pose)
        throw RequestError(fmt::format("--camera {}: expected vertical_fov, horizontal_fov or camera_to_world", file));
    return camera;
}

}  // namespace brume::tool
