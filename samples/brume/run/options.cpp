#include "run/options.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "frames/pattern.hpp"
#include "image/formats.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
DepthKind DepthKind::parse(const std::string &text)
{
    if (text == "planar")
        return {kPlanar};
    if (text == "ray")
        return {kRay};
    if (text == "inverse")
        return {kInverse};
    if (text == "negative")
        return {kNegative};
    constexpr std::string_view prefix = "normalized:";
    if (const auto comma = text.find(','); text.starts_with(prefix) && comma != std::string::npos) {
        DepthKind kind{kNormalized};
        if (parse_number(text.substr(prefix.size(), comma - prefix.size()), kind.near) &&
            parse_number(text.substr(comma + 1), kind.far) && kind.near >= 0 && kind.far > kind.near)
            return kind;
    }
    throw RequestError(fmt::format(
        "--depth-kind '{}': expected planar, ray, negative, inverse or normalized:NEAR,FAR with 0 <= NEAR < FAR", text));
}

std::string DepthKind::text() const
{
    switch (type) {
    case kPlanar:
        return "planar";
    case kRay:
        return "ray";
    case kInverse:
        return "inverse";
    case kNegative:
        return "negative";
    default:
        return fmt::format("normalized:{},{}", near, far);
    }
}

void DepthKind::convert(std::vector<float> &depth) const
{
    if (type != kNegative)
        return;
    // Infinite of either sign is far.
    for (float &z : depth)
        z = std::isinf(z) ? std::abs(z) : -z;
}

Sky Sky::parse(const std::string &text)
{
    if (text == "fog")
        return {kFog};
    if (text == "keep")
        return {kKeep};
    constexpr std::string_view prefix = "clamp:";
    Sky sky{kClamp};
    if (text.starts_with(prefix) && parse_number(text.substr(prefix.size()), sky.distance) && sky.distance > 0)
        return sky;
    throw RequestError(fmt::format("--sky '{}': expected fog, keep or clamp:DISTANCE with DISTANCE > 0", text));
}

std::string Sky::text() const
{
    return type == kFog ? "fog" : type == kKeep ? "keep" : fmt::format("clamp:{}", distance);
}

void add_plugins_option(CLI::App &command, std::string &plugins)
{
    command.add_option("--plugins", plugins, "Directory of further effects, see `brume effects`")->type_name("DIR");
}

void add_output_options(CLI::App &command, ColorRequest &spaces, std::string &output_type)
{
    command
        .add_option("--input-space", spaces.input_space,
                    "Colour space of the pixels (default: what the file says, or scene_linear of the config)")
        ->type_name("SPACE");
    command.add_option("--output-space", spaces.output_space, "Colour space to write (default: as they came)")
        ->type_name("SPACE");
    command
        .add_option("--output-type", output_type,
                    "uint8, uint16, half or float, for outputs that are no rewritten EXR (default: what loses least)")
        ->type_name("{uint8,uint16,half,float}");
}

void PictureOptions::add_to(CLI::App &command)
{
    command
        .add_option("--color", layers.color,
                    "Layer that is the colour (default: root RGB, the default view, a sole RGB layer)")
        ->type_name("LAYER");
    command.add_option("--part", layers.part, "Part of a multi-part file, by name or index")->type_name("NAME");
    command.add_option("--view", layers.view, "View of a stereo file, or of files that have %V in their names")
        ->type_name("NAME");
    command
        .add_option("--depth", layers.depth,
                    "Depth channel, exact name; FILE or FILE:CHANNEL for a file of its own, EXR, PNG, TIFF, PFM or NPY")
        ->type_name("NAME");
    command
        .add_option("--depth-scale", depth_scale,
                    "Scene units in one step of depth that is stored as integers, such as 0.001")
        ->check(CLI::PositiveNumber);
    command
        .add_option("--depth-kind", depth_kind_text,
                    "planar, ray, negative (planar, of the other sign), inverse or normalized:NEAR,FAR")
        ->capture_default_str()
        ->type_name("KIND");
    command.add_option("--far", far, "Distances from here on are sky, in scene units")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command.add_flag("--zero-is-near", zero_is_near, "Depth of 0 or less is at the camera, not sky");
    command.add_option("--sky", sky_text, "fog, keep or clamp:DISTANCE")->capture_default_str()->type_name("HOW");
    auto *fov = command.add_option("--vfov", vertical_fov, "Vertical field of view of the display window, in degrees")
                    ->type_name("DEG");
    auto *camera = command
                       .add_option("--camera", camera_file,
                                   "Camera from a JSON file or another EXR's metadata, or a pattern of such files")
                       ->type_name("FILE");
    fov->check([](const std::string &text) {
        double value = 0;
        return parse_number(text, value) && value >= 1e-4 && value <= 179.9999 ? ""
                                                                               : "expected degrees, above 0 and below 180";
    });
    fov->excludes(camera);
}

void PictureOptions::name_view(std::initializer_list<std::string *> files)
{
    if (layers.view.empty())
        return;
    const std::string view = layers.view;
    const auto put = [&](std::string &name) {
        bool named = false;
        // A file that is really called so is meant literally.
        if (std::error_code none; std::filesystem::exists(name, none))
            return named;
        for (const auto &[mark, text] : {std::pair{"%V", view}, std::pair{"%v", view.substr(0, 1)}})
            for (std::size_t at = 0; (at = name.find(mark, at)) != name.npos; at += text.size()) {
                name.replace(at, 2, text);
                named = true;
            }
        return named;
    };
    for (std::string *name : files)
        if (put(*name) && name == *files.begin())
            layers.view.clear();
    put(layers.depth);
    put(camera_file);
}

std::string PictureOptions::depth_file() const
{
    const auto end = end_of_file_name(layers.depth);
    return end == std::string::npos ? "" : layers.depth.substr(0, end);
}

LayerRequest PictureOptions::depth_request() const
{
    LayerRequest request = layers;
    if (const auto end = end_of_file_name(layers.depth); end != std::string::npos)
        request.depth = layers.depth.substr(std::min(layers.depth.size(), end + 1));
    return request;
}

void PictureOptions::take_depth_scale(DepthChoice &depth, const ImageFile &file) const
{
    const SampleType type = file.part(depth.part).find(depth.channel)->type;
    if (depth_scale == 0 && is_normalized(type))
        throw RequestError(fmt::format("{}: depth '{}' is stored as {}; expected --depth-scale, the scene units in one step",
                                       file.path().string(), depth.channel, name_of(type)));
    if (depth_scale != 0)
        depth.scale = depth_scale;
}

Camera PictureOptions::camera_asked(const PartInfo &picture, const CameraBlock &scene, const std::string &view,
                                    int frame) const
{
    Camera camera;
    if (!camera_file.empty())
        camera = camera_from_file(FilePattern(camera_file).existing_at(frame), picture, view, frame);
    if (vertical_fov > 0) {
        camera.projection = scene.with_vertical_fov(vertical_fov * std::numbers::pi / 180, frame, picture);
        camera.projection_source = "--vfov";
    }
    return camera;
}

}  // namespace brume::tool
