#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/media.hpp"
#include "media/document.hpp"
#include "media/fit.hpp"
#include "media/vdb.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct FitOptions {
    std::string input, output, grid;
    std::size_t count = 1000;
    double error = 0.02, unit = 1;
    bool json = false;
};

int fit(const FitOptions &options)
{
    const VdbDensity density = read_vdb(options.input, options.grid);
    const Fit fitted = fit_gaussians(density.grid, options.count, options.error);
    std::vector<brume_gaussian> gaussians;
    for (const FittedGaussian &from : fitted.gaussians) {
        brume_gaussian to = BRUME_GAUSSIAN_INIT;
        for (std::size_t i = 0; i < 3; ++i) {
            to.center[i] = density.origin[i];
            for (std::size_t axis = 0; axis < 3; ++axis)
                to.center[i] += from.center[axis] * density.axes[axis][i];
        }
        to.scale = from.scale / density.voxel;
        to.amplitude = from.amplitude / options.unit;
        gaussians.push_back(to);
    }
    Medium medium;
    medium.check(medium.media().put(gaussians));
    medium.save(options.output);

    if (options.json) {
        const nlohmann::ordered_json out{{"grid", density.name},         {"size", density.grid.size},
                                         {"averaged", density.averaged}, {"gaussians", gaussians.size()},
                                         {"residual", fitted.residual},  {"mass_error", fitted.mass_error}};
        fmt::print("{}\n", out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        return kDone;
    }
    const auto &size = density.grid.size;
    fmt::print("{}{}: {} x {} x {} voxels{}\n", density.name, density.level_set ? " (level set: 1 inside)" : "", size[0],
               size[1], size[2],
               density.averaged > 1 ? fmt::format(", each the mean of {}^3 of the file's", density.averaged) : "");
    fmt::print("{} Gaussians; relative L2 residual {:.4f}, mass error {:+.4f}\n", gaussians.size(), fitted.residual,
               fitted.mass_error);
    return kDone;
}

}  // namespace

void add_media_fit(CLI::App &media, Action &chosen)
{
    auto *command = media.add_subcommand("fit", "Fit a density grid of an OpenVDB file by Gaussians, and say how well");
    auto options = std::make_shared<FitOptions>();
    command->add_option("GRID", options->input, "OpenVDB file")->required()->type_name("FILE.vdb");
    command->add_option("-o,--output", options->output, "Media file to write")->required()->type_name("FILE");
    command->add_option("--grid", options->grid, "Grid of floats (default: density, or the only one)")->type_name("NAME");
    command->add_option("--count", options->count, "Most Gaussians")
        ->capture_default_str()
        ->check(CLI::Range(std::size_t(1), std::size_t(100000)));
    command->add_option("--error", options->error, "Relative L2 residual that is good enough")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1.0));
    command->add_option("--unit", options->unit, "The file's value that is unit density")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([&chosen, options] { chosen = [options] { return fit(*options); }; });
}

}  // namespace brume::tool
