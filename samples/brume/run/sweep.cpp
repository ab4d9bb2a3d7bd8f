#include "run/sweep.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "image/library.hpp"
#include "run/checks.hpp"
#include "run/interrupt.hpp"
#include "run/picture_io.hpp"
#include "run/progress.hpp"
#include "run/scene.hpp"
#include "run/vary.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

constexpr const char *kTransmittance = "transmittance";

struct Sample {
    int number = 0;
    ordered_json line;
    Frame frame;
    std::vector<AddedLayer> layers;
    FrameStats stats;
    std::string provenance;
};
using SamplePtr = std::shared_ptr<Sample>;

SequenceOptions as_run(const SweepOptions &options, const std::string &output)
{
    SequenceOptions run;
    run.fog = options.fog;
    run.input = options.input;
    run.output = output;
    return run;
}

FogOptions with_transmittance(const SweepOptions &options)
{
    FogOptions fog = options.fog;
    if (!options.transmittance.empty())
        fog.layers = {kTransmittance};
    return fog;
}

class Sweep {
public:
    Sweep(const SweepOptions &options, const FrameFile &input, std::vector<FrameFile> outputs)
        : options_(options), input_(input), outputs_(std::move(outputs)), transmittance_(options.transmittance),
          io_({options.fog.picture, options.spaces, options.output, options.output_type, {}}, {input}),
          fogger_(with_transmittance(options))
    {
        for (const std::string &text : options.vary)
            variations_.push_back(Variation::parse(text));
        scene_ = ordered_json::parse(read_scene(options.fog.scene, {}).text);
        // Scenes that some sample would not be allowed are found before any is written.
        for (int i = 1; i <= options.count; ++i)
            change_scene(i);
    }

