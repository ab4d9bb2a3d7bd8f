#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "frames/pattern.hpp"
#include "run/depth_count.hpp"
#include "run/fogger.hpp"

namespace brume::tool {

enum class Outcome { kDone, kFailed, kSkipped, kNotTried };

struct FrameStats {
    FrameFile files;
    Outcome outcome = Outcome::kNotTried;
    std::string error;
    std::string color, depth;                                 ///< what was resolved, and why
    std::vector<std::pair<std::string, std::string>> inputs;  ///< role, and what was resolved
    FogReport fog;
    DepthCount depth_count;
    std::uint64_t pixels = 0, not_finite_pixels = 0, outside_depth_window = 0, clamped_values = 0;
    double read_ms = 0, fog_ms = 0, write_ms = 0;
    std::vector<std::string> warnings;
};

struct RunStats {
    std::vector<FrameStats> frames;
    std::string scene, backend, device, colors;
    std::size_t frames_in_flight = 0;
    double wall_seconds = 0;

    std::size_t count(Outcome outcome) const;
};

/// Whether text goes there as it comes: a pipe or a device such as /dev/stderr.
bool is_stream(const std::filesystem::path &file);

void write_stats(const std::filesystem::path &file, const RunStats &stats);

}  // namespace brume::tool
