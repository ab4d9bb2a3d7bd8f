#include <algorithm>
#include <atomic>
#include <cmath>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "colour/color_manager.hpp"
#include "commands/commands.hpp"
#include "compare/comparison.hpp"
#include "compare/difference.hpp"
#include "compare/html.hpp"
#include "compare/junit.hpp"
#include "compare/report.hpp"
#include "compare/update.hpp"
#include "frames/pattern.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    CompareRequest request;
    std::string a, reference, frames, difference, energy, junit, html;
    int jobs = 0;
    bool json = false, update = false;
};

bool parse_number(const char *from, const char *to, double &value)
{
    const auto [end, error] = std::from_chars(from, to, value);
    return error == std::errc() && end == to && std::isfinite(value);
}

std::optional<std::array<double, 2>> energy_limits(const std::string &text)
{
    if (text.empty())
        return std::nullopt;
    std::array<double, 2> limits{};
    const auto colon = text.find(':');
    const char *at = text.data();
    if (colon == std::string::npos || !parse_number(at, at + colon, limits[0]) ||
        !parse_number(at + colon + 1, at + text.size(), limits[1]) || limits[0] > limits[1])
        throw RequestError(fmt::format("--energy '{}': expected LOW:HIGH, numbers with LOW <= HIGH", text));
    return limits;
}

/// Reports may not take the place of what is compared.
void check_output(const std::string &option, const std::string &path, const std::vector<PairFiles> &pairs)
{
    std::error_code none;
    for (const PairFiles &files : pairs)
        for (const std::string &input : {files.a, files.b})
            if (fs::equivalent(path, input, none))
                throw RequestError(fmt::format("{} {}: would overwrite {} (expected another place)", option, path, input));
}

void check(const CompareOptions &options, const std::vector<PairFiles> &pairs)
{
    if (!options.request.mask.empty() && !fs::exists(options.request.mask))
        throw RequestError(fmt::format("--mask {}: no such file", options.request.mask));
    if (!options.junit.empty())
        check_output("--junit", options.junit, pairs);
    if (options.difference.empty())
        return;
    check_difference_name(options.difference);
    const FilePattern pattern(options.difference);
    if (pairs.size() > 1 && (!pattern.is_sequence() || fs::is_directory(options.a)))
        throw RequestError(
            fmt::format("--difference '{}': one file for {} pairs (expected a frame number such as #### in its "
                        "name, and patterns to compare)",
                        options.difference, pairs.size()));
    for (const PairFiles &files : pairs)
        check_output("--difference", pattern.at(files.frame).string(), pairs);
}

Comparison do_pair(const PairFiles &files, const CompareOptions &options, const CompareRequest &request,
                   const ColorManager &colors)
{
    const auto use = [&](const Picture &a, const Picture &reference, Comparison &comparison) {
        if (!options.difference.empty())
            write_difference(FilePattern(options.difference).at(files.frame).string(), a, reference,
                             comparison.metrics.max_difference);
        if (!options.html.empty())
            write_pair_page(fs::path(options.html) / page_of(files), a, reference, comparison);
    };
    Comparison comparison = compare_pair(files, request, colors, use);
    try {
        if (options.update)
            update_reference(comparison);
    } catch (const std::exception &e) {
        comparison.error = e.what();
    }
    return comparison;
}

int compare(const CompareOptions &options)
{
    CompareRequest request = options.request;
    request.limits.energy = energy_limits(options.energy);
    request.flip |= !options.html.empty();
    const auto pairs = list_pairs(options.a, options.reference, options.frames, options.update);
    check(options, pairs);
    check_layers(pairs, request);
    const ColorManager colors;
    std::error_code error;
    if (!options.html.empty() && !fs::create_directories(options.html, error) && error)
        throw RequestError(fmt::format("--html {}: the folder cannot be made: {}", options.html, error.message()));

    std::vector<Comparison> comparisons(pairs.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i; (i = next++) < pairs.size();)
            comparisons[i] = do_pair(pairs[i], options, request, colors);
    };
    {
        const std::size_t jobs =
            options.jobs > 0 ? std::size_t(options.jobs) : std::max(1u, std::thread::hardware_concurrency());
        std::vector<std::jthread> threads;
        for (std::size_t i = 1; i < std::min(jobs, pairs.size()); ++i)
            threads.emplace_back(work);
        work();
    }

    if (!options.junit.empty())
        write_junit(options.junit, comparisons);
    if (!options.html.empty())
        write_index_page(options.html, comparisons);
    const bool one_pair = pairs.size() == 1 && pairs.front().a == options.a;
    const std::string text = options.json ? json_of(comparisons, one_pair)
                             : one_pair   ? text_of(comparisons.front())
                                          : text_of(comparisons);
    std::fputs(text.c_str(), stdout);
    if (one_pair && !comparisons.front().error.empty())
        fmt::print(stderr, "brume: {}\n", printable(comparisons.front().error));
    const auto settled = [](const Comparison &c) { return c.settled(); };
    return std::all_of(comparisons.begin(), comparisons.end(), settled) ? kDone : kSomeFailed;
}

