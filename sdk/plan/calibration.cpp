#include "plan/calibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "plan/context.h"
#include "plan/plan.h"

namespace brume {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds most_time(10);  // after which nothing more is begun
constexpr int rounds = 3;

// One of each kind of medium and light that passes cost differently for.
constexpr const char *scenes[] = {
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":[0.03,0.035,0.04],"absorption":0.002,"g":0.8},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1},
                  {"type":"point","position":[-4,2,-20],"intensity":40,"radius":0.1}]})",
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":0.03,"density":[{"type":"exponential","value":1,"falloff":0.2}]},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1}]})",
    R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
        "medium":{"scattering":0.05,"g":0.3,"density":[{"type":"constant","value":0.2},
          {"type":"gaussian","center":[0,0,-10],"scale":0.3,"amplitude":2},{"type":"gaussian","center":[5,1,-15],"scale":0.2,"amplitude":2},
          {"type":"gaussian","center":[-6,0,-18],"scale":0.25,"amplitude":2},{"type":"gaussian","center":[2,-2,-8],"scale":0.5,"amplitude":2}]},
        "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1}]})"};

// So many Gaussians, and so large, that they are gathered from maps.
std::string many_gaussians()
{
    std::string text =
        R"({"brume":1,"camera":{"vertical_fov":50,"camera_to_world":[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]},
            "lights":[{"type":"point","position":[2,1,-12],"intensity":40,"radius":0.1}],
            "medium":{"scattering":0.05,"density":[)";
    for (int i = 0; i < 60; ++i)
        text += fmt::format(R"({}{{"type":"gaussian","center":[{},{},{}],"scale":{},"amplitude":0.5}})", i ? "," : "",
                            i * 7 % 13 - 6, i * 5 % 7 - 3, -4 - i * 3 % 17, i % 2 ? 0.5 : 0.3);
    return text + "]}}";
}

// The second so much larger that what a pass takes at its start and what it takes an operation can be told apart.
constexpr std::pair<int, int> sizes[] = {{96, 54}, {320, 180}};

// A floor that recedes under a sky, boxes on it, and lamps.
struct TestFrame {
    std::vector<float> color, depth, output;
    brume_image images[3];
    brume_frame frame = BRUME_FRAME_INIT;

    TestFrame(int width, int height)
        : color(size_t(width) * size_t(height) * 4, 0.2f), depth(size_t(width) * size_t(height)), output(color.size())
    {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float below = (float(y) + 0.5f) / float(height) - 0.4f;
                const bool box = (x * 16 / width) % 5 == 1 && below > -0.2f;
                const size_t i = size_t(y) * size_t(width) + size_t(x);
                depth[i] = box ? 6.0f : below > 0.02f ? 3 / below : INFINITY;
                if ((x * 40 / width) % 7 == 2 && (y * 24 / height) % 6 == 3)
                    std::fill_n(color.begin() + ptrdiff_t(4 * i), 3, 60.0f);
            }
        float *const data[] = {color.data(), depth.data(), output.data()};
        for (int i = 0; i < 3; ++i) {
            images[i] = BRUME_IMAGE_INIT;
            images[i].width = width;
            images[i].height = height;
            images[i].channels = i == 1 ? 1 : 4;
            images[i].data = data[i];
        }
        frame.color = &images[0];
        frame.depth = &images[1];
        frame.output = &images[2];
    }
    TestFrame(const TestFrame &) = delete;
};

struct Sample {
    double operations, ms;
};

using Samples = std::map<std::pair<std::string, std::string>, std::vector<Sample>>;  // by effect and pass

