#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/chart.hpp"
#include "bench/measure.hpp"

namespace brume::tool {

/// Everything that was measured on one picture by one backend.
struct BenchReport {
    std::string scene, frame, backend, device;
    std::uint32_t threads = 0;
    int width = 0, height = 0, repeat = 0;
    double copy_ms = 0, median_optical_depth = 0;
    std::vector<Group> groups;
};

/// With the backend's name and device, and nothing measured.
BenchReport report_for(const Context &context, const SceneText &scene, const Sample &sample, const BenchOptions &options);

nlohmann::ordered_json json_of(const Errors &errors);
nlohmann::ordered_json json_of(const Group &group);
nlohmann::ordered_json json_of(const BenchReport &report);
std::string markdown_of(const BenchReport &report);
ChartPanel panel_of(const Group &group, const std::string &title, std::optional<Metrics> Errors::*metrics);
std::vector<ChartKey> keys_of(const Group &group);
Chart chart_of(const BenchReport &report);

/// Beside its place and renamed. Throws FrameError.
void write_text(const std::filesystem::path &file, const std::string &text);

}  // namespace brume::tool
