// Fogshop's Table 1 and beyond on this machine's backends: airlight of n Gaussians and 1 or 3 lights at 800 x 600, as
// milliseconds and as a ratio to a ray march of equal error; and how the time grows with what is out of sight, with lights
// and with pixels.
//
//   airlight_bench [--quick] OUTPUT.json OUTPUT.md
//
// The tiers run at every fourth pixel each way. All pixels take 16 times as long for what is reduced, which the first rows
// measure and the others say without running it. From 1000 Gaussians on the middle of the picture, a quarter of each side or
// (100,000) an eighth, stands for all of it. The march runs on the pixels whose error is measured. Times on the CPU are
// those of the threads, over their number.
#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <iostream>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cloud.h"
#include "fog.h"
#include "ray_march.h"

namespace {

using namespace bench;
using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;
using brume::maths_float::Gaussian;
using brume::maths_float::Light;
using brume::maths_float::vec3;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Of all threads of this process: other work on the machine does not count.
double cpu_milliseconds()
{
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

// Mean relative error of a picture at these pixels.
double error_of(const fog::Picture &airlight, const View &view, const std::vector<Probe> &pixels)
{
    double sum = 0;
    for (const Probe &p : pixels)
        sum += std::abs(airlight.at(p.x - view.left(), p.y - view.top())[0] - p.exact) / p.exact;
    return sum / double(pixels.size());
}

struct Measured {
    double gather_ms = 0;  // of the pass that the resolution reduces
    double other_ms = 0;   // of the others
    double lists_ms = 0;   // what a frame costs besides, if all has moved: lists, images of data
    fog::Picture airlight;

    double ms() const { return gather_ms + other_ms; }
};

Measured measure(brume_context context, const Cloud &cloud, const View &view, const std::string &tier,
                 const std::string &resolution)
{
    const Json scene = cloud.scene({{"tier", tier}, {"resolution", resolution}});
    const fog::Options options{[&](brume_format &format) {
                                   format.display_x = -view.left();
                                   format.display_y = -view.top();
                                   format.display_width = view.width;
                                   format.display_height = view.height;
                               },
                               {"airlight"}};
    const fog::Picture black(view.image_width(), view.image_height(), 4), depth(black.width, black.height, 1, wall);
    const fog::Plan plan(context, scene.dump(), black.width, black.height, options,
                         [&](brume_scene s) { cloud.describe(s, context); });
    Measured m;
    const auto begin = Clock::now();
    brume_context_info device = BRUME_CONTEXT_INFO_INIT;
    brume_context_get_info(context, &device);
    // The least of a few, where they are short.
    for (int round = 0; round < 3 && (round == 0 || seconds_since(begin) < 3); ++round) {
        const auto start = Clock::now();
        const double cpu_start = cpu_milliseconds();
        m.airlight = plan.execute(black, depth, options).airlight;
        const double cpu = cpu_milliseconds() - cpu_start, all = 1e3 * seconds_since(start);
        double gather = 0, other = 0;
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan, &info);
        for (uint32_t e = 0; e < info.entry_count; ++e) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, e, &entry);
            if (entry.runs && std::string(entry.name) != "blobs")
                (std::string(entry.name) == "gather" ? gather : other) += std::max(entry.measured_ms, 0.0);
        }
        double lists = std::max(all - gather - other, 0.0);
        // The passes run on all threads, the rest on one.
        if (device.backend == BRUME_BACKEND_CPU) {
            const double share = cpu / (threads() * (gather + other) + lists);
            gather *= share;
            other *= share;
            lists *= share;
        }
        m.gather_ms = round == 0 ? gather : std::min(m.gather_ms, gather);
        m.other_ms = round == 0 ? other : std::min(m.other_ms, other);
        if (round == 0)
            m.lists_ms = lists;
    }
    m.gather_ms *= view.scale();
    m.other_ms *= view.scale();
    return m;
}

struct Marched {
    int steps = 0;
    double ms = 0, error = 0;
};

// The least number of steps, in ratios of about 1.4, whose error is no larger; its time for all pixels on all threads.
Marched marched_to(const March &march, const Cloud &cloud, const View &view, const std::vector<Probe> &pixels, double error)
{
    for (double steps = 2;; steps *= 1.4142135623730951) {
        Marched m{int(steps)};
        auto run = [&] {
            m.error = 0;
            const double start = cpu_milliseconds();
            for (const Probe &p : pixels) {
                const vec3 direction = view.direction(p);
                m.error +=
                    std::abs(march.airlight(direction, wall / -direction.z, cloud.lights, m.steps) - p.exact) / p.exact;
            }
            m.error /= double(pixels.size());
            return (cpu_milliseconds() - start) / double(pixels.size()) * view.width * view.height / threads();
        };
        m.ms = run();
        if (m.error > error && steps < 400)
            continue;
        for (int round = 0; round < 2 && m.ms < 3e6; ++round)
            m.ms = std::min(m.ms, run());
        return m;
    }
}

class Report {
public:
    void heading(const std::string &text) { markdown_ += text; }
    void row(const Json &values, const std::string &line)
    {
        json_.push_back(values);
        markdown_ += line;
        std::cout << line << std::flush;
    }
    void write(const char *json, const char *markdown) const
    {
        std::ofstream(json) << json_.dump(1) << '\n';
        std::ofstream(markdown) << markdown_;
    }

private:
    Json json_ = Json::array();
    std::string markdown_;
};

const View table_view{800, 600}, table_middle{800, 600, 4}, table_spot{800, 600, 8};

