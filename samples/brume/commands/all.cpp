#include "commands/all.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include <CLI/CLI.hpp>
#include <brume/brume.h>
#include <fmt/format.h>

#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {

std::unique_ptr<CLI::App> make_command_line(Action &chosen)
{
    auto app =
        std::make_unique<CLI::App>("Fog for finished HDR pictures: frames with depth in, fogged frames out.", "brume");
    app->require_subcommand(1);
    app->set_version_flag("--version",
                          fmt::format("brume {}.{}.{}", BRUME_VERSION_MAJOR, BRUME_VERSION_MINOR, BRUME_VERSION_PATCH));
    app->footer(
        "Exit status: 0 all done; 1 some frames failed (each is listed); 2 the request was wrong (nothing was written).");
    for (const auto add : {add_run, add_plan, add_info, add_sweep, add_calibrate, add_compare, add_bench, add_effects,
                           add_schema, add_sheet, add_stats, add_media})
        add(*app, chosen);
    return app;
}

int run_command_line(int argc, char **argv)
{
    Action chosen;
    const auto app = make_command_line(chosen);
    try {
        app->parse(argc, argv);
        return chosen();
    } catch (const CLI::ParseError &e) {
        return app->exit(e) == 0 ? kDone : kWrongRequest;
    } catch (const RequestError &e) {
        fmt::print(stderr, "brume: {}\n", printable(e.what()));
        return kWrongRequest;
    } catch (const std::filesystem::filesystem_error &e) {
        fmt::print(stderr, "brume: {}: {}\n", printable(e.path1().string()), e.code().message());
        return kWrongRequest;
    } catch (const std::bad_alloc &) {
        fmt::print(stderr, "brume: out of memory\n");
        return kSomeFailed;
    } catch (const std::exception &e) {
        fmt::print(stderr, "brume: {}\n", printable(e.what()));
        return kSomeFailed;
    }
}

}  // namespace brume::tool
