#include "run/stats.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

using nlohmann::ordered_json;

const char *name_of(Outcome outcome)
{
    switch (outcome) {
    case Outcome::kDone:
        return "done";
    case Outcome::kFailed:
        return "failed";
    case Outcome::kSkipped:
        return "skipped";
    default:
        return "not tried";
    }
}

ordered_json passes_of(const std::vector<PassTime> &passes)
{
    ordered_json out = ordered_json::array();
    for (const PassTime &p : passes)
        out.push_back({{"effect", p.effect}, {"pass", p.name}, {"ms", p.ms}});
    return out;
}

ordered_json frame_of(const FrameStats &f)
{
    ordered_json out{{"frame", f.files.frame},
                     {"input", f.files.input.string()},
                     {"output", f.files.output.string()},
                     {"outcome", name_of(f.outcome)}};
    if (f.outcome == Outcome::kFailed)
        out["error"] = f.error;
    if (f.outcome != Outcome::kDone)
        return out;
    out["resolved"] = {{"color", f.color}, {"depth", f.depth}, {"camera", f.fog.camera}};
    for (const auto &[role, choice] : f.inputs)
        out["resolved"]["inputs"][role] = choice;
    out["ms"] = {{"read", f.read_ms}, {"fog", f.fog_ms}, {"write", f.write_ms}};
    out["passes"] = passes_of(f.fog.passes);
    out["pixels"] = {{"all", f.pixels},
                     {"far", f.depth_count.far},
                     {"nan_depth", f.depth_count.nan},
                     {"outside_depth_window", f.outside_depth_window},
                     {"not_finite_color", f.not_finite_pixels}};
    out["clamped_values"] = f.clamped_values;
    out["warnings"] = f.warnings;
    return out;
}

}  // namespace

bool is_stream(const std::filesystem::path &file)
{
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    return std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status);
}

std::size_t RunStats::count(Outcome outcome) const
{
    return std::size_t(std::count_if(frames.begin(), frames.end(), [&](const auto &f) { return f.outcome == outcome; }));
}

void write_stats(const std::filesystem::path &file, const RunStats &stats)
{
    double read = 0, fog = 0, write = 0;
    std::uint64_t clamped = 0, nan = 0;
    ordered_json frames = ordered_json::array();
    for (const FrameStats &f : stats.frames) {
        read += f.read_ms;
        fog += f.fog_ms;
        write += f.write_ms;
        clamped += f.clamped_values;
        nan += f.depth_count.nan;
        frames.push_back(frame_of(f));
    }
    const std::size_t done = stats.count(Outcome::kDone);
    const ordered_json out{{"scene", stats.scene},
                           {"backend", stats.backend},
                           {"device", stats.device},
                           {"color_config", stats.colors},
                           {"totals",
                            {{"done", done},
                             {"failed", stats.count(Outcome::kFailed)},
                             {"skipped", stats.count(Outcome::kSkipped)},
                             {"not_tried", stats.count(Outcome::kNotTried)},
                             {"wall_s", stats.wall_seconds},
                             {"frames_per_s", stats.wall_seconds > 0 ? double(done) / stats.wall_seconds : 0.0},
                             {"frames_in_flight", stats.frames_in_flight},
                             {"read_ms", read},
                             {"fog_ms", fog},
                             {"write_ms", write},
                             {"clamped_values", clamped},
                             {"nan_depth", nan}}},
                           {"frames", frames}};
    const std::string text = out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
    if (is_stream(file)) {
        std::ofstream stream(file);
        if (!(stream << text << std::flush))
            throw FrameError(fmt::format("{}: cannot be written", file.string()));
        return;
    }
    write_text_file(file, text);
}

}  // namespace brume::tool
