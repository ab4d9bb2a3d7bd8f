#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/media.hpp"
#include "media/document.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

// A command that selects, and then does something, is two steps of the history: one goes on while nothing is seen to change.
int step_back_or_forth(const std::string &file, brume_status (Media::*step)())
{
    Document document(file, Document::kFails);
    const auto before = document.media().gaussians();
    const auto steps_left = [&] {
        const brume_media_info info = document.media().info();
        return step == &Media::undo ? info.undo_count : info.redo_count;
    };
    do
        document.check((document.media().*step)());
    while (steps_left() > 0 && same_gaussians(document.media().gaussians(), before));
    document.save();
    const brume_media_info info = document.media().info();
    fmt::print("{} Gaussians; {} steps to undo, {} to redo\n", info.gaussian_count, info.undo_count, info.redo_count);
    return kDone;
}

void add_step(CLI::App &media, Action &chosen, const char *name, const char *help, brume_status (Media::*step)())
{
    auto *command = media.add_subcommand(name, help);
    auto file = std::make_shared<std::string>();
    command->add_option("FILE", *file, "Media file with its journal beside it")->required();
    command->callback([&chosen, file, step] { chosen = [file, step] { return step_back_or_forth(*file, step); }; });
}

int replay(const std::string &journal, const std::string &output)
{
    Medium medium;
    medium.replay(journal);
    medium.save(output);
    return kDone;
}

}  // namespace

void add_media_history(CLI::App &media, Action &chosen)
{
    add_step(media, chosen, "undo", "Take the last step of FILE.journal back", &Media::undo);
    add_step(media, chosen, "redo", "Do again what was last undone", &Media::redo);

    auto *command = media.add_subcommand("replay", "Make a media file from a journal, bit for bit the one it was kept for");
    auto journal = std::make_shared<std::string>(), output = std::make_shared<std::string>();
    command->add_option("JOURNAL", *journal, "FILE.journal")->required();
    command->add_option("-o,--output", *output, "Media file to write")->required()->type_name("FILE");
    command->callback([&chosen, journal, output] { chosen = [journal, output] { return replay(*journal, *output); }; });
}

}  // namespace brume::tool
