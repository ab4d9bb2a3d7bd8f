#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "run/options.hpp"
#include "image/depth_window.hpp"
#include "image/frame.hpp"
#include "frames/pattern.hpp"
#include "run/depth_count.hpp"
#include "run/inputs.hpp"
#include "run/shot.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
    std::string input, plugins;
    PictureOptions picture;
    bool json = false;
    std::vector<std::string> inputs;  ///< role=layer
};

ordered_json window_of(const Window &w)
{
    return {{"x", w.min.x}, {"y", w.min.y}, {"width", w.width()}, {"height", w.height()}};
}

ordered_json parts_of(const ImageFile &file)
{
    ordered_json parts = ordered_json::array();
    for (const PartInfo &part : file.parts()) {
        ordered_json p{{"name", part.name},
                       {"view", part.view},
                       {"deep", part.deep},
                       {"tiled", part.tiled},
                       {"data_window", window_of(part.data_window)},
                       {"channels", ordered_json::array()}};
        for (const ChannelInfo &c : part.channels)
            p["channels"].push_back({{"name", c.name}, {"type", name_of(c.type)}});
        parts.push_back(std::move(p));
    }
    return parts;
}

void describe_depth(ordered_json &info, const ImageFile &file, const InfoOptions &options, const ColorChoice *color,
                    int frame)
{
    const std::string depth_file = options.picture.depth_file();
    const auto describe = [&](const ImageFile &source, DepthChoice depth) {
        options.picture.take_depth_scale(depth, source);
        const auto values = read_depth(source, depth);
        const DepthCount count = count_depth(values, options.picture.depth_kind(), options.picture.far);
        info["depth"] = {{"channel", depth.channel},
                         {"part", source.parts()[depth.part].label()},
                         {"chosen", depth.reason},
                         {"kind", options.picture.depth_kind().text()},
                         {"far", options.picture.far},
                         {"data_window", window_of(source.parts()[depth.part].data_window)},
                         {"nearest", count.nearest},
                         {"farthest", count.farthest},
                         {"far_pixels", count.far},
                         {"nan_pixels", count.nan},
                         {"notes", depth_warnings(count, options.picture.depth_kind(), options.picture.far,
                                                  source.parts()[depth.part].find(depth.channel)->type)}};
        if (color)
            check_depth_window(file, *color, source, depth);
        if (&source != &file)
            info["depth"]["file"] = source.path().string();
    };
    if (!depth_file.empty()) {
        const ImageFile source(FilePattern(depth_file).existing_at(frame));
        return describe(source, resolve_depth(source, options.picture.depth_request(), nullptr));
    }
    std::string why_not;
    if (const auto depth = find_depth(file, options.picture.layers, color, &why_not))
        describe(file, *depth);
    else if (!options.picture.layers.depth.empty())
        throw RequestError(why_not);
    else
        info["depth"] = {{"none", why_not}};
}

void describe_camera(ordered_json &info, const ImageFile &file, const InfoOptions &options, const ColorChoice &color,
                     int frame)
{
    const Camera camera = camera_of_picture(file, color, options.picture, {}, frame);
    ordered_json &c = info["camera"] = ordered_json::object();
    if (camera.projection) {
        c["vertical_fov"] = camera.projection->vertical_fov() * 180 / M_PI;
        c["center"] = camera.projection->center();
        c["fov_from"] = camera.projection_source;
    }
    if (camera.pose) {
        c["camera_to_world"] = *camera.pose;
        c["pose_from"] = camera.pose_source;
    }
    if (!camera.notes.empty())
        c["notes"] = camera.notes;
}

void describe_inputs(ordered_json &info, const ImageFile &file, const InfoOptions &options, const ColorChoice *color,
                     int frame)
{
    const Context context = create_context("cpu", options.plugins);
    const std::vector<InputRequest> asked = parse_inputs(context, options.inputs);
    if (!color && asked.empty())
        return;
    if (!color)
        throw RequestError(
            fmt::format("--input {}: {} has no colour that it could go with", asked.front().role, file.path().string()));
    info["inputs"] = ordered_json::object();
    for (const OpenInput &input : open_inputs(file, *color, frame, asked, {}, {}, {}, {}))
        info["inputs"][input.choice.role] = description(input);
    // No scene says here that some effect will want them.
    for (const std::string &role : known_roles(context))
        if (!info["inputs"].contains(role))
            try {
                if (auto choice = find_known_input(file, role, *color))
                    info["inputs"][role] = description({std::move(*choice), std::nullopt});
            } catch (const RequestError &e) {
                info["inputs"][role] = fmt::format("none: {}", e.what());
            }
}

std::string window_text(const ordered_json &w)
{
    return fmt::format("{} x {} at ({}, {})", w["width"].get<int>(), w["height"].get<int>(), w["x"].get<int>(),
                       w["y"].get<int>());
}

std::string text(const ordered_json &value)
{
    return printable(value.get<std::string>());
}

