// Whether predictions of error and cost hold, over fresh random scenes.
//
//   quality_bench [--quick] [--seed N] OUTPUT.json OUTPUT.md
#include <chrono>
#include <fstream>
#include <random>

#include "quality_study.h"

using namespace fog;

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
    unsigned seed = std::random_device()();
    int at = quick ? 2 : 1;
    if (at + 1 < argc && std::string(argv[at]) == "--seed") {
        seed = unsigned(std::stoul(argv[at + 1]));
        at += 2;
    }
    if (argc - at != 2) {
        fprintf(stderr, "usage: quality_bench [--quick] [--seed N] OUTPUT.json OUTPUT.md\n");
        return 2;
    }
    Json report{{"seed", seed}};
    std::ofstream table(argv[at + 1]);
    table << "Random scenes of seed " << seed << ".\n\n";
    std::vector<std::pair<std::string, brume_context>> devices{{"cpu", cpu()}};
    if (gl())
        devices.emplace_back("gl", *gl());

    table << "| backend | images up to | scenes | predicted errors hold in | predicted / measured, median |\n| --- | ---: | "
             "---: | ---: | ---: |\n";
    for (auto &[name, context] : devices)
        for (auto [largest, count] : {std::pair(56, quick ? 50 : 200), {128, quick ? 0 : 60}}) {
            if (count == 0)
                continue;
            const ErrorStudy study(context, seed, count, largest);
            char line[200];
            snprintf(line, sizeof line, "| %s | %d | %d | %.1f %% | %.2f |\n", name.c_str(), largest, count,
                     100 * study.share_that_holds(), study.median_ratio());
            table << line << std::flush;
            printf("%s", line);
            Json &rows = report["errors"][name + " " + std::to_string(largest)];
            for (const Predicted &p : study.all)
                rows.push_back({{"predicted", p.predicted}, {"measured", p.measured}, {"quality", p.quality}});
        }

    table << "\n| backend | calibration s | frames | predicted cost off by, median |\n| --- | ---: | ---: | ---: |\n";
    for (auto &[name, context] : devices) {
        const auto start = std::chrono::steady_clock::now();
        Context::check(brume_context_calibrate(context), context);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const std::vector<Cost> costs = cost_study(context, seed + 1, quick ? 20 : 80, 480);
        char line[200];
        snprintf(line, sizeof line, "| %s | %.1f | %zu | %.0f %% |\n", name.c_str(), seconds, costs.size(),
                 100 * median_miss(costs));
        table << line << std::flush;
        printf("%s", line);
        for (const Cost &c : costs)
            report["costs"][name].push_back({{"predicted_ms", c.predicted}, {"measured_ms", c.measured}});
    }
    std::ofstream(argv[at]) << report.dump(1) << "\n";
}
