#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/all.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

int main(int argc, char **argv)
{
    using namespace brume::tool;
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
