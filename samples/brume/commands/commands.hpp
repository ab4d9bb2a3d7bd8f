#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace brume::tool {

/// What the chosen command does once the line is parsed; returns the exit status.
using Action = std::function<int()>;

void add_run(CLI::App &app, Action &chosen);
void add_plan(CLI::App &app, Action &chosen);
void add_info(CLI::App &app, Action &chosen);
void add_calibrate(CLI::App &app, Action &chosen);
void add_compare(CLI::App &app, Action &chosen);
void add_bench(CLI::App &app, Action &chosen);
void add_effects(CLI::App &app, Action &chosen);
void add_schema(CLI::App &app, Action &chosen);
void add_sheet(CLI::App &app, Action &chosen);
void add_stats(CLI::App &app, Action &chosen);
void add_sweep(CLI::App &app, Action &chosen);
void add_media(CLI::App &app, Action &chosen);

}  // namespace brume::tool