void table(Report &report, bool quick)
{
    report.heading("| Gaussians | lights | tier | ms, all pixels | ms, quarter | lists ms | mean error | march: steps | its "
                   "error | ms | march / tier |\n"
                   "| ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (int n : {34, 292, 353, 1223, 3008, 10000, 100000}) {
        if (quick && n > 353)
            break;
        for (int light_count : {1, 3}) {
            if (n > 10000 && light_count > 1)
                break;
            const Cloud cloud(n, light_count);
            const View &view = n > 10000 ? table_spot : n > 1000 ? table_middle : table_view;
            const March march(cloud.gaussians, cloud.radius);
            // Those that the reduced resolution evaluates.
            std::vector<Probe> pixels;
            std::mt19937 random(3);
            for (int i = 0; i < (n > 10000 ? 16 : n > 1000 ? 48 : 96); ++i)
                pixels.push_back({view.left() + 4 * int(random() % unsigned(view.image_width() / 4)) + 2,
                                  view.top() + 4 * int(random() % unsigned(view.image_height() / 4)) + 2});
            in_parallel(pixels.size(),
                        [&](size_t i) { pixels[i].exact = exact_airlight(cloud, view.direction(pixels[i])); });
            for (const char *tier : {"fogshop", "nodes"}) {
                const Measured m = measure(fog::cpu(), cloud, view, tier, "quarter");
                const bool all = n == 34 && light_count == 1;
                const double full_ms =
                    all ? measure(fog::cpu(), cloud, view, tier, "full").ms() : 16 * m.gather_ms + m.other_ms;
                const double error = error_of(m.airlight, view, pixels);
                const Marched marched = marched_to(march, cloud, view, pixels, error);
                report.row(
                    {{"backend", "cpu"},
                     {"gaussians", n},
                     {"lights", light_count},
                     {"tier", tier},
                     {"all_pixels_ms", full_ms},
                     {"all_pixels_measured", all},
                     {"quarter_ms", m.ms()},
                     {"lists_ms", m.lists_ms},
                     {"mean_error", error},
                     {"march_steps", marched.steps},
                     {"march_error", marched.error},
                     {"march_ms", marched.ms},
                     {"march_over_tier", marched.ms / full_ms}},
                    fmt::format("| {} | {} | {} | {:.3g} | {:.3g} | {:.3g} | {:.2g} | {} | {:.2g} | {:.3g} | {:.2g} |\n", n,
                                light_count, tier, full_ms, m.ms(), m.lists_ms, error, marched.steps, marched.error,
                                marched.ms, marched.ms / full_ms));
            }
        }
    }
}

void growth(Report &report, const char *what, const char *header, const std::vector<int> &values, int most,
            const std::function<std::pair<Cloud, View>(int)> &make)
{
    report.heading(fmt::format("\n| {} | fogshop ms | nodes ms | lists ms |\n| ---: | ---: | ---: | ---: |\n", header));
    for (int value : values) {
        if (value > most)
            break;
        const auto [cloud, view] = make(value);
        const Measured fogshop = measure(fog::cpu(), cloud, view, "fogshop", "quarter"),
                       nodes = measure(fog::cpu(), cloud, view, "nodes", "quarter");
        report.row({{"growth", what},
                    {what, value},
                    {"fogshop_ms", fogshop.ms()},
                    {"nodes_ms", nodes.ms()},
                    {"lists_ms", nodes.lists_ms}},
                   fmt::format("| {} | {:.3g} | {:.3g} | {:.3g} |\n", value, fogshop.ms(), nodes.ms(), nodes.lists_ms));
    }
}

void on_gl(Report &report)
{
    if (!fog::gl())
        return;
    brume_context_info info = BRUME_CONTEXT_INFO_INIT;
    brume_context_get_info(*fog::gl(), &info);
    report.heading(fmt::format(
        "\n| on {} | lights | tier | ms, quarter | on the CPU |\n| ---: | ---: | --- | ---: | ---: |\n", info.device));
    for (int n : {34, 353})
        for (const char *tier : {"fogshop", "nodes"}) {
            const Cloud cloud(n, 1);
            const Measured gl = measure(*fog::gl(), cloud, table_view, tier, "quarter"),
                           cpu = measure(fog::cpu(), cloud, table_view, tier, "quarter");
            report.row({{"backend", "gl"},
                        {"gaussians", n},
                        {"lights", 1},
                        {"tier", tier},
                        {"quarter_ms", gl.ms()},
                        {"cpu_quarter_ms", cpu.ms()}},
                       fmt::format("| {} | 1 | {} | {:.3g} | {:.3g} |\n", n, tier, gl.ms(), cpu.ms()));
        }
}

}  // namespace

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
    if (argc != (quick ? 4 : 3)) {
        std::cerr << "usage: airlight_bench [--quick] OUTPUT.json OUTPUT.md\n";
        return 2;
    }
    Report report;
    table(report, quick);
    growth(report, "out_of_sight", "300 Gaussians in sight, and out of sight", {0, 300, 3000, 30000, 100000},
           quick ? 3000 : 100000, [](int n) {
               Cloud cloud(300, 1);
               cloud.hide(n);
               return std::pair(cloud, table_view);
           });
    growth(report, "lights", "300 Gaussians, and lights", {1, 2, 4, 8}, 8,
           [](int n) { return std::pair(Cloud(300, n), table_view); });
    growth(report, "pixels", "300 Gaussians, and pixels of the image", {120000, 480000, 1920000}, quick ? 480000 : 1920000,
           [](int n) {
               const int height = int(std::lround(std::sqrt(n * 0.75)));
               return std::pair(Cloud(300, 1), View{height * 4 / 3, height});
           });
    on_gl(report);
    report.write(argv[argc - 2], argv[argc - 1]);
}
