// The paper's Table 1 on this machine's backends: kernels x fetches x sizes, and separation. Every time is also a ratio to
// a plain copy of the same frame measured in the same round, and bytes moved stand beside the least there are to move.
//
//   filter_bench [--quick] OUTPUT.json OUTPUT.md
#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>

#include <nlohmann/json.hpp>

#include "fog.h"

using namespace fog;
using Clock = std::chrono::steady_clock;

namespace {

double median(std::vector<double> v)
{
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

double milliseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Frame {
    Picture color, depth, output;
};

// Lamps over a floor that recedes under a sky, as a street has them.
Frame make_frame(int width, int height)
{
    Frame f{Picture(width, height, 4, 1), Picture(width, height, 1), Picture(width, height, 4)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float v = (float(y) + 0.5f) / float(height) - 0.4f;
            f.depth.at(x, y)[0] = v > 0.005f ? 1.5f / v : INFINITY;
            bool lamp = (x * 40 / width) % 5 == 2 && (y * 24 / height) % 6 == 3;
            for (int c = 0; c < 3; ++c)
                f.color.at(x, y)[c] = lamp ? 60.0f / float(1 + c) : 0.1f + 0.1f * float((x / 32 + y / 32) % 2);
        }
    return f;
}

struct Measured {
    double passes_ms = 0;  // the passes alone: GPU timers on GL
    double copy_ms = 0;    // a plain copy of the frame's colour in host memory
    double bytes = 0;      // least that the passes read and write
    std::vector<std::pair<std::string, double>> per_pass;
};

Measured measure(brume_context context, Frame &frame, const std::string &parameters, int rounds)
{
    Plan plan(context, scene("\"scattering\":[0.03,0.03,0.032],\"g\":0.8", parameters), frame.color.width,
              frame.color.height);
    brume_image c = describe(frame.color), d = describe(frame.depth), o = describe(frame.output);
    brume_frame f = BRUME_FRAME_INIT;
    f.color = &c;
    f.depth = &d;
    f.output = &o;
    Context::check(brume_plan_execute(plan, &f), context);
    std::vector<double> totals, copies;
    std::vector<std::vector<double>> passes;
    Measured m;
    for (int i = 0; i < rounds; ++i) {
        auto start = Clock::now();
        std::memcpy(frame.output.data.data(), frame.color.data.data(), frame.color.data.size() * sizeof(float));
        copies.push_back(milliseconds_since(start));
        Context::check(brume_plan_execute(plan, &f), context);
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        brume_plan_get_info(plan, &info);
        double total = 0;
        m.bytes = 0;
        passes.resize(info.entry_count);
        m.per_pass.clear();
        for (uint32_t e = 0; e < info.entry_count; ++e) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, e, &entry);
            if (!entry.runs)
                continue;
            total += entry.measured_ms;
            m.bytes += double(entry.bytes);
            passes[e].push_back(entry.measured_ms);
            m.per_pass.emplace_back(entry.name, median(passes[e]));
        }
        totals.push_back(total);
    }
    m.passes_ms = median(totals);
    m.copy_ms = median(copies);
    return m;
}

struct Variant {
    std::string kernel, fetch;
    bool separation;
    std::string parameters;
    bool is_default;  // of its kernel
};

std::vector<Variant> variants()
{
    std::vector<Variant> all;
    for (const std::string resolution : {"full", "half", "quarter"})
        for (const std::string lobes : {"every", "second", "third"})
            if (resolution == "full" || lobes == "second")
                all.push_back({"calibrated, " + resolution + ", " + lobes, "", false,
                               "\"resolution\":\"" + resolution + "\",\"lobes\":\"" + lobes + "\"", lobes == "second"});
    for (const std::string size : {"2x2", "4x4", "6x6"})
        for (const std::string fetch : {"linear_bilinear", "linear_bicubic", "cubic_bicubic"})
            for (bool separation : {false, true})
                // The paper separates with the bicubic fetch only.
                if (!separation || fetch == "linear_bicubic")
                    all.push_back({size, fetch, separation,
                                   "\"kernel\":\"paper\",\"kernel_size\":\"" + size + "\",\"fetch\":\"" + fetch +
                                       "\",\"separation\":" + (separation ? "true" : "false"),
                                   size == "4x4" && fetch == "linear_bicubic"});
    return all;
}

}  // namespace

int main(int argc, char **argv)
{
    bool quick = argc > 1 && std::string(argv[1]) == "--quick";
    if (argc != (quick ? 4 : 3)) {
        fprintf(stderr, "usage: filter_bench [--quick] OUTPUT.json OUTPUT.md\n");
        return 2;
    }
    nlohmann::json report = nlohmann::json::array();
    std::ofstream table(argv[argc - 1]);
    table << "| backend | size | kernel | fetch | separation | ms | x a copy in memory | MB at least | GB/s of that | "
             "passes |\n"
             "|---|---|---|---|---|---|---|---|---|---|\n";
    struct Device {
        const char *name;
        brume_context context;
    };
    std::vector<Device> devices{{"cpu", cpu()}};
    if (gl())
        devices.push_back({"gl", *gl()});
    for (auto &device : devices) {
        brume_context_info info = BRUME_CONTEXT_INFO_INIT;
        brume_context_get_info(device.context, &info);
        std::string name = std::string(device.name) + " (" + info.device +
                           (info.backend == BRUME_BACKEND_CPU ? ", " + std::to_string(info.threads) + " threads)" : ")");
        bool slow = name.find("llvmpipe") != std::string::npos || info.backend == BRUME_BACKEND_CPU;
        for (auto [width, height] : {std::pair(1280, 720), {1920, 1080}, {3840, 2160}}) {
            if (quick && slow && width > 1920)
                continue;
            Frame frame = make_frame(width, height);
            for (const Variant &v : variants()) {
                // Slow devices do 4K for the defaults alone.
                if ((quick || (slow && width > 1920)) && !v.is_default)
                    continue;
                const auto &[kernel, fetch, separation, parameters, is_default] = v;
                Measured m = measure(device.context, frame, parameters, slow ? 5 : 25);
                nlohmann::json passes;
                std::string listed;
                for (auto &[pass, ms] : m.per_pass) {
                    passes[pass] = ms;
                    char text[80];
                    snprintf(text, sizeof text, "%s%s %.3g", listed.empty() ? "" : ", ", pass.c_str(), ms);
                    listed += text;
                }
                report.push_back({{"backend", name},
                                  {"width", width},
                                  {"height", height},
                                  {"kernel", kernel},
                                  {"fetch", fetch},
                                  {"separation", separation},
                                  {"ms", m.passes_ms},
                                  {"copy_ms", m.copy_ms},
                                  {"ratio_to_copy", m.passes_ms / m.copy_ms},
                                  {"least_bytes", m.bytes},
                                  {"passes_ms", passes}});
                char line[400];
                snprintf(line, sizeof line, "| %s | %d x %d | %s | %s | %s | %.4g | %.1f | %.0f | %.2f | %s |\n",
                         name.c_str(), width, height, kernel.c_str(), fetch.c_str(), separation ? "yes" : "", m.passes_ms,
                         m.passes_ms / m.copy_ms, m.bytes / 1e6, m.bytes / m.passes_ms / 1e6, listed.c_str());
                table << line << std::flush;
                printf("%s", line);
                fflush(stdout);
            }
        }
    }
    std::ofstream(argv[argc - 2]) << report.dump(1) << "\n";
    return 0;
}
