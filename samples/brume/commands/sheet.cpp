#include <algorithm>
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "colour/png.hpp"
#include "commands/commands.hpp"
#include "image/frame.hpp"
#include "frames/pattern.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

struct SheetOptions {
    std::string before, after, output, frames;
    int columns = 4, cell_width = 480;
};

struct Thumbnail {
    int width = 0, height = 0;
    std::vector<float> rgb;
};

/// Averages every source pixel that a thumbnail's pixel covers, by the area covered: lamps of one pixel stay visible.
Thumbnail shrink(const Frame &frame, int width)
{
    Thumbnail small{std::min(width, frame.width), 0, {}};
    const double scale = double(frame.width) / small.width;
    small.height = std::max(1, int(std::lround(frame.height / scale)));
    const double scale_y = double(frame.height) / small.height;
    small.rgb.resize(3 * std::size_t(small.width) * std::size_t(small.height));
    for (int y = 0; y < small.height; ++y)
        for (int x = 0; x < small.width; ++x) {
            double sum[3] = {}, area = 0;
            const double x0 = x * scale, x1 = x0 + scale, y0 = y * scale_y, y1 = y0 + scale_y;
            for (int sy = int(y0); sy < std::min(frame.height, int(std::ceil(y1))); ++sy)
                for (int sx = int(x0); sx < std::min(frame.width, int(std::ceil(x1))); ++sx) {
                    const double weight = (std::min(x1, sx + 1.0) - std::max(x0, double(sx))) *
                                          (std::min(y1, sy + 1.0) - std::max(y0, double(sy)));
                    const float *p = &frame.pixels[std::size_t(frame.channels) *
                                                   (std::size_t(sy) * std::size_t(frame.width) + std::size_t(sx))];
                    if (weight <= 0 || !std::isfinite(p[0] + p[1] + p[2]))
                        continue;
                    for (int c = 0; c < 3; ++c)
                        sum[c] += weight * p[c];
                    area += weight;
                }
            for (int c = 0; c < 3; ++c)
                small.rgb[3 * (std::size_t(y) * std::size_t(small.width) + std::size_t(x)) + std::size_t(c)] =
                    area > 0 ? float(sum[c] / area) : 0.0f;
        }
    return small;
}

Thumbnail load(const std::filesystem::path &path, const ColorManager &colors, int width)
{
    ImageFile file(path);
    const ColorChoice color = resolve_color(file, {});
    Frame frame = read_frame(std::move(file), color, nullptr);
    colors.file_to_working(frame);
    return shrink(frame, width);
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
    constexpr int kGap = 8;
    constexpr std::uint8_t kGround = 24;
    const auto all = list_frames(FilePattern(options.before), FilePattern(options.after), options.frames);
    const auto chosen = evenly(all, std::size_t(options.columns));
    const ColorManager colors({"", "", true});

    std::vector<Thumbnail> cells;  // a column holds a frame: before above after
    for (const FrameFile &f : chosen) {
        cells.push_back(load(f.input, colors, options.cell_width));
        cells.push_back(load(f.output, colors, options.cell_width));
    }
    int cell_width = 0, cell_height = 0;
    for (const Thumbnail &t : cells) {
        cell_width = std::max(cell_width, t.width);
        cell_height = std::max(cell_height, t.height);
    }
    const int width = int(chosen.size()) * (cell_width + kGap) + kGap, height = 2 * (cell_height + kGap) + kGap;
    std::vector<std::uint8_t> rgb(3 * std::size_t(width) * std::size_t(height), kGround);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Thumbnail &t = cells[i];
        const auto shown = colors.to_display(t.rgb.data(), t.rgb.size() / 3, 3);
        const int left = kGap + int(i / 2) * (cell_width + kGap) + (cell_width - t.width) / 2;
        const int top = kGap + int(i % 2) * (cell_height + kGap) + (cell_height - t.height) / 2;
        for (int y = 0; y < t.height; ++y)
            std::copy_n(shown.data() + 3 * std::size_t(y) * std::size_t(t.width), 3 * t.width,
                        rgb.data() + 3 * (std::size_t(top + y) * std::size_t(width) + std::size_t(left)));
    }
    write_png(options.output, width, height, rgb);
    return kDone;
}

}  // namespace

void add_sheet(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("sheet", "Before/after contact sheet of a sequence: a PNG through the default view");
    auto options = std::make_shared<SheetOptions>();
    command->add_option("BEFORE", options->before, "EXR file or pattern: the upper row")->required();
    command->add_option("AFTER", options->after, "EXR file or pattern: the lower row")->required();
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
