#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/report.hpp"
#include "commands/commands.hpp"
#include "run/fogger.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct BenchCommand {
    FogOptions fog;
    BenchOptions options;
    std::string input, truth, scale = "1", json, markdown, svg, png;
};

int factor_of(const std::string &scale)
{
    for (const int factor : {1, 2, 4, 8, 16})
        if (scale == (factor == 1 ? "1" : fmt::format("1/{}", factor)))
            return factor;
    throw RequestError(fmt::format("--scale '{}': expected 1, 1/2, 1/4, 1/8 or 1/16", scale));
}

void check_ending(const std::string &option, const std::string &file, const std::string &ending)
{
    if (!file.empty() && !file.ends_with(ending))
        throw RequestError(fmt::format("{} '{}': expected a name ending in {}", option, file, ending));
}

Sample sample_of(const BenchCommand &command, Fogger &fogger, const SceneText &scene)
{
    const CameraBlock camera = CameraBlock::of_scene(scene.text, scene.name);
    const FilePattern pattern(command.input);
    const Sample whole = [&] {
        try {
            return load_sample(list_frames(pattern, pattern, "").front(), command.fog.picture, camera, command.truth,
                               &fogger);
        } catch (const FrameError &e) {
            // There is no other frame to go on with.
            throw RequestError(e.what());
        }
    }();
    const int factor = factor_of(command.scale);
    if (factor > whole.width() || factor > whole.height())
        throw RequestError(
            fmt::format("--scale {}: {} is {} x {} pixels", command.scale, whole.name, whole.width(), whole.height()));
    return factor == 1 ? whole : reduced(whole, factor);
}

int bench(const BenchCommand &command)
{
    check_ending("--svg", command.svg, ".svg");
    check_ending("--png", command.png, ".png");
    const SceneText scene = read_scene(command.fog.scene, command.fog.set);
    Fogger fogger(command.fog);  // before the picture, so that errors in the scene come first, and from the library
    const Context &context = fogger.context(), cpu = create_context("cpu", command.fog.plugins);
    const Sample sample = sample_of(command, fogger, scene);
    BenchReport report = report_for(context, scene, sample, command.options);
    const std::vector<std::string> effects = effects_to_measure(context, scene, sample);
    if (effects.empty())
        throw RequestError(fmt::format("{}: nothing to measure: no effect does anything here", scene.name));
    report.copy_ms = copy_ms(sample, command.options.repeat);
    report.median_optical_depth = median_optical_depth(context, scene, sample);
    for (const std::string &effect : effects) {
        const Reference reference = make_reference(cpu, scene, sample, effect, command.options);
        report.groups.push_back(measure_group(context, scene, sample, reference, report.copy_ms, command.options));
    }
    const std::string table = markdown_of(report);
    fmt::print("{}", table);
    if (!command.json.empty())
        write_text(command.json,
                   json_of(report).dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    if (!command.markdown.empty())
        write_text(command.markdown, table);
    for (const std::string &file : {command.svg, command.png})
        if (!file.empty())
            draw_chart(file, chart_of(report));
    return kDone;
}

}  // namespace

void add_bench(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("bench", "Error against time of each effect's settings on your scene and frame");
    auto options = std::make_shared<BenchCommand>();
    options->fog.add_scene_to(*command);
    add_input_option(*command, options->fog.inputs);
    command->add_option("FRAME", options->input, "EXR file, or a pattern: its first frame is taken")->required();
    command->add_option("--truth", options->truth, "EXR of the same view path-traced in the medium")->type_name("FILE");
    command->add_option("--scale", options->scale, "Reduce the frame first: 1, 1/2, 1/4, 1/8 or 1/16")
        ->capture_default_str();
    command->add_option("--repeat", options->options.repeat, "Times are medians of this many")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000));
    command
        ->add_option("--reference-width", options->options.reference_width,
                     "Halve the frame for the references until it is no wider, however long they take")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--reference-seconds", options->options.reference_seconds,
                     "Halve the frame for the references until they take no longer, about")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command->add_option("--json", options->json, "Write JSON")->type_name("FILE");
    command->add_option("--md", options->markdown, "Write the table as Markdown")->type_name("FILE");
    command->add_option("--svg", options->svg, "Draw the plot")->type_name("FILE.svg");
    command->add_option("--png", options->png, "Draw the plot")->type_name("FILE.png");
    command->callback([&chosen, options] { chosen = [options] { return bench(*options); }; });
}

}  // namespace brume::tool