    int run()
    {
        namespace tbb = oneapi::tbb;
        FrameStats stats;
        stats.files = input_;
        const OpenFrame open = open_frame(input_, options_.fog.picture, io_.limits());
        fogger_.learn_roles(open.file, open.color, input_.frame);
        set_image_threads(int(std::max(1u, std::thread::hardware_concurrency())));
        const Frame frame = io_.read(fogger_, weights_, stats);
        for (const std::string &warning : stats.warnings)
            note(warning);
        stats.warnings.clear();
        fogger_.plan_for(frame.file, frame.color, weights_,
                         roles_of(fogger_.open_inputs(frame.file, frame.color, input_.frame, io_.limits())), input_.frame);
        make_folder_of(options_.output);
        if (!options_.transmittance.empty())
            make_folder_of(options_.transmittance);
        catch_interrupts();
        int next = 1;
        tbb::parallel_pipeline(
            3, tbb::make_filter<void, SamplePtr>(tbb::filter_mode::serial_in_order,
                                                 [&](tbb::flow_control &control) -> SamplePtr {
                                                     if (next > options_.count || interrupted()) {
                                                         control.stop();
                                                         return nullptr;
                                                     }
                                                     return fogged(next++, frame, stats);
                                                 }) &
                   tbb::make_filter<SamplePtr, SamplePtr>(tbb::filter_mode::parallel,
                                                          [&](SamplePtr sample) { return written(std::move(sample)); }) &
                   tbb::make_filter<SamplePtr, void>(tbb::filter_mode::serial_in_order, [&](SamplePtr sample) {
                       for (const std::string &warning : sample->stats.warnings)
                           note(warning);
                       ++done_;
                       fmt::print("{}\n", sample->line.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
                       std::fflush(stdout);
                   }));
        return done_ == options_.count ? kDone : kSomeFailed;
    }

private:
    /// Returns the values of this sample.
    ordered_json change_scene(int number)
    {
        ordered_json scene = scene_, values = ordered_json::object();
        for (const Variation &variation : variations_) {
            const double value = variation.value(options_.seed, std::uint64_t(number));
            variation.apply(scene, value);
            values[variation.path()] = value;
        }
        keep_airlight(scene, values);
        try {
            fogger_.change_scene(scene.dump());
        } catch (const RequestError &e) {
            throw RequestError(fmt::format("sample {}, {}: {}", number, values.dump(), e.what()));
        }
        return values;
    }

    /// Emission is per metre: fog of another visibility emits in proportion to what it scatters, so that the distance, which
    /// shows emission over extinction, keeps its radiance.
    void keep_airlight(ordered_json &scene, ordered_json &values) const
    {
        const ordered_json::json_pointer visibility("/medium/visibility"), emission("/medium/emission");
        if (!values.contains("medium.visibility") || values.contains("medium.emission") || !scene_.contains(visibility) ||
            !scene_.contains(emission) || !scene_[visibility].is_number())
            return;
        const double factor = scene_[visibility].get<double>() / scene[visibility].get<double>();
        if (scale_numbers(scene[emission], factor))
            values["medium.emission"] = scene[emission];
    }

    SamplePtr fogged(int number, const Frame &frame, const FrameStats &stats)
    {
        auto sample = std::make_shared<Sample>(Sample{number, {}, frame, {}, stats, {}});
        const FrameFile &files = outputs_[std::size_t(number - 1)];
        sample->stats.files.output = files.output;
        const ordered_json values = change_scene(number);
        oneapi::tbb::this_task_arena::isolate(
            [&] { sample->stats.fog = fogger_.fog(sample->frame, input_.frame, weights_, sample->layers); });
        sample->provenance = fogger_.provenance();
        sample->line = {{"output", files.output.string()}};
        if (!options_.transmittance.empty())
            sample->line[kTransmittance] = transmittance_.at(number).string();
        sample->line.update({{"input", options_.input}, {"sample", number}, {"seed", options_.seed}});
        sample->line.update(values);
        return sample;
    }

    SamplePtr written(SamplePtr sample) const
    {
        Frame &frame = sample->frame;
        if (!options_.transmittance.empty()) {
            write_layer(frame, sample->layers.front(), transmittance_.at(sample->number));
            sample->layers.clear();
        }
        io_.write(frame, {}, weights_, sample->provenance, sample->stats);
        return sample;
    }

    void note(const std::string &warning)
    {
        if (warned_.is_new(warning))
            fmt::print(stderr, "warning: {}: {}\n", printable(options_.input), printable(warning));
    }

    const SweepOptions &options_;
    const FrameFile input_;
    const std::vector<FrameFile> outputs_;
    const FilePattern transmittance_;
    const PictureIo io_;
    Fogger fogger_;
    std::vector<Variation> variations_;
    ordered_json scene_;
    LuminanceWeights weights_{};
    WarningKinds warned_;
    int done_ = 0;
};

/// Of the one picture, or RequestError.
FrameFile input_of(const SweepOptions &options)
{
    const FilePattern input(options.input);
    if (input.is_sequence())
        throw RequestError(fmt::format("{}: expected one picture, not a sequence", options.input));
    return list_frames(input, input, "").front();
}

std::vector<FrameFile> outputs_of(const SweepOptions &options, const FrameFile &input, const std::string &output)
{
    const FilePattern pattern(output);
    if (!pattern.is_sequence())
        throw RequestError(fmt::format("'{}': expected a name with the sample's number, such as fog.####.png", output));
    std::vector<FrameFile> outputs;
    for (int i = 1; i <= options.count; ++i)
        outputs.push_back({i, input.input, pattern.at(i)});
    return outputs;
}

}  // namespace

int run_sweep(const SweepOptions &options)
{
    const FrameFile input = input_of(options);
    std::vector<FrameFile> outputs = outputs_of(options, input, options.output);
    check_outputs(as_run(options, options.output), outputs);
    if (!options.transmittance.empty()) {
        std::vector<FrameFile> beside = outputs_of(options, input, options.transmittance);
        check_outputs(as_run(options, options.transmittance), beside);
        if (FilePattern(options.transmittance).at(1) == FilePattern(options.output).at(1))
            throw RequestError(fmt::format("--transmittance {}: is the output's name", options.transmittance));
    }
    return Sweep(options, input, std::move(outputs)).run();
}

}  // namespace brume::tool
