#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/media.hpp"
#include "frames/pattern.hpp"
#include "frames/range.hpp"
#include "media/arguments.hpp"
#include "media/document.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct EmitOptions {
    std::string file, position, velocity, acceleration, color, scale, amplitude, frames;
    double time = 0, fps = 24;
    brume_media_emitter emitter = BRUME_MEDIA_EMITTER_INIT;
};

void take_pair(const std::string &text, const std::string &option, double (&values)[2])
{
    if (text.empty())
        return;
    const auto parsed = parse_numbers(text, text.find(',') == std::string::npos ? 1 : 2, option);
    values[0] = parsed.front();
    values[1] = parsed.back();
}

int emit(const EmitOptions &options)
{
    brume_media_emitter emitter = options.emitter;
    take_triple(options.position, "--position", emitter.position);
    take_triple(options.velocity, "--velocity", emitter.velocity);
    take_triple(options.acceleration, "--acceleration", emitter.acceleration);
    take_triple(options.color, "--colour", emitter.color);
    take_pair(options.scale, "--scale", emitter.scale);
    take_pair(options.amplitude, "--amplitude", emitter.amplitude);
    const FilePattern pattern(options.file);
    if (pattern.is_sequence() != !options.frames.empty())
        throw RequestError(
            fmt::format("{}: expected --frames with a pattern such as puffs.####.csv, and only then", options.file));
    if (!pattern.is_sequence()) {
        Document document(options.file, Document::kIsEmpty);
        document.check(document.media().apply(emitter, options.time));
        document.save();
        return kDone;
    }
    const std::vector<int> frames = parse_frames(options.frames);
    for (const int frame : frames) {
        Medium medium;
        const double time = options.time + (frame - frames.front()) / options.fps;
        medium.check(medium.media().apply(emitter, time));
        medium.save(pattern.at(frame));
    }
    return kDone;
}

struct AirbrushOptions {
    std::string file, position, velocity;
    ViewOptions view;
    BrushOptions brush;
    brume_media_airbrush airbrush = BRUME_MEDIA_AIRBRUSH_INIT;
};

int airbrush(const AirbrushOptions &options)
{
    brume_media_airbrush airbrush = options.airbrush;
    airbrush.seed = options.brush.seed;
    options.brush.take(airbrush.scale, airbrush.amplitude, airbrush.color);
    take_triple(options.position, "--position", airbrush.position);
    take_triple(options.velocity, "--velocity", airbrush.velocity);
    std::optional<ViewOptions::Loaded> view;
    if (options.view.given()) {
        view = options.view.load();
        airbrush.view = view->get();
    }
    Document document(options.file, Document::kIsEmpty);
    document.check(document.media().apply(airbrush));
    document.save();
    return kDone;
}

}  // namespace

void add_media_particles(CLI::App &media, Action &chosen)
{
    auto *command = media.add_subcommand("emit", "What an emitter of particles has in the air at some time");
    auto emitting = std::make_shared<EmitOptions>();
    brume_media_emitter &emitter = emitting->emitter;
    command->add_option("FILE", emitting->file, "Media file to add to, made where it is missing; or a pattern, for --frames")
        ->required();
    command->add_option("--time", emitting->time, "Seconds since the emitter was turned on; at the first of --frames")
        ->required();
    command->add_option("--frames", emitting->frames, "A file for each of these frames, without journal")
        ->type_name("RANGE");
    command->add_option("--fps", emitting->fps, "Frames per second")->capture_default_str()->check(CLI::PositiveNumber);
    command->add_option("--position", emitting->position, "Where particles are born (default: 0,0,0)")->type_name("X,Y,Z");
    command->add_option("--radius", emitter.radius, "Of the ball around it in which they are")->capture_default_str();
    command->add_option("--velocity", emitting->velocity, "Their first, in scene units per second (default: 0,0,1)")
        ->type_name("X,Y,Z");
    command->add_option("--spread", emitter.spread, "Radius of the ball around it in which velocities lie")
        ->capture_default_str();
    command->add_option("--acceleration", emitting->acceleration, "In scene units per second squared (default: 0,0,0)")
        ->type_name("X,Y,Z");
    command->add_option("--rate", emitter.rate, "Particles per second")->capture_default_str();
    command->add_option("--duration", emitter.duration, "Seconds after which no more are born")->capture_default_str();
    command->add_option("--lifetime", emitter.lifetime, "Of a particle, in seconds")->capture_default_str();
    command->add_option("--scale", emitting->scale, "1 / radius, at birth and at the end of life (default: 1,1)")
        ->type_name("A,A");
    command->add_option("--amplitude", emitting->amplitude, "Density at the centre, at birth and at the end (default: 1,0)")
        ->type_name("C,C");
    command->add_option("--colour", emitting->color, "Share of the light met that is scattered (default: 1,1,1)")
        ->type_name("R,G,B");
    command->add_option("--seed", emitter.seed, "Of all chance")->capture_default_str();
    command->callback([&chosen, emitting] { chosen = [emitting] { return emit(*emitting); }; });

    command = media.add_subcommand("airbrush", "Particles that wander, bounce off what a frame shows, and stay");
    auto brushing = std::make_shared<AirbrushOptions>();
    brume_media_airbrush &brush = brushing->airbrush;
    command->add_option("FILE", brushing->file, "Media file to add to; made where it is missing")->required();
    command->add_option("--position", brushing->position, "Where particles come from (default: 0,0,0)")->type_name("X,Y,Z");
    command->add_option("--velocity", brushing->velocity, "Their first, in scene units per second (default: 0,0,0)")
        ->type_name("X,Y,Z");
    command->add_option("--spread", brush.spread, "Radius of the ball around it in which velocities lie")
        ->capture_default_str();
    command->add_option("--drag", brush.drag, "Share of its velocity that a particle loses per second")
        ->capture_default_str();
    command
        ->add_option("--diffusion", brush.diffusion,
                     "D: they wander sqrt(2 D t) along each axis, in units squared per second")
        ->capture_default_str();
    command->add_option("--rate", brush.rate, "Particles per second")->capture_default_str();
    command->add_option("--duration", brush.duration, "Seconds until the brush is stopped and all freezes")
        ->capture_default_str();
    brushing->brush.add_to(*command);
    brushing->view.add_to(*command, true);
    command->callback([&chosen, brushing] { chosen = [brushing] { return airbrush(*brushing); }; });
}

}  // namespace brume::tool
