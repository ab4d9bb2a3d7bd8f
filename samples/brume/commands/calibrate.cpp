#include <fstream>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/commands.hpp"
#include "run/calibration.hpp"
#include "run/options.hpp"
#include "support/sdk.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

int calibrate(const std::string &backend, const std::string &plugins, std::filesystem::path file)
{
    const Context context = create_context(backend, plugins);
    if (file.empty())
        file = calibration_file(context);
    if (file.empty())
        throw RequestError("neither XDG_CACHE_HOME nor HOME names a folder; expected --output FILE");
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    try {
        PendingFile pending(file);
        check_request(context, context.calibrate(), "calibrate");
        if (!(std::ofstream(pending.path(), std::ios::binary) << context.calibration()).flush())
            throw RequestError(fmt::format("{}: cannot be written", file.string()));
        pending.commit();
    } catch (const FrameError &e) {
        throw RequestError(e.what());
    }
    fmt::print("{}\n", file.string());
    return kDone;
}

}  // namespace

void add_calibrate(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("calibrate", "Measure what passes take on this device, for predictions and budgets");
    auto backend = std::make_shared<std::string>("auto"), plugins = std::make_shared<std::string>(),
         file = std::make_shared<std::string>();
    command->add_option("--backend", *backend, "auto (GL where a GPU is found), gl or cpu")
        ->capture_default_str()
        ->type_name("{auto,gl,cpu}");
    add_plugins_option(*command, *plugins);
    command->add_option("-o,--output", *file, "Where to keep it (default: the user's cache, where the other commands look)")
        ->type_name("FILE");
    command->callback([&chosen, backend, plugins, file] {
        chosen = [backend, plugins, file] { return calibrate(*backend, *plugins, *file); };
    });
}

}  // namespace brume::tool
