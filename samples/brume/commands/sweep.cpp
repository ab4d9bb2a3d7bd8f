#include "run/sweep.hpp"

#include <memory>

#include <CLI/CLI.hpp>

#include "commands/commands.hpp"

namespace brume::tool {

void add_sweep(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("sweep", "Put fogs that are drawn by seed into one picture, for data sets");
    auto options = std::make_shared<SweepOptions>();
    options->fog.add_scene_to(*command);
    add_input_option(*command, options->fog.inputs);
    command->add_option("PICTURE", options->input, "EXR, TIFF, PNG, JPEG, DPX, HDR, PFM or NPY file")->required();
    command->add_option("-o,--output", options->output, "Output pattern such as fog.####.png; folders are made")
        ->required()
        ->type_name("OUTPUT");
    command->add_option("--count", options->count, "Samples")->required()->check(CLI::Range(1, 1000000));
    command
        ->add_option("--vary", options->vary,
                     "Draw a number of the scene file from a range, such as medium.visibility=50:500:log; "
                     "lights.intensity=x0.5:2 is a factor; may be repeated")
        ->required()
        ->type_name("PATH=LOW:HIGH")
        ->allow_extra_args(false);
    command->add_option("--seed", options->seed, "Same seed, same samples")->capture_default_str();
    command
        ->add_option(
            "--transmittance", options->transmittance,
            "Also write what of the light arrives straight, 0 to 1: a pattern such as t.####.png (16 bits), .exr or "
            ".npy")
        ->type_name("OUTPUT");
    add_output_options(*command, options->spaces, options->output_type);
    command->callback([&chosen, options] {
        options->fog.picture.name_view({&options->input, &options->output, &options->transmittance});
        chosen = [options] { return run_sweep(*options); };
    });
}

}  // namespace brume::tool
