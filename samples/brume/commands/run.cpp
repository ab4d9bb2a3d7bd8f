#include <memory>

#include <CLI/CLI.hpp>

#include "commands/commands.hpp"
#include "run/sequence.hpp"

namespace brume::tool {

void add_run(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("run", "Put fog into a picture or a sequence");
    auto options = std::make_shared<SequenceOptions>();
    options->fog.add_to(*command);
    command
        ->add_option("INPUT", options->input,
                     "EXR, TIFF, PNG, JPEG, DPX, HDR, PFM or NPY file, or a pattern such as shot.%04d.exr or shot.####.exr")
        ->required();
    command->add_option("-o,--output", options->output, "Output file or pattern; folders are made")
        ->required()
        ->type_name("OUTPUT");
    command->add_option("--frames", options->frames, "Frames such as 1-100x2,200 (default: all that exist)")
        ->type_name("RANGE");
    add_output_options(*command, options->spaces, options->output_type);
    command
        ->add_option("--preview", options->preview,
                     "PNG through the default view; of the first frame unless it has a frame number too")
        ->type_name("FILE");
    command->add_option("--jobs", options->jobs, "Most frames in flight (default: by the number of threads)")
        ->check(CLI::Range(1, 1024));
    command
        ->add_option("--mem", options->memory,
                     "Memory for frames in flight, and the limit for one picture (default: half of the machine's)")
        ->check(CLI::Range(std::uint64_t(1), std::uint64_t(1) << 30))
        ->type_name("MIB");
    command->add_flag("--skip-existing", options->skip_existing, "Skip frames whose output exists");
    command->add_flag("--keep-going", options->keep_going, "Go on after a frame has failed");
    command->add_option("--stats", options->stats, "Write what was done, counted and timed as JSON")->type_name("FILE");
    command->add_flag("!--no-provenance", options->provenance,
                      "Leave out the attribute brume:provenance, which names version, backend and scene");
    command->add_flag("--quiet", options->quiet, "Say nothing but warnings and errors");
    command->callback([&chosen, options] {
        options->fog.picture.name_view({&options->input, &options->output, &options->preview, &options->stats});
        options->spaces.display = !options->preview.empty();
        chosen = [options] { return run_sequence(*options); };
    });
}

}  // namespace brume::tool
