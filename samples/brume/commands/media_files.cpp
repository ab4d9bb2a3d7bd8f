#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/media.hpp"
#include "media/document.hpp"
#include "support/error.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();

    void include(double value)
    {
        least = std::min(least, value);
        most = std::max(most, value);
    }
    ordered_json json() const { return {least, most}; }
};

int info(const std::string &file, bool as_json)
{
    Medium medium;
    medium.check(medium.media().load(file));
    const auto gaussians = medium.media().gaussians();
    ordered_json out{{"file", file}, {"gaussians", gaussians.size()}};
    if (!gaussians.empty()) {
        Extent axes[3], radius, amplitude;
        double mass = 0;
        for (const brume_gaussian &g : gaussians) {
            for (int i = 0; i < 3; ++i)
                axes[i].include(g.center[i]);
            radius.include(1 / g.scale);
            amplitude.include(g.amplitude);
            mass += g.amplitude * std::pow(std::numbers::pi, 1.5) / (g.scale * g.scale * g.scale);
        }
        out["centers"] = {axes[0].json(), axes[1].json(), axes[2].json()};
        out["radius"] = radius.json();
        out["amplitude"] = amplitude.json();
        out["mass"] = mass;
    }
    if (std::filesystem::exists(Document::journal_of(file))) {
        Document document(file, Document::kFails);
        const brume_media_info history = document.media().info();
        out["undo"] = history.undo_count;
        out["redo"] = history.redo_count;
    }
    if (as_json) {
        fmt::print("{}\n", out.dump(2, ' ', false, ordered_json::error_handler_t::replace));
        return kDone;
    }
    fmt::print("{}: {} Gaussians\n", file, gaussians.size());
    const auto line = [](const char *what, const ordered_json &extent) {
        fmt::print("  {:<10} {:.6g} to {:.6g}\n", what, extent[0].get<double>(), extent[1].get<double>());
    };
    if (!gaussians.empty()) {
        const char *const names[] = {"x", "y", "z"};
        for (std::size_t i = 0; i < 3; ++i)
            line(names[i], out["centers"][i]);
        line("radius", out["radius"]);
        line("amplitude", out["amplitude"]);
        fmt::print("  {:<10} {:.6g}\n", "mass", out["mass"].get<double>());
    }
    if (out.contains("undo"))
        fmt::print("  {:<10} {} steps to undo, {} to redo\n", "journal", out["undo"].get<unsigned>(),
                   out["redo"].get<unsigned>());
    return kDone;
}

int convert(const std::string &input, const std::string &output)
{
    Medium medium;
    medium.check(medium.media().load(input));
    medium.save(output);
    return kDone;
}

int join(const std::string &file, const std::string &other)
{
    Document document(file, Document::kIsEmpty);
    document.check(document.media().load(other));
    document.save();
    return kDone;
}

}  // namespace

void add_media_files(CLI::App &media, Action &chosen)
{
    auto *command = media.add_subcommand("info", "Say what a media file holds");
    auto file = std::make_shared<std::string>();
    auto json = std::make_shared<bool>(false);
    command->add_option("FILE", *file, "Media file")->required();
    command->add_flag("--json", *json, "Print JSON");
    command->callback([&chosen, file, json] { chosen = [file, json] { return info(*file, *json); }; });

    command = media.add_subcommand("convert", "Write a media file in the other format");
    auto input = std::make_shared<std::string>(), output = std::make_shared<std::string>();
    command->add_option("INPUT", *input, "CSV or PLY file")->required();
    command->add_option("OUTPUT", *output, "CSV or PLY file to write")->required();
    command->callback([&chosen, input, output] { chosen = [input, output] { return convert(*input, *output); }; });

    command = media.add_subcommand("add", "Add the Gaussians of another file, such as a particle cache");
    auto to = std::make_shared<std::string>(), from = std::make_shared<std::string>();
    command->add_option("FILE", *to, "Media file to add to; made where it is missing")->required();
    command->add_option("OTHER", *from, "CSV or PLY file")->required();
    command->callback([&chosen, to, from] { chosen = [to, from] { return join(*to, *from); }; });
}

}  // namespace brume::tool
