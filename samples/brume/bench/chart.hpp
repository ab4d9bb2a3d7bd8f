#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/settings.hpp"

namespace brume::tool {

struct ChartPoint {
    int number;  ///< in the key
    Kind kind;
    double x, y;
};

/// Error over time, both logarithmic, with the Pareto front. Points that are not above 0 are left out.
struct ChartPanel {
    std::string title, x_label, y_label;
    std::vector<ChartPoint> points;
    std::optional<double> without_fog;  ///< error of doing nothing: a line across
};

struct ChartKey {
    int number;
    Kind kind;
    std::string name;
    bool measured = true;  ///< else it was refused
};

/// Panels in two columns beside the key to their numbers.
struct ChartSection {
    std::string title;
    std::vector<ChartPanel> panels;
    std::vector<ChartKey> keys;
};

struct Chart {
    std::string title;
    std::vector<ChartSection> sections;
};

/// .svg or .png, by the name. Throws FrameError where it cannot be written.
void draw_chart(const std::filesystem::path &file, const Chart &chart);

}  // namespace brume::tool