void add_limits(CLI::App &command, CompareOptions &options)
{
    Limits &limits = options.request.limits;
    const auto add = [&](const char *name, std::optional<double> &value, const char *help) {
        command.add_option(name, value, help)->group("Limits")->check([](const std::string &text) {
            double number = 0;
            const bool good = parse_number(text.data(), text.data() + text.size(), number) && number >= 0;
            return good ? std::string() : fmt::format("'{}': expected a number, at least 0", text);
        });
    };
    add("--max-relmse", limits.max_relmse, "Largest relMSE");
    add("--max-log2", limits.max_log2, "Largest log2 RMS");
    command.add_option("--energy", options.energy, "Least and largest energy ratio")->type_name("LOW:HIGH")->group("Limits");
    add("--fail", limits.fail,
        "A pixel fails where a component is further off than this (1e-6 where another limit of pixels is given)");
    add("--fail-relative", limits.fail_relative, "... and also than this times the mean of the two");
    add("--fail-percent", limits.fail_percent, "Percentage of pixels that may fail (default: 0)");
    add("--hard-fail", limits.hard_fail, "No pixel may be further off than this");
    command.add_option("--allow", limits.allow, "So many pixels may fail, by whatever")
        ->check(CLI::NonNegativeNumber)
        ->group("Limits");
    command
        .add_option("--search-radius", limits.search_radius,
                    "A pixel passes where a pixel of the other picture this near would do")
        ->check(CLI::Range(0, 64))
        ->type_name("PIXELS")
        ->group("Limits");
    command.add_option("--mask", options.request.mask, "EXR file: pixels that are 0 in it are not compared")
        ->type_name("FILE")
        ->group("Limits");
}

}  // namespace

void add_compare(CLI::App &app, Action &chosen)
{
    auto *command =
        app.add_subcommand("compare", "What A differs by from the reference B, and whether that is within limits");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("A", options->a, "EXR file, pattern or folder")->required();
    command->add_option("B", options->reference, "EXR file, pattern or folder: the reference")->required();
    command->add_option("--frames", options->frames, "Frames of patterns (default: all that either has)")
        ->type_name("RANGE");
    command->add_option("--difference,-d", options->difference, "Write |A - B| to this .exr, or scaled to this .png")
        ->type_name("FILE");
    command->add_flag("--flip", options->request.flip, "Measure HDR-FLIP too (takes longer)");
    command->add_flag("--header", options->request.header, "Say what differs beside the pixels");
    command->add_flag("--json", options->json, "Print JSON");
    command->add_option("--junit", options->junit, "Write a test report for CI systems")->type_name("FILE.xml");
    command->add_option("--html", options->html, "Write pages that show A, B and their difference")->type_name("DIR");
    command->add_flag("--update", options->update, "Copy A over B where the files differ");
    command->add_option("--jobs", options->jobs, "Pairs at a time (default: by the number of threads)")
        ->check(CLI::Range(1, 1024));
    command->add_option("--color", options->request.layers.color, "Layer to compare (default: as for run)")
        ->type_name("LAYER");
    command->add_option("--part", options->request.layers.part, "Part of a multi-part file, by name or index")
        ->type_name("NAME");
    command->add_option("--view", options->request.layers.view, "View of a stereo file")->type_name("NAME");
    add_limits(*command, *options);
    command->footer(
        "Exit status: 0 all within the limits; 1 beyond one, other windows or channels, or a file that cannot be read;\n"
        "2 the request was wrong (nothing was written).");
    command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace brume::tool
