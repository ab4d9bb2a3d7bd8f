#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "frames/range.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

struct StatsOptions {
    std::vector<std::string> parts;
    std::string output, frames;
};

ordered_json read_part(const std::string &path)
{
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw RequestError(fmt::format("{}: cannot be read; expected what --stats of `brume run` wrote", path));
    const ordered_json part = ordered_json::parse(stream, nullptr, false);
    const auto is_frame = [](const ordered_json &f) {
        return f.is_object() && f.contains("frame") && f["frame"].is_number_integer() && f.contains("output") &&
               f["output"].is_string() && f.contains("outcome") && f["outcome"].is_string();
    };
    if (!part.is_object() || !part.contains("scene") || !part.contains("totals") || !part.contains("frames") ||
        !part["frames"].is_array() || !std::all_of(part["frames"].begin(), part["frames"].end(), is_frame))
        throw RequestError(fmt::format("{}: no statistics; expected what --stats of `brume run` wrote", path));
    return part;
}

/// Of several tries at a frame the best counts: a later one finds it there, or was ended before it.
int rank_of(const ordered_json &frame)
{
    const std::vector<std::string> rising{"not tried", "failed", "skipped", "done"};
    return int(std::find(rising.begin(), rising.end(), frame["outcome"].get<std::string>()) - rising.begin());
}

class Merged {
public:
    void add(const std::string &path)
    {
        const ordered_json part = read_part(path);
        if (scene_.is_null()) {
            scene_ = part["scene"];
            first_ = path;
        } else if (part["scene"] != scene_) {
            throw RequestError(
                fmt::format("{}: scene {}; expected {}, that of {}", path, part["scene"].dump(), scene_.dump(), first_));
        }
        for (auto &[key, seen] : said_)
            if (part.contains(key) && part[key].is_string())
                seen.insert(part[key].get<std::string>());
        wall_seconds_ += part["totals"].value("wall_s", 0.0);
        in_flight_ = std::max(in_flight_, part["totals"].value("frames_in_flight", 0));
        ++parts_;
        for (const ordered_json &frame : part["frames"]) {
            const std::pair key(frame["frame"].get<int>(), frame["output"].get<std::string>());
            const auto [at, is_new] = frames_.emplace(key, frame);
            // Later parts are of later tries: what they say of a failure is the newer news.
            if (!is_new && rank_of(frame) >= rank_of(at->second))
                at->second = frame;
        }
    }

    /// Frames of the range that no part knows: whoever had them left no statistics.
    void expect(const std::vector<int> &range)
    {
        std::set<int> known;
        for (const auto &[key, frame] : frames_)
            known.insert(key.first);
        for (const int number : range)
            if (!known.count(number))
                frames_.emplace(std::pair(number, std::string()), ordered_json{{"frame", number}, {"outcome", "not tried"}});
    }

    std::size_t count(const std::string &outcome) const
    {
        return std::size_t(std::count_if(frames_.begin(), frames_.end(),
                                         [&](const auto &entry) { return entry.second["outcome"] == outcome; }));
    }

    ordered_json json() const
    {
        const std::size_t done = count("done");
        ordered_json out{{"scene", scene_}};
        for (const auto &[key, seen] : said_)
            out[key] = fmt::format("{}", fmt::join(seen, ", "));
        out["parts"] = parts_;
        out["totals"] = {{"done", done},
                         {"failed", count("failed")},
                         {"skipped", count("skipped")},
                         {"not_tried", count("not tried")},
                         {"wall_s", wall_seconds_},
                         {"frames_per_s", wall_seconds_ > 0 ? double(done) / wall_seconds_ : 0.0},
                         {"frames_in_flight", in_flight_}};
        for (const auto *stage : {"read", "fog", "write"})
            out["totals"][fmt::format("{}_ms", stage)] = sum({"ms", stage});
        out["totals"]["clamped_values"] = std::uint64_t(sum({"clamped_values"}));
        out["totals"]["nan_depth"] = std::uint64_t(sum({"pixels", "nan_depth"}));
        out["frames"] = ordered_json::array();
        for (const auto &[key, frame] : frames_)
            out["frames"].push_back(frame);
        return out;
    }

    /// A line for each frame that is not there, and one for all.
    void print() const
    {
        for (const auto &[key, frame] : frames_)
            if (rank_of(frame) < 2)
                fmt::print("frame {}: {}\n", key.first, frame.value("error", frame["outcome"].get<std::string>()));
        fmt::print("{} done, {} failed, {} skipped, {} not tried, by {} parts\n", count("done"), count("failed"),
                   count("skipped"), count("not tried"), parts_);
    }

private:
    double sum(const std::vector<std::string> &keys) const
    {
        double total = 0;
        for (const auto &[number, frame] : frames_) {
            const ordered_json *at = &frame;
            for (const std::string &key : keys)
                at = at && at->is_object() && at->contains(key) ? &(*at)[key] : nullptr;
            total += at && at->is_number() ? at->get<double>() : 0.0;
        }
        return total;
    }

    ordered_json scene_;
    std::string first_;
    std::vector<std::pair<std::string, std::set<std::string>>> said_{{"backend", {}}, {"device", {}}, {"color_config", {}}};
    std::map<std::pair<int, std::string>, ordered_json> frames_;
    double wall_seconds_ = 0;
    int in_flight_ = 0, parts_ = 0;
};

int merge(const StatsOptions &options)
{
    const std::vector<int> range = options.frames.empty() ? std::vector<int>() : parse_frames(options.frames);
    Merged merged;
    for (const std::string &part : options.parts)
        merged.add(part);
    merged.expect(range);
    if (!options.output.empty()) {
        try {
            write_text_file(options.output,
                            merged.json().dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n');
        } catch (const FrameError &e) {
            throw RequestError(e.what());
        }
    }
    merged.print();
    return merged.count("failed") + merged.count("not tried") ? kSomeFailed : kDone;
}

}  // namespace

void add_stats(CLI::App &app, Action &chosen)
{
    auto *command = app.add_subcommand("stats", "Merge the statistics of runs over parts of a sequence");
    auto options = std::make_shared<StatsOptions>();
    command->add_option("PART", options->parts, "Files that --stats of `brume run` wrote, of earlier tries first")
        ->required();
    command->add_option("-o,--output", options->output, "Where to write them as one")->type_name("FILE");
    command->add_option("--frames", options->frames, "Frames that should be there: those of no part count as not tried")
        ->type_name("RANGE");
    command->callback([&chosen, options] { chosen = [options] { return merge(*options); }; });
}

}  // namespace brume::tool