void print_text(const ordered_json &info)
{
    fmt::print("file     {}\n", text(info["file"]));
    if (info.contains("frames"))
        fmt::print("frames   {}\n", text(info["frames"]));
    if (info.contains("frame_notes"))
        for (const auto &note : info["frame_notes"])
            fmt::print("frames   {}\n", text(note));
    fmt::print("display  {}, pixel aspect {}\n", window_text(info["display_window"]), info["pixel_aspect"].get<double>());
    if (info.contains("notes"))
        for (const auto &note : info["notes"])
            fmt::print("file     {}\n", text(note));
    for (const auto &part : info["parts"]) {
        std::string channels;
        for (const auto &c : part["channels"])
            channels += fmt::format("{}{} ({})", channels.empty() ? "" : ", ", text(c["name"]), text(c["type"]));
        fmt::print("part     {}{}{}{}: {}\n", text(part["name"]).empty() ? "" : text(part["name"]) + ", ",
                   window_text(part["data_window"]), part["deep"].get<bool>() ? ", deep" : "",
                   part["tiled"].get<bool>() ? ", tiled" : "", channels);
    }
    const auto &color = info["color"];
    if (color.contains("none"))
        fmt::print("colour   none: {}\n", text(color["none"]));
    else
        fmt::print("colour   {} in {}: {}\n", text(color["channels"]), text(color["part"]), text(color["chosen"]));
    const auto &depth = info["depth"];
    if (depth.contains("none"))
        fmt::print("depth    none: {}\n", text(depth["none"]));
    else
        fmt::print("depth    {} in {}: {}; {}, {:g} to {:g}, {} far (sky from {:g}), {} NaN\n", text(depth["channel"]),
                   text(depth["part"]), text(depth["chosen"]), text(depth["kind"]), depth["nearest"].get<double>(),
                   depth["farthest"].get<double>(), depth["far_pixels"].get<std::uint64_t>(), depth["far"].get<double>(),
                   depth["nan_pixels"].get<std::uint64_t>());
    if (info.contains("inputs"))
        for (const auto &[role, choice] : info["inputs"].items())
            fmt::print("input    {}: {}\n", printable(role), text(choice));
    if (depth.contains("notes"))
        for (const auto &note : depth["notes"])
            fmt::print("depth    {}\n", text(note));
    const auto &camera = info["camera"];
    if (camera.contains("fov_from"))
        fmt::print("camera   vertical field of view {:.4g} degrees, centre ({:.4g}, {:.4g}), from {}\n",
                   camera["vertical_fov"].get<double>(), camera["center"][0].get<double>(),
                   camera["center"][1].get<double>(), text(camera["fov_from"]));
    if (camera.contains("pose_from")) {
        const auto &m = camera["camera_to_world"];
        fmt::print("camera   at ({:.6g}, {:.6g}, {:.6g}), from {}\n", m[3].get<double>(), m[7].get<double>(),
                   m[11].get<double>(), text(camera["pose_from"]));
    }
    if (!camera.contains("fov_from") && !camera.contains("pose_from"))
        fmt::print("camera   none in the metadata\n");
    if (camera.contains("notes"))
        for (const auto &note : camera["notes"])
            fmt::print("camera   {}\n", text(note));
}

int info(const InfoOptions &options)
{
    const FilePattern pattern(options.input);
    const auto files = list_frames(pattern, pattern, "");
    const ImageFile file(files.front().input);
    ordered_json info{{"file", file.path().string()}};
    if (pattern.is_sequence())
        info["frames"] = fmt::format("{} to {}, {} files", files.front().frame, files.back().frame, files.size());
    if (const auto notes = sequence_notes(pattern); !notes.empty())
        info["frame_notes"] = notes;
    info["display_window"] = window_of(file.part(0).display_window);
    info["pixel_aspect"] = file.part(0).pixel_aspect;
    if (!file.source().notes.empty())
        info["notes"] = file.source().notes;
    info["parts"] = parts_of(file);

    std::optional<ColorChoice> color;
    try {
        color = resolve_color(file, options.picture.layers);
        info["color"] = {{"channels", color->label()},
                         {"part", file.parts()[color->part].label()},
                         {"view", color->view},
                         {"chosen", color->reason}};
    } catch (const RequestError &e) {
        const LayerRequest &asked = options.picture.layers;
        if (!asked.color.empty() || !asked.part.empty() || !asked.view.empty())
            throw;
        info["color"] = {{"none", e.what()}};
    }
    describe_depth(info, file, options, color ? &*color : nullptr, files.front().frame);
    describe_inputs(info, file, options, color ? &*color : nullptr, files.front().frame);
    describe_camera(info, file, options, color.value_or(ColorChoice{}), files.front().frame);
    if (options.json)
        fmt::print("{}\n", info.dump(2, ' ', false, ordered_json::error_handler_t::replace));
    else
        print_text(info);
    return kDone;
}

}  // namespace

void add_info(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("info", "Say what was resolved: colour, depth, kind, far, camera, windows");
    auto options = std::make_shared<InfoOptions>();
    command->add_option("INPUT", options->input, "EXR file, or a pattern such as shot.%04d.exr")->required();
    command->add_flag("--json", options->json, "Print JSON");
    options->picture.add_to(*command);
    add_plugins_option(*command, options->plugins);
    add_input_option(*command, options->inputs);
    command->callback([&chosen, options] {
        options->picture.name_view({&options->input});
        chosen = [options] { return info(*options); };
    });
}

}  // namespace brume::tool
