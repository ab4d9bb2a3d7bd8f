#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "frames/pattern.hpp"
#include "run/sequence.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

struct PlanOptions {
    FogOptions fog;
    std::string input;
    bool json = false;
};

std::string camera_needs(std::uint32_t flags)
{
    const bool fov = flags & BRUME_CAMERA_FIELD_OF_VIEW, pose = flags & BRUME_CAMERA_POSE;
    return fov && pose ? "field of view and pose" : fov ? "field of view" : pose ? "pose" : "nothing";
}

int plan(const PlanOptions &options)
{
    const FilePattern pattern(options.input);
    const FrameFile first = list_frames(pattern, pattern, "").front();
    const OpenFrame open = open_frame(first, options.fog.picture, {});
    const ColorManager colors;
    Fogger fogger(options.fog);
    fogger.learn_roles(open.file, open.color, first.frame);
    const std::vector<OpenInput> inputs = fogger.open_inputs(open.file, open.color, first.frame, {});
    fogger.expect(open.file, open.color, open.depth_file ? *open.depth_file : open.file, open.depth, inputs, first.frame);
    const Plan &plan = fogger.plan_for(open.file, open.color, colors.luminance_weights(open.file.part(open.color.part)),
                                       roles_of(inputs), first.frame);
    const Shot shot = fogger.shot_of(open.file, open.color, first.frame);

    const brume_plan_info info = plan.info();
    const brume_context_info device = fogger.context().info();
    ordered_json entries = ordered_json::array();
    for (const brume_plan_entry &e : plan.entries())
        entries.push_back({{"runs", e.runs != 0},
                           {"effect", e.effect},
                           {"pass", e.name},
                           {"reason", e.reason},
                           {"bytes", e.bytes},
                           {"operations", e.operations},
                           {"predicted_ms", e.predicted_ms}});
    ordered_json given = ordered_json::object();
    for (const OpenInput &input : inputs)
        given[name_of(input)] = description(input);
    const ordered_json out{
        {"scene", options.fog.scene},
        {"lights", fogger.scene_info().light_count},
        {"gaussians", fogger.scene_info().gaussian_count},
        {"environment", fogger.scene_info().environment_count},
        {"input", first.input.string()},
        {"backend", backend_name(device.backend)},
        {"device", device.device},
        {"color", open.color.label()},
        {"depth", open.depth.channel},
        {"inputs", given},
        {"does_nothing", info.does_nothing != 0},
        {"needs_of_camera", camera_needs(info.camera_needs)},
        {"camera_reason", info.camera_reason},
        {"camera", shot.camera_source},
        {"camera_notes", shot.camera_notes},
        {"image_bytes", info.image_bytes},
        {"quality", info.quality},
        {"predicted_ms", info.predicted_ms},
        {"predicted_error", info.predicted_error < 0 ? ordered_json() : ordered_json(info.predicted_error)},
        {"entries", entries}};
    if (options.json) {
        fmt::print("{}\n", out.dump(2, ' ', false, ordered_json::error_handler_t::replace));
        return kDone;
    }
    const PartInfo &part = open.file.parts()[open.color.part];
    fmt::print("{} x {} pixels on {} ({})\n", part.width(), part.height(), backend_name(device.backend), device.device);
    fmt::print("colour {}; depth {}\n", open.color.label(), open.depth.channel);
    for (const OpenInput &input : inputs)
        fmt::print("input {} from {}\n", name_of(input), printable(description(input)));
    fmt::print("{} lights; {} Gaussians; {} coefficients of the environment\n", out["lights"].get<int>(),
               out["gaussians"].get<int>(), out["environment"].get<int>());
    for (const auto &e : entries) {
        const std::string name = fmt::format("{}/{}", e["effect"].get<std::string>(), e["pass"].get<std::string>());
        const std::string cost =
            e["runs"].get<bool>()
                ? fmt::format("{:8.2f} MiB {:8.3f} ms", e["bytes"].get<double>() / 1048576, e["predicted_ms"].get<double>())
                : fmt::format("{:>24}", "dropped");
        fmt::print("  {:<36} {}  {}\n", name, cost, e["reason"].get<std::string>());
    }
    if (info.does_nothing)
        fmt::print("nothing to do: the picture is copied, bit for bit\n");
    fmt::print("camera: needs {}{}{}\n", camera_needs(info.camera_needs), info.camera_needs ? ": " : "",
               info.camera_needs ? info.camera_reason : "");
    fmt::print("camera: {}\n", printable(shot.camera_source));
    for (const std::string &note : shot.camera_notes)
        fmt::print("camera: {}\n", printable(note));
    if (*info.quality)
        fmt::print("quality: {}\n", info.quality);
    fmt::print("predicted {:.3f} ms a frame; {:.1f} MiB of images; error against the references {}\n", info.predicted_ms,
               double(info.image_bytes) / 1048576,
               info.predicted_error < 0 ? "not predicted for these parameters"
                                        : fmt::format("below {:.2g}", info.predicted_error));
    return kDone;
}

}  // namespace

void add_plan(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("plan", "Say what would run, why, what was dropped, and the predicted cost");
    auto options = std::make_shared<PlanOptions>();
    options->fog.add_to(*command);
    command->add_option("INPUT", options->input, "EXR file, or a pattern: its first frame is planned for")->required();
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([&chosen, options] {
        options->fog.picture.name_view({&options->input});
        chosen = [options] { return plan(*options); };
    });
}

}  // namespace brume::tool
