#include "limits.h"

#include <algorithm>

#include "bench/measure.hpp"
#include "bench/run_setting.hpp"

using namespace brume::tool;

namespace trade {
namespace {

std::vector<float> columns(const std::vector<float> &pixels, int width, int channels, int first, int count)
{
    std::vector<float> out;
    for (std::size_t at = std::size_t(first * channels); at < pixels.size(); at += std::size_t(width * channels))
        out.insert(out.end(), pixels.begin() + std::ptrdiff_t(at), pixels.begin() + std::ptrdiff_t(at) + count * channels);
    return out;
}

Picture half_of(const Picture &p, int first)
{
    return {0, 0, p.width / 2, p.height, columns(p.rgb, p.width, 3, first, p.width / 2)};
}

// The data window covers half of the display window: rays stay what they were.
Sample half_of(const Sample &sample, int first)
{
    Sample out = sample;
    const int half = sample.width() / 2;
    out.format.width = half;
    out.format.display_x -= first;
    out.color = columns(sample.color, sample.width(), sample.channels, first, half);
    out.depth = columns(sample.depth, sample.width(), 1, first, half);
    out.truth = half_of(*sample.truth, first);
    return out;
}

Picture fogged(const brume::Context &context, const SceneText &scene, const Sample &sample)
{
    SettingRun run(context, scene, nullptr, sample);
    run.execute();
    return run.picture();
}

double error(const Picture &a, const Sample &sample)
{
    return error_of(measure(a, *sample.truth, sample.weights));
}

}  // namespace

std::vector<Limit> measure_limits(const brume::Context &cpu, const Options &options, const std::vector<Case> &truths)
{
    std::vector<Limit> all;
    for (const Case &p : truths) {
        const Sample &sample = p.sample;
        Json lit = Json::parse(p.scene.text), once = lit;
        Limit limit{.scene = p.scene.name,
                    .optical_depth = median_optical_depth(cpu, p.scene, sample),
                    .g = lit["medium"].value("g", 0.0),
                    .without_fog =
                        error(picture_of(sample.color, sample.width(), sample.height(), sample.channels), sample)};
        const Picture whole = fogged(cpu, p.scene, sample);
        limit.filter = error(whole, sample);
        once["lights"] = lit["lights"] = lights_of_description(truth_description(options, p.scene.name));
        once["effects"] = {{"airlight", {{"resolution", "quarter"}}}};
        lit["effects"] = {{"multiscatter", Json::object()}, {"airlight", {{"resolution", "quarter"}}}};
        limit.lights_once = error(fogged(cpu, scene_text(p.scene.name, once), sample), sample);
        limit.both = error(fogged(cpu, scene_text(p.scene.name, lit), sample), sample);
        for (const int first : {0, sample.width() - sample.width() / 2}) {
            const Sample half = half_of(sample, first);
            limit.half_of_whole += error(half_of(whole, first), half) / 2;
            limit.half_alone += error(fogged(cpu, p.scene, half), half) / 2;
        }
        all.push_back(limit);
    }
    return all;
}

}  // namespace trade
