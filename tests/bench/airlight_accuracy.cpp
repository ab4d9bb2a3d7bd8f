// airlight_accuracy [--quick | --rays N] OUT.json OUT.md: relative errors of the airlight's tiers against adaptive
// quadrature over random geometries, regime by regime, and how far their error estimates can be trusted. N: at most so many
// rays per regime.
#include <atomic>
#include <chrono>
#include <fstream>
#include <iostream>
#include <limits>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "airlight_world.h"

using namespace airlight_cases;

namespace {

struct Tier {
    const char *name;
    int index;
};

constexpr Tier tiers[] = {{"sun", airlight_sun}, {"fogshop", airlight_fogshop}, {"nodes", airlight_nodes}};

// Rays come in blocks of their own seeds, so that the result does not depend on the number of threads.
struct Block {
    Errors errors[std::size(tiers)];
};

Block measured(const Regime &regime, uint64_t seed, int rays)
{
    Block block;
    Dice dice(seed);
    for (int i = 0; i < rays; ++i) {
        const Case c = regime.make(dice);
        World world(c);
        const vec3 exact = world.reference().radiance;
        for (size_t t = 0; t < std::size(tiers); ++t) {
            if (tiers[t].index != airlight_nodes && tiers[t].index != regime.published)
                continue;
            if (tiers[t].index == airlight_fogshop)
                world.airlight(airlight_fogshop);  // its table of Gaussians is no part of a ray's time
            const auto start = std::chrono::steady_clock::now();
            const narrow::Airlight found = world.airlight(tiers[t].index);
            block.errors[t].seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            block.errors[t].add(found, exact);
        }
    }
    return block;
}

Block measured_by_all_threads(const Regime &regime, int rays)
{
    const int per_block = std::max(1, std::min(500, rays / 8)), blocks = rays / per_block;
    std::vector<Block> parts(static_cast<size_t>(blocks));
    std::atomic<int> next = 0;
    auto work = [&] {
        for (int b = next++; b < blocks; b = next++)
            parts[size_t(b)] = measured(regime, uint64_t(b) + 1, per_block);
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back(work);
    threads.clear();
    Block all;
    for (const Block &part : parts)
        for (size_t t = 0; t < std::size(tiers); ++t)
            all.errors[t].append(part.errors[t]);
    return all;
}

}  // namespace

int main(int argc, char **argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool quick = arguments.size() == 3 && arguments[0] == "--quick",
               fewer = arguments.size() == 4 && arguments[0] == "--rays";
    if (!quick && !fewer && (arguments.size() != 2 || arguments[0].starts_with("--"))) {
        std::cerr << "airlight_accuracy [--quick | --rays N] OUT.json OUT.md\n";
        return 2;
    }
    const int most = fewer ? std::max(8, std::stoi(arguments[1])) : std::numeric_limits<int>::max();
    nlohmann::ordered_json json;
    std::string table =
        "| regime | rays | tier | mean | median | 95 % | 99 % | largest | estimate holds | estimate / error | us per ray |\n"
        "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
    auto add = [&](const std::string &regime, const std::string &tier, const Errors &e) {
        const double us = 1e6 * e.seconds / double(e.relative.size());
        json["airlight"].push_back({{"regime", regime},
                                    {"rays", e.relative.size()},
                                    {"tier", tier},
                                    {"mean", e.mean()},
                                    {"median", quantile(e.relative, 0.5)},
                                    {"p95", quantile(e.relative, 0.95)},
                                    {"p99", quantile(e.relative, 0.99)},
                                    {"max", quantile(e.relative, 1)},
                                    {"estimate_holds", e.covered()},
                                    {"estimate_over_error", quantile(e.overestimate, 0.5)},
                                    {"us_per_ray", us}});
        table += fmt::format("| {} | {} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.1f} % | {:.2g} | {:.3g} |\n",
                             regime, e.relative.size(), tier, e.mean(), quantile(e.relative, 0.5),
                             quantile(e.relative, 0.95), quantile(e.relative, 0.99), quantile(e.relative, 1),
                             100 * e.covered(), quantile(e.overestimate, 0.5), us);
    };
    Errors smooth, apart, near;
    for (const Regime &regime : regimes()) {
        const int rays = std::max(8, std::min(most, regime.rays / (quick ? 100 : 1)));
        const Block block = measured_by_all_threads(regime, rays);
        for (size_t t = 0; t < std::size(tiers); ++t)
            if (!block.errors[t].relative.empty())
                add(regime.name, tiers[t].name, block.errors[t]);
        (regime.kind == Kind::smooth ? smooth : regime.kind == Kind::apart ? apart : near).append(block.errors[2]);
        std::cerr << regime.name << '\n';
    }
    add("all without blobs", "nodes", smooth);
    add("all with blobs and lights two radii apart", "nodes", apart);
    add("all with blobs and lights nearer", "nodes", near);
    smooth.append(apart);
    smooth.append(near);
    add("all", "nodes", smooth);
    std::ofstream(argv[argc - 2]) << json.dump(1) << '\n';
    std::ofstream(argv[argc - 1]) << table;
    std::cout << table;
}
