// Light scattered any number of times on a street with eight lanterns: what it takes from a grid and at each pixel, beside
// light that scatters once, how far the two are apart, and what tier maps has of light scattered once against tier nodes.
//
//   orders_bench FRAME.exr [TIMES]   TIMES: the frame enlarged so often each way, without what each pixel takes by itself
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <map>

#include <fmt/format.h>

#include "clouds.h"
#include "exr.h"
#include "picture_metrics.h"

using namespace fog;

namespace {

// The camera of samples/frames and the medium of its street.json.
Json street(int banks)
{
    const Json up{0, 0, 1};
    Json density{{{"type", "exponential"}, {"value", 0.6}, {"falloff", 0.06}, {"direction", up}},
                 {{"type", "exponential"}, {"value", 1}, {"falloff", 0.3}, {"direction", up}}};
    std::mt19937 random(4);
    auto uniform = [&](double a, double b) { return a + (b - a) * double(random() % 65536u) / 65536; };
    for (int i = 0; i < banks; ++i)
        density.push_back(
            gaussian({uniform(-5, 4), uniform(9, 69), uniform(0.3, 2.5)}, 1 / uniform(1, 2.2), uniform(3, 12)));
    Json scene = lit_scene({{"scattering", {0.03, 0.03, 0.032}}, {"g", 0.8}, {"density", density}}, Json::array());
    scene["camera"] = {{"vertical_fov", 41.11},
                       {"camera_to_world", {{1, 0, 0, -1.75}, {0, 0, -1, 0}, {0, 1, 0, 1.7}, {0, 0, 0, 1}}}};
    for (int i = 0; i < 8; ++i) {
        Json lantern = point_light({i % 2 ? 4.5 : -4.5, 9.5 + 8 * i, 3.74}, 0, 0.13);
        lantern["intensity"] = {91, 61, 33};
        scene["lights"].push_back(lantern);
    }
    return scene;
}

Picture enlarged(const Picture &p, int times)
{
    Picture larger(p.width * times, p.height * times, p.channels);
    for (int y = 0; y < larger.height; ++y)
        for (int x = 0; x < larger.width; ++x)
            std::copy_n(p.at(x / times, y / times), p.channels, larger.at(x, y));
    return larger;
}

constexpr float sky = 1e6f;  // pixels farther show nothing [m]

// Every fifth pixel each way, of those that show something.
Picture fifths(const Picture &p, const Picture &depth)
{
    Picture some(0, 1, p.channels);
    for (int y = 2; y < p.height; y += 5)
        for (int x = 2; x < p.width; x += 5)
            if (*depth.at(x, y) < sky) {
                some.data.insert(some.data.end(), p.at(x, y), p.at(x, y) + p.channels);
                ++some.width;
            }
    return some;
}

// Pictures of light scattered once by tier maps against tier nodes, per cent of the pixel or of a hundredth of the mean.
std::string against_nodes(Json scene, const Picture &maps, const Frame &frame)
{
    Frame fifth = frame;
    for (int y = 0; y < frame.depth.height; ++y)
        for (int x = 0; x < frame.depth.width; ++x)
            if (x % 5 != 2 || y % 5 != 2)
                *fifth.depth.at(x, y) = INFINITY;
    scene["effects"]["airlight"] = {{"orders", "single"}, {"max_error", 0.001}, {"tier", "nodes"}};
    const Options options{[](brume_format &format) { format.sky = BRUME_SKY_KEEP; }, {"airlight"}};
    const Picture exact = run(cpu(), scene.dump(), fifth.color, fifth.depth, options).airlight;
    const Errors e = errors(fifths(maps, frame.depth), fifths(exact, frame.depth));
    return fmt::format("{:.3f}, {:.3f}, {:.3f}", 100 * e.median, 100 * e.p95, 100 * e.p99);
}

struct Measured {
    Picture airlight;
    double cpu_ms = 0;
    std::string passes;
};

Measured measure(Json scene, const char *orders, double max_error, const char *tier, const Frame &frame)
{
    scene["effects"]["airlight"] = {{"orders", orders}, {"max_error", max_error}, {"tier", tier}};
    const Options options{{}, {"airlight"}};
    const Plan plan(cpu(), scene.dump(), frame.color.width, frame.color.height, options);
    Measured m;
    const std::clock_t start = std::clock();
    m.airlight = plan.execute(frame.color, frame.depth, options).airlight;
    m.cpu_ms = 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC;
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    brume_plan_get_info(plan, &info);
    for (uint32_t e = 0; e < info.entry_count; ++e) {
        brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
        brume_plan_get_entry(plan, e, &entry);
        if (entry.runs && entry.measured_ms >= 10)
            m.passes += fmt::format(" {} {:.0f}", entry.name, entry.measured_ms);
    }
    return m;
}

}  // namespace

int main(int argc, char **argv)
{
    const int times = argc == 3 ? std::atoi(argv[2]) : 1;
    if (argc < 2 || argc > 3 || times < 1) {
        std::cerr << "usage: orders_bench FRAME.exr [TIMES]\n";
        return 2;
    }
    const Frame frame{enlarged(read_exr(argv[1], {"R", "G", "B", "A"}), times), enlarged(read_exr(argv[1], {"Z"}), times)};
    fmt::print("{} x {}\n| banks of fog | tier | once: CPU ms | grid: CPU ms | ms of its passes | once by maps: median, 95, "
               "99 % error, % | "
               "each pixel: CPU ms | relMSE of the two |\n"
               "| ---: | --- | ---: | ---: | --- | --- | ---: | ---: |\n",
               frame.color.width, frame.color.height);
    for (int banks : {0, 12, 200}) {
        const Json scene = street(banks);
        const char *tier = banks > 0 ? "maps" : "nodes";  // as the plan chooses
        const Measured once = measure(scene, "single", 0.01, tier, frame), grid = measure(scene, "all", 0.01, tier, frame);
        fmt::print("| {} | {} | {:.0f} | {:.0f} | {} | {} |", banks, tier, once.cpu_ms, grid.cpu_ms, grid.passes,
                   banks > 0 ? against_nodes(scene, once.airlight, frame) : "");
        std::cout << std::flush;
        if (banks <= 12 && times == 1) {
            const Measured exact = measure(scene, "all", 0.004, "nodes", frame);
            fmt::print(" {:.0f} | {:.1e} |\n", exact.cpu_ms, rel_mse(grid.airlight, exact.airlight));
        } else {
            fmt::print(" | |\n");
        }
    }
}
