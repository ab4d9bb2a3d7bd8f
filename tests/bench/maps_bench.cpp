// Tier `maps` of airlight on Fogshop's Table 1: 800 x 600, all pixels, how long its passes take and how far it is off.
//
//   maps_bench [--backend cpu|gl] [--size WxH] [--max-error E] [--tier TIER] [GAUSSIANS LIGHTS]...
#include <algorithm>
#include <chrono>
#include <ctime>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cloud.h"

namespace {

using namespace bench;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

struct Asked {
    std::string tier = "maps";
    double max_error = 0.01;
    int width = 800, height = 600;
    bool gl = false;
};

void measure(const Asked &asked, int gaussians, int lights)
{
    brume_context context = asked.gl ? brume_context(*fog::gl()) : brume_context(fog::cpu());
    const Cloud cloud(gaussians, lights);
    const View view{asked.width, asked.height};
    const Json scene = cloud.scene({{"tier", asked.tier}, {"max_error", asked.max_error}});
    const fog::Options options{nullptr, {"airlight"}};
    const fog::Picture black(view.width, view.height, 4), depth(black.width, black.height, 1, wall);
    const fog::Plan plan(context, scene.dump(), black.width, black.height, options,
                         [&](brume_scene s) { cloud.describe(s, context); });
    double best = 1e30, first = 0, cpu = 1e30;
    fog::Picture airlight;
    std::map<std::string, double> passes;
    for (int round = 0; round < 3; ++round) {
        const auto start = Clock::now();
        const std::clock_t cpu_start = std::clock();
        airlight = plan.execute(black, depth, options).airlight;
        const double ms = 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
        if (round == 0)
            first = ms;
        cpu = std::min(cpu, 1e3 * double(std::clock() - cpu_start) / CLOCKS_PER_SEC / threads());
        best = std::min(best, ms);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan, &info);
        for (uint32_t e = 0; e < info.entry_count; ++e) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, e, &entry);
            if (entry.runs && entry.measured_ms >= 0) {
                double &least = passes.try_emplace(entry.name, 0).first->second;
                least = std::max(least, entry.measured_ms);
                if (round == 0)
                    fmt::print("    {}: {}\n", entry.name, entry.reason);
            }
        }
    }
    std::mt19937 random(3);
    std::vector<std::pair<int, int>> places;
    std::vector<double> errors(gaussians > 20000 ? 60 : 400);
    for (size_t i = 0; i < errors.size(); ++i)
        places.push_back({int(random() % unsigned(view.width)), int(random() % unsigned(view.height))});
    double mean = 0;
    for (int i = 0; i < view.width * view.height; ++i)
        mean += double(airlight.at(i % view.width, i / view.width)[0]) / (view.width * view.height);
    in_parallel(errors.size(), [&](size_t i) {
        const double exact = exact_airlight(cloud, view.direction({places[i].first, places[i].second}));
        errors[i] =
            std::abs(double(airlight.at(places[i].first, places[i].second)[0]) - exact) / std::max(exact, 0.01 * mean);
    });
    const auto worst = std::max_element(errors.begin(), errors.end()) - errors.begin();
    const auto [wx, wy] = places[size_t(worst)];
    const double most = errors[size_t(worst)];
    std::sort(errors.begin(), errors.end());
    double sum = 0;
    for (double e : errors)
        sum += e / double(errors.size());
    auto at = [&](double q) { return 100 * errors[size_t(q * double(errors.size() - 1))]; };
    std::string each;
    for (const auto &[name, ms] : passes)
        each += fmt::format(" {} {:.0f}", name, ms);
    fmt::print("| {} | {} | {:.0f} | {:.0f} | {:.0f} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} at {}, {} |\n",
               gaussians, lights, cpu, best, first, each, 100 * sum, at(0.5), at(0.95), at(0.99), 100 * most, wx, wy);
    std::cout << std::flush;
}

}  // namespace

int main(int argc, char **argv)
{
    Asked asked;
    fmt::print("| Gaussians | lights | CPU ms / threads | ms | first frame | ms of passes at most | mean %, | median | 95 % "
               "| 99 % | worst |\n"
               "| ---: | ---: | ---: | ---: | ---: | --- | ---: | ---: | ---: | ---: | --- |\n");
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view name = argv[i], value = argv[i + 1];
        if (name == "--backend")
            asked.gl = value == "gl";
        else if (name == "--max-error")
            asked.max_error = std::atof(argv[i + 1]);
        else if (name == "--tier")
            asked.tier = value;
        else if (name == "--size")
            std::sscanf(argv[i + 1], "%dx%d", &asked.width, &asked.height);
        else
            measure(asked, std::atoi(argv[i]), std::atoi(argv[i + 1]));
    }
}
