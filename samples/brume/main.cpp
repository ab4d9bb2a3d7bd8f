#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include <CLI/CLI.hpp>
#include <brume/brume.h>
#include <fmt/format.h>

#include "commands/commands.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

int main(int argc, char **argv)
{
    using namespace brume::tool;
    CLI::App app{"Fog for finished HDR pictures: frames with depth in, fogged frames out.", "brume"};
    app.require_subcommand(1);
    app.set_version_flag("--version",
                         fmt::format("brume {}.{}.{}", BRUME_VERSION_MAJOR, BRUME_VERSION_MINOR, BRUME_VERSION_PATCH));
    app.footer(
        "Exit status: 0 all done; 1 some frames failed (each is listed); 2 the request was wrong (nothing was written).");

    Action chosen;
    add_run(app, chosen);
    add_plan(app, chosen);
    add_info(app, chosen);
    add_sweep(app, chosen);
    add_calibrate(app, chosen);
    add_compare(app, chosen);
    add_bench(app, chosen);
    add_effects(app, chosen);
    add_schema(app, chosen);
    add_sheet(app, chosen);
    add_stats(app, chosen);
    add_media(app, chosen);
    try {
        app.parse(argc, argv);
        return chosen();
    } catch (const CLI::ParseError &e) {
        return app.exit(e) == 0 ? kDone : kWrongRequest;
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
