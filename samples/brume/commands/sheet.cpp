#include <algorithm>
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "commands/commands.hpp"
#include "image/write.hpp"
#include "frames/pattern.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct SheetOptions {
    std::string before, after, output, frames;
    int columns = 4, cell_width = 480;
};

Display load(const std::filesystem::path &path, const ColorManager &colors, int most)
{
    ImageFile file(path);
    const ColorChoice color = resolve_color(file, {});
    Frame frame = read_frame(std::move(file), color, nullptr);
    colors.file_to_working(frame);
    const int width = std::min(most, frame.width);
    const int height = std::max(1, int(std::lround(double(frame.height) * width / frame.width)));
    const auto rgb = image_library().shrunk(frame.pixels.data(), frame.channels, frame.width, frame.height, width, height);
    return {width, height, colors.to_display(rgb.data(), rgb.size() / 3, 3)};
}

std::vector<FrameFile> evenly(const std::vector<FrameFile> &all, std::size_t count)
{
    if (all.size() <= count)
        return all;
    std::vector<FrameFile> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(all[count == 1 ? all.size() / 2 : i * (all.size() - 1) / (count - 1)]);
    return chosen;
}

int sheet(const SheetOptions &options)
{
    const FilePattern before(options.before);
    const auto chosen =
        evenly(list_frames(before, FilePattern(options.after), options.frames), std::size_t(options.columns));
    const ColorManager colors({"", "", true});
    std::vector<Display> cells;
    std::vector<std::string> labels;
    for (const FrameFile &f : chosen) {
        cells.push_back(load(f.input, colors, options.cell_width));
        cells.push_back(load(f.output, colors, options.cell_width));
        if (before.is_sequence())
            labels.push_back(fmt::format("{}", f.frame));
    }
    write_display(image_library().sheet(cells, labels), options.output);
    return kDone;
}

}  // namespace

void add_sheet(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand(
        "sheet", "Before/after contact sheet of a sequence, with frame numbers: a PNG through the default view");
    auto options = std::make_shared<SheetOptions>();
    command->add_option("BEFORE", options->before, "Picture or pattern: the upper row")->required();
    command->add_option("AFTER", options->after, "Picture or pattern: the lower row")->required();
    command->add_option("-o,--output", options->output, "The sheet")->required()->type_name("FILE.png");
    command->add_option("--frames", options->frames, "Frames to choose from (default: all that exist)")->type_name("RANGE");
    command->add_option("--columns", options->columns, "Frames shown, picked evenly")
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    command->add_option("--cell-width", options->cell_width, "Largest width of one picture, in pixels")
        ->capture_default_str()
        ->check(CLI::Range(16, 8192));
    command->callback([&chosen, options] { chosen = [options] { return sheet(*options); }; });
}

}  // namespace brume::tool
