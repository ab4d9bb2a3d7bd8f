#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "camera/block.hpp"
#include "image/file.hpp"
#include "image/narrow.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

Camera camera_from_exr(const std::filesystem::path &path, const std::string &view)
{
    const ImageFile file(path);
    int part = 0;
    for (const PartInfo &p : file.parts())
        if (!view.empty() && p.view == view) {
            part = p.index;
            break;
        }
    Camera camera = camera_from_metadata(file, part, Implausible::kTaken);
    if (!camera.projection && !camera.pose)
        throw RequestError(fmt::format("--camera {}: its metadata has no camera{}{}", path.string(),
                                       camera.notes.empty() ? "" : ": ", camera.notes_text()));
    return camera;
}

}  // namespace

Camera camera_from_file(const std::filesystem::path &path, const PartInfo &picture, const std::string &view, double frame)
try {
    if (lower(path.extension().string()) == ".exr")
        return camera_from_exr(path, view);
    const std::string name = "--camera " + path.string();
    std::ifstream in(path);
    if (!in)
        throw RequestError(fmt::format("{}: cannot be opened for reading", name));
    nlohmann::json root;
    try {
        root = nlohmann::json::parse(in);
    } catch (const nlohmann::json::parse_error &e) {
        throw RequestError(fmt::format("{}: {}", name, e.what()));
    }
    const CameraBlock block(root.is_object() && root.contains("camera") ? root["camera"] : root, name);
    if (!block.gives_field_of_view() && !block.gives_pose())
        throw RequestError(fmt::format("{}: expected vertical_fov, horizontal_fov or camera_to_world", name));
    return block.at(frame, picture, path.string());
} catch (const FrameError &e) {
    // It is no frame that cannot be read here, but what the request names.
    throw RequestError(std::string("--camera ") + e.what());
}

}  // namespace brume::tool
