// brume_pages DIRECTORY DATE: the manual and bash's completion, of the command's own tables, into DIRECTORY.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/all.hpp"
#include "pages/manual.hpp"
#include "support/sdk.hpp"

namespace {

void write(const std::filesystem::path &path, const std::string &text)
{
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush())
        throw std::runtime_error(path.string() + ": cannot be written");
}

std::string scene_schema()
{
    return brume::tool::create_context("cpu").scene_schema();
}

}  // namespace

int main(int argc, char **argv)
{
    using namespace brume::pages;
    if (argc != 3) {
        fmt::print(stderr, "brume_pages DIRECTORY DATE\n");
        return 2;
    }
    const std::filesystem::path directory = argv[1];
    try {
        brume::tool::Action chosen;
        const auto app = brume::tool::make_command_line(chosen);
        for (const Command &command : commands_of(*app))
            write(directory / "man" / "man1" / (page_name(command) + ".1"), command_page(command, argv[2]));
        write(directory / "man" / "man5" / "brume-scene.5", scene_page(scene_schema(), argv[2]));
        write(directory / "bash-completion" / "completions" / "brume", bash_completion(*app));
    } catch (const std::exception &e) {
        fmt::print(stderr, "brume_pages: {}\n", e.what());
        return 1;
    }
    return 0;
}
