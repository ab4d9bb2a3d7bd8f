#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/media.hpp"
#include "media/arguments.hpp"
#include "media/document.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

/// Files hold no selection, so each command says what it is about.
struct SelectionOptions {
    std::string file, rectangle, by, output;
    bool all = false;
    ViewOptions view;

    void add_to(CLI::App &command)
    {
        command.add_option("FILE", file, "Media file")->required();
        auto *rect = command
                         .add_option("--rect", rectangle,
                                     "Gaussians whose centres project inside, in pixels from the picture's top left corner")
                         ->type_name("LEFT,TOP,RIGHT,BOTTOM");
        command.add_flag("--all", all, "All Gaussians")->excludes(rect);
        view.add_to(command, false);
    }

    void select(Document &document) const
    {
        if (all == !rectangle.empty())
            throw RequestError("expected --rect or --all, to say which Gaussians");
        if (all) {
            document.check(document.media().select_all());
            return;
        }
        const auto numbers = parse_numbers(rectangle, 4, "--rect");
        if (!view.given())
            throw RequestError("--rect: expected --frame, or --camera with --size, to say whose screen");
        auto loaded = view.load();
        document.check(document.media().select_rectangle(*loaded.get(), {numbers[0], numbers[1], numbers[2], numbers[3]}));
    }
};

void report(Document &document, const char *what)
{
    const brume_media_info info = document.media().info();
    fmt::print("{} {} of {} Gaussians\n", what, info.selected_count, info.gaussian_count);
}

int select(const SelectionOptions &options)
{
    Document document(options.file, Document::kFails);
    options.select(document);
    report(document, "selected");
    if (options.output.empty())
        return kDone;
    const auto all = document.media().gaussians();
    const auto selected = document.media().selection();
    std::vector<brume_gaussian> chosen;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (selected[i])
            chosen.push_back(all[i]);
    Document to(options.output, Document::kIsEmpty);
    to.check(to.media().put(chosen));
    to.save();
    return kDone;
}

int move(const SelectionOptions &options)
{
    Document document(options.file, Document::kFails);
    options.select(document);
    const auto by = parse_numbers(options.by, 3, "--by");
    document.check(document.media().move({by[0], by[1], by[2]}));
    document.save();
    report(document, "moved");
    return kDone;
}

int copy(const SelectionOptions &options)
{
    Document document(options.file, Document::kFails);
    options.select(document);
    const auto by = parse_numbers(options.by, 3, "--by");
    document.check(document.media().copy());
    document.check(document.media().paste({by[0], by[1], by[2]}));
    document.save();
    report(document, "pasted");
    return kDone;
}

int remove(const SelectionOptions &options)
{
    Document document(options.file, Document::kFails);
    options.select(document);
    report(document, "deleted");
    document.check(document.media().remove());
    document.save();
    return kDone;
}

CLI::App *add(CLI::App &media, Action &chosen, const char *name, const char *help, int (*action)(const SelectionOptions &),
              const std::shared_ptr<SelectionOptions> &options)
{
    auto *command = media.add_subcommand(name, help);
    options->add_to(*command);
    command->callback([&chosen, action, options] { chosen = [action, options] { return action(*options); }; });
    return command;
}

}  // namespace

void add_media_selection(CLI::App &media, Action &chosen)
{
    auto options = std::make_shared<SelectionOptions>();
    add(media, chosen, "select", "Say how many Gaussians a rectangle holds, and add them to another file", select, options)
        ->add_option("-o,--output", options->output, "Media file to add them to; made where it is missing")
        ->type_name("FILE");
    options = std::make_shared<SelectionOptions>();
    add(media, chosen, "move", "Move Gaussians", move, options)
        ->add_option("--by", options->by, "How far, in scene units")
        ->required()
        ->type_name("X,Y,Z");
    options = std::make_shared<SelectionOptions>();
    add(media, chosen, "copy", "Copy Gaussians and paste them elsewhere", copy, options)
        ->add_option("--by", options->by, "How far away, in scene units")
        ->required()
        ->type_name("X,Y,Z");
    add(media, chosen, "delete", "Remove Gaussians", remove, std::make_shared<SelectionOptions>());
}

}  // namespace brume::tool
