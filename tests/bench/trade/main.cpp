// The study of error against time: every effect and setting over path-traced scenes, demo frames and random pictures, on
// each backend.
//
//   trade [--quick] [--fresh] SHARED_FOLDER SAMPLES_FOLDER OUTPUT_FOLDER
//
// Writes trade.json, trade.md, trade_short.md, trade.svg and trade.png there. --fresh draws random pictures that no run has
// drawn before.
#include <cstdio>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "study_report.h"

using namespace brume::tool;
using namespace trade;

namespace {

struct Device {
    brume::Context context;
    std::string name;
};

std::vector<Device> devices()
{
    std::vector<Device> all;
    for (const std::string backend : {"cpu", "gl"})
        try {
            brume::Context context = create_context(backend);
            const brume_context_info info = context.info();
            const std::string device =
                info.backend == BRUME_BACKEND_CPU ? fmt::format("CPU, {} threads", info.threads) : info.device;
            all.push_back({std::move(context), device});
        } catch (const std::exception &e) {
            fmt::print(stderr, "without {}: {}\n", backend, e.what());
        }
    return all;
}

SetResult measure_set(const std::vector<Device> &on, const Set &set, BenchOptions options)
{
    options.reference_width = set.reference_width;
    SetResult result{set.name, set.effect, {}, {}};
    std::vector<std::vector<Group>> groups(on.size());
    for (const Case &p : set.pictures) {
        fmt::print(stderr, "{}, {}: {}\n", set.effect, set.name, p.sample.name);
        const Reference reference = make_reference(on.front().context, p.scene, p.sample, set.effect, options);
        for (std::size_t d = 0; d < on.size(); ++d) {
            const brume::Context &context = on[d].context;
            BenchReport report = report_for(context, p.scene, p.sample, options);
            report.copy_ms = copy_ms(p.sample, options.repeat);
            report.median_optical_depth = median_optical_depth(context, p.scene, p.sample);
            report.groups.push_back(measure_group(context, p.scene, p.sample, reference, report.copy_ms, options));
            groups[d].push_back(report.groups.front());
            result.pictures.push_back(std::move(report));
        }
    }
    for (std::size_t d = 0; d < on.size(); ++d)
        result.means.emplace_back(on[d].name, aggregated(groups[d]));
    return result;
}

}  // namespace

int main(int argc, char **argv)
try {
    Options options;
    std::vector<std::string> folders;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--quick")
            options.quick = true;
        else if (word == "--fresh")
            options.seed = std::random_device()();
        else
            folders.push_back(word);
    }
    if (folders.size() != 3) {
        fmt::print(stderr, "usage: trade [--quick] [--fresh] SHARED_FOLDER SAMPLES_FOLDER OUTPUT_FOLDER\n");
        return 2;
    }
    options.shared = folders[0];
    options.samples = folders[1];
    BenchOptions bench;
    bench.repeat = options.quick ? 1 : 3;
    const std::vector<Device> on = devices();
    Study study{options.seed, options.quick, {}, {}};
    for (const Set &set : all_sets(options))
        study.sets.push_back(measure_set(on, set, bench));
    study.limits = measure_limits(on.front().context, options, truth_pictures(options, false));
    write_study(folders[2], study);
    return 0;
} catch (const std::exception &e) {
    fmt::print(stderr, "trade: {}\n", e.what());
    return 1;
}
