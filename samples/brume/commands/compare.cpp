#include <cmath>
#include <cstdio>
#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "colour/color_manager.hpp"
#include "colour/png.hpp"
#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "exr/frame.hpp"
#include "exr/output_stream.hpp"
#include "metrics/metrics.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

struct CompareOptions {
    std::string a, reference, difference;
    LayerRequest layers;
    bool json = false;
};

struct Loaded {
    Picture picture;
    LuminanceWeights weights;
};

Loaded load(const std::string &path, const LayerRequest &request, const ColorManager &colors)
{
    ExrFile file(path);
    const ColorChoice color = resolve_color(file, request);
    const LuminanceWeights weights = colors.luminance_weights(file.header(color.part));
    Frame frame = read_frame(std::move(file), color, nullptr);
    const Imath::Box2i &window = frame.part().data_window;
    Picture picture{window.min.x, window.min.y, frame.width, frame.height, {}};
    if (frame.channels == 3) {
        picture.rgb = std::move(frame.pixels);
    } else {
        for (std::size_t i = 0; i < frame.pixels.size(); i += 4)
            picture.rgb.insert(picture.rgb.end(), frame.pixels.begin() + std::ptrdiff_t(i),
                               frame.pixels.begin() + std::ptrdiff_t(i) + 3);
    }
    return {std::move(picture), weights};
}

std::vector<float> absolute_difference(const Picture &a, const Picture &b)
{
    std::vector<float> difference(a.rgb.size());
    std::transform(a.rgb.begin(), a.rgb.end(), b.rgb.begin(), difference.begin(),
                   [](float x, float y) { return std::abs(x - y); });
    return difference;
}

void write_exr(const std::string &path, const Picture &where, const std::vector<float> &rgb)
{
    const Imath::Box2i window({where.x, where.y}, {where.x + where.width - 1, where.y + where.height - 1});
    Imf::Header header(window, window);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string name(1, "RGB"[c]);
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, rgb.data() + c, window, 3 * sizeof(float)));
    }
    PendingFile pending(path);
    OutputStream stream(pending.path().string(), path);
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(where.height);
    }
    stream.close();
    pending.commit();
}

/// The difference as radiance in an EXR; in a PNG scaled so that the largest shows as white.
void write_difference(const std::string &path, const Picture &a, const Picture &b, double largest)
{
    const auto difference = absolute_difference(a, b);
    if (path.ends_with(".exr"))
        return write_exr(path, a, difference);
    if (!path.ends_with(".png"))
        throw RequestError(fmt::format("--difference '{}': expected a name ending in .png or .exr", path));
    std::vector<std::uint8_t> rgb(difference.size());
    std::transform(difference.begin(), difference.end(), rgb.begin(), [&](float d) {
        if (!std::isfinite(d))
            return std::uint8_t(255);
        return std::uint8_t(std::lround(255 * std::sqrt(largest > 0 ? std::min(1.0, d / largest) : 0.0)));
    });
    write_png(path, a.width, a.height, rgb);
}

int compare(const CompareOptions &options)
{
    const ColorManager colors;
    auto [a, a_weights] = load(options.a, options.layers, colors);
    auto [reference, weights] = load(options.reference, options.layers, colors);
    const bool same_window =
        a.x == reference.x && a.y == reference.y && a.width == reference.width && a.height == reference.height;
    if (!same_window) {
        const std::string windows = fmt::format("{} x {} at ({}, {}) and {} x {} at ({}, {})", a.width, a.height, a.x, a.y,
                                                reference.width, reference.height, reference.x, reference.y);
        crop_to_common(a, reference);
        if (a.rgb.empty())
            throw RequestError(fmt::format("{} and {}: the data windows have no pixel in common: {}", options.a,
                                           options.reference, windows));
        fmt::print(stderr, "brume: data windows differ ({}): comparing the {} x {} pixels in common\n", windows, a.width,
                   a.height);
    }
    const Metrics m = measure(a, reference, weights);
    if (!options.difference.empty())
        write_difference(options.difference, a, reference, m.max_difference);

    const std::string channel(1, "RGB"[m.max_channel]);
    if (options.json) {
        const auto number = [](double v) {
            return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
        };
        nlohmann::ordered_json out{
            {"a", options.a},
            {"reference", options.reference},
            {"pixels", m.pixels},
            {"same_window", same_window},
            {"rel_mse", number(m.relative_mse)},
            {"log2_rms", number(m.log2_rms)},
            {"energy_ratio", number(m.energy)},
            {"max_difference",
             {{"value", m.max_difference},
              {"x", m.max_x},
              {"y", m.max_y},
              {"channel", channel},
              {"a", m.max_a},
              {"reference", m.max_reference}}},
            {"different_pixels", m.different},
            {"not_finite",
             {{"a", m.not_finite_a}, {"reference", m.not_finite_reference}, {"mismatched", m.not_finite_mismatch}}}};
        fmt::print("{}\n", out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        return kDone;
    }
    fmt::print("relMSE          {:.6g}\nlog2 RMS        {:.6g}\nenergy ratio    {:.6g}\n", m.relative_mse, m.log2_rms,
               m.energy);
    fmt::print("max difference  {:.6g} at ({}, {}) in {}: {:.6g}, reference {:.6g}\n", m.max_difference, m.max_x, m.max_y,
               channel, m.max_a, m.max_reference);
    fmt::print("different       {} of {} pixels\n", m.different, m.pixels);
    if (m.not_finite_a || m.not_finite_reference)
        fmt::print("not finite      {} pixels, reference {}; {} components of another kind\n", m.not_finite_a,
                   m.not_finite_reference, m.not_finite_mismatch);
    return kDone;
}

}  // namespace

void add_compare(CLI::App &app, Action &chosen)
{
    auto *command =
        app.add_subcommand("compare", "relMSE, log2 RMS, max difference and energy ratio of A against the reference B");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("A", options->a, "EXR file")->required();
    command->add_option("B", options->reference, "EXR file: the reference")->required();
    command->add_option("--difference,-d", options->difference, "Write |A - B| to this .exr, or scaled to this .png")
        ->type_name("FILE");
    command->add_flag("--json", options->json, "Print JSON");
    command->add_option("--color", options->layers.color, "Layer to compare (default: as for run)")->type_name("LAYER");
    command->add_option("--part", options->layers.part, "Part of a multi-part file, by name or index")->type_name("NAME");
    command->add_option("--view", options->layers.view, "View of a stereo file")->type_name("NAME");
    command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace brume::tool