void measure(const std::shared_ptr<Context> &context, const Scene &scene, TestFrame &test, Clock::time_point end,
             Samples &samples)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = test.images[0].width;
    format.height = test.images[0].height;
    brume_host_t plan(context, scene, format);
    std::vector<double> least(plan.entries().size(), INFINITY);
    for (int round = 0; round < rounds && (round == 0 || Clock::now() < end); ++round) {
        plan.execute(test.frame);
        const std::vector<double> ms = plan.measured_ms();
        // What runs when something moved alone took no time in the others.
        for (size_t i = 0; i < ms.size(); ++i)
            if (ms[i] > 0)
                least[i] = std::min(least[i], ms[i]);
    }
    for (size_t i = 0; i < least.size(); ++i) {
        const PlanEntry &entry = plan.entries()[i];
        if (entry.runs && entry.operations > 0 && least[i] > 0 && std::isfinite(least[i]))
            samples[{entry.effect, entry.name}].push_back({double(entry.operations), least[i]});
    }
}

// Each offer of each scene's effects alone, so that what other effects take is not measured again for each; cheap ones
// first.
std::vector<Scene> cases(const std::shared_ptr<Context> &context)
{
    std::vector<std::pair<size_t, Scene>> all;
    brume_format format = BRUME_FORMAT_INIT;
    format.width = sizes[0].first;
    format.height = sizes[0].second;
    std::vector<std::string> texts(std::begin(scenes), std::end(scenes));
    texts.push_back(many_gaussians());
    for (const std::string &text : texts) {
        const Scene scene = parse_scene(text, "calibration", context->effects);
        const brume_host_t open(context, scene, format, Purpose::rehearsal);
        for (const PlannedEffect &planned : open.effects())
            for (size_t offer = 0; offer < planned.offers.size(); ++offer) {
                if (planned.offers[offer].error == 0)
                    continue;
                Scene alone = scene;
                alone.effects = {{planned.effect->name, {}}};
                alone.effects_named = true;
                for (size_t i = 0; i < planned.effect->parameters.size(); ++i)
                    alone.effects[0].parameters[planned.effect->parameters[i].name] = planned.offers[offer].parameters[i];
                all.emplace_back(offer, std::move(alone));
            }
    }
    std::stable_sort(all.begin(), all.end(), [](auto &a, auto &b) { return a.first < b.first; });
    std::vector<Scene> sorted;
    for (auto &[offer, scene] : all)
        sorted.push_back(std::move(scene));
    return sorted;
}

// The line through two samples, or through one without a start, that all of them are nearest to as ratios.
Rate fit(const std::vector<Sample> &samples)
{
    Rate best;
    double least = INFINITY;
    auto consider = [&](Rate rate) {
        if (rate.start_ms < 0 || rate.ms_per_operation < 0)
            return;
        double miss = 0;
        for (const Sample &s : samples)
            miss += std::abs(std::log((rate.start_ms + s.operations * rate.ms_per_operation) / s.ms));
        if (miss < least) {
            least = miss;
            best = rate;
        }
    };
    for (const Sample &a : samples) {
        consider({0, a.ms / a.operations});
        for (const Sample &b : samples)
            if (a.operations < b.operations) {
                const double slope = (b.ms - a.ms) / (b.operations - a.operations);
                consider({a.ms - slope * a.operations, slope});
            }
    }
    return best;
}

}  // namespace

void calibrate(const std::shared_ptr<Context> &context)
{
    const auto end = Clock::now() + most_time;
    Samples samples;
    TestFrame small(sizes[0].first, sizes[0].second), large(sizes[1].first, sizes[1].second);
    const std::vector<Scene> scenes = cases(context);
    Progress &progress = context->progress;
    const double parts = 2 * double(scenes.size());
    double part = 0;
    for (const Scene &scene : scenes)
        for (TestFrame *test : {&small, &large}) {
            if (Clock::now() >= end)
                break;
            progress.enter_part(part / parts, (part + 1) / parts);
            measure(context, scene, *test, end, samples);
            ++part;
            progress.report(1);
            progress.throw_if_cancelled();
        }
    Rates rates;
    for (const auto &[pass, measured] : samples)
        rates.set(pass.first, pass.second, fit(measured));
    context->rates = rates;
}

}  // namespace brume
