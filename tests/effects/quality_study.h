#pragma once
// What quality chooses for random scenes, against what it predicts.
#include <numeric>

#include "picture_metrics.h"
#include "random_scenes.h"

namespace fog {

struct Predicted {
    double predicted = 0, measured = 0;
    std::string quality;  // what was chosen
};

inline brume_plan_info info_of(const Plan &plan)
{
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    brume_plan_get_info(plan, &info);
    return info;
}

// A random scene with its reference, and with what predictions depend on filled in as the tool does from a frame.
struct Referenced {
    RandomScene random;
    Picture reference;
    double transmittance = 0, detail = 0;

    Referenced(RandomScenes &scenes, bool lit) : random(scenes.next(lit))
    {
        Json exact = random.scene;
        exact["quality"] = "reference";
        const Result r = run(cpu(), exact.dump(), random.frame.color, random.frame.depth, Options{{}, {"transmittance"}});
        reference = r.output;
        transmittance = std::accumulate(r.transmittance.data.begin(), r.transmittance.data.end(), 0.0) /
                        double(r.transmittance.data.size());
        detail = detail_of(random.frame.color);
    }

    // quality: {"max_error": .1}, say.
    Predicted with(brume_context context, Json quality) const
    {
        quality["transmittance"] = transmittance;
        quality["detail"] = detail;
        Json scene = random.scene;
        scene["quality"] = quality;
        const Plan plan(context, scene.dump(), random.frame.color.width, random.frame.color.height);
        const brume_plan_info info = info_of(plan);
        return {info.predicted_error, error_of(plan.execute(random.frame.color, random.frame.depth).output, reference),
                info.quality};
    }
};

struct ErrorStudy {
    std::vector<Predicted> all;

    ErrorStudy(brume_context context, unsigned seed, int count, int largest)
    {
        static const Json qualities[] = {{{"preset", "draft"}}, {{"preset", "standard"}}, {{"preset", "final"}},
                                         {{"max_error", 0.5}},  {{"max_error", 0.2}},     {{"max_error", 0.05}}};
        RandomScenes scenes(seed, largest);
        for (int i = 0; i < count; ++i)
            all.push_back(Referenced(scenes, i % 2 == 0).with(context, qualities[size_t(i) % std::size(qualities)]));
    }

    double share_that_holds() const
    {
        return double(std::count_if(all.begin(), all.end(), [](auto &p) { return p.measured <= p.predicted; })) /
               double(all.size());
    }
    double median_ratio() const
    {
        std::vector<double> ratios;
        for (auto &p : all)
            ratios.push_back(p.predicted / std::max(p.measured, 1e-6));
        std::nth_element(ratios.begin(), ratios.begin() + ptrdiff_t(ratios.size() / 2), ratios.end());
        return ratios[ratios.size() / 2];
    }
};

struct Cost {
    double predicted = 0, measured = 0;  // [ms]
};

// Of a frame in which something moved, executed three times: the least of each pass, of those the sum.
inline Cost cost_of(const Plan &plan, const Frame &frame)
{
    const brume_plan_info info = info_of(plan);
    std::vector<double> least(info.entry_count, INFINITY);
    for (int round = 0; round < 3; ++round) {
        plan.execute(frame.color, frame.depth);
        for (uint32_t e = 0; e < info.entry_count; ++e) {
            brume_plan_entry entry = BRUME_PLAN_ENTRY_INIT;
            brume_plan_get_entry(plan, e, &entry);
            if (entry.runs && entry.measured_ms > 0)
                least[e] = std::min(least[e], entry.measured_ms);
        }
    }
    Cost cost{info.predicted_ms, 0};
    for (double ms : least)
        cost.measured += std::isfinite(ms) ? ms : 0;
    return cost;
}

// For presets in turn.
inline std::vector<Cost> cost_study(brume_context context, unsigned seed, int count, int largest)
{
    static const char *const presets[] = {"draft", "standard", "final"};
    RandomScenes scenes(seed, largest);
    std::vector<Cost> all;
    for (int i = 0; i < count; ++i) {
        const RandomScene random = scenes.next(i % 2 == 0);
        Json scene = random.scene;
        scene["quality"] = presets[i % 3];
        all.push_back(
            cost_of(Plan(context, scene.dump(), random.frame.color.width, random.frame.color.height), random.frame));
    }
    return all;
}

// Of a bank of `count` Gaussians that fills the view, lit by one lamp.
inline Cost cost_of_bank(brume_context context, int count)
{
    const Frame frame = lit_frame(128, 96);
    Json medium{{"scattering", 0.2}};
    medium["density"] = random_gaussians(count, 3, 12, 3 * std::cbrt(34.0 / count), 1);
    const Json scene = lit_scene(medium, Json::array({point_light({-3, 2, -8}, 30)}), {{"max_error", 0.1}});
    return cost_of(Plan(context, scene.dump(), frame.color.width, frame.color.height), frame);
}

// Median of |predicted / measured - 1|.
inline double median_miss(const std::vector<Cost> &costs)
{
    std::vector<double> misses;
    for (auto &c : costs)
        misses.push_back(std::abs(c.predicted / c.measured - 1));
    std::nth_element(misses.begin(), misses.begin() + ptrdiff_t(misses.size() / 2), misses.end());
    return misses[misses.size() / 2];
}

}  // namespace fog
