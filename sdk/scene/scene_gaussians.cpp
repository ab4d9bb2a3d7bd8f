#include <algorithm>

#include "scene/frame_values.h"
#include "gaussians/gaussian_frames.h"

namespace brume {
namespace {

// So that their squares are normal numbers in float.
constexpr double smallest = 1e-18, largest = 1e18;

class Collector {
public:
    Collector(const Pose &pose, std::vector<brume_plugin_gaussian> &out) : pose_(pose), out_(out) {}

    void add(const Gaussian &gaussian, double amplitude)
    {
        const float c = float(std::min(gaussian.amplitude * amplitude, ranges::huge));
        if (!(c > 0.0f))
            return;
        if (out_.size() == BRUME_MAX_GAUSSIANS)
            throw Error(BRUME_ERROR_ARGUMENT, fmt::format("medium: more Gaussians than {}", BRUME_MAX_GAUSSIANS));
        brume_plugin_gaussian &to = out_.emplace_back();
        const std::array<double, 3> center = pose_.seen(gaussian.center);
        for (size_t i = 0; i < 3; ++i) {
            to.center[i] = float(std::clamp(center[i], -largest, largest));
            to.color[i] = gaussian.color[i];
        }
        to.scale = float(std::clamp(gaussian.scale / pose_.metres_per_unit, smallest, largest));
        to.amplitude = c;
    }

private:
    const Pose &pose_;
    std::vector<brume_plugin_gaussian> &out_;
};

Gaussian evaluate(const GaussianTerm &term, const FrameValues &values, const ValueName &name)
{
    Gaussian gaussian;
    gaussian.center = values.get(term.center, ranges::any, name.of(".center"));
    gaussian.scale = values.get(term.scale, ranges::positive, name.of(".scale"));
    gaussian.amplitude = values.get(term.amplitude, ranges::not_negative, name.of(".amplitude"));
    const std::array<double, 3> color = values.get(term.color, ranges::fraction, name.of(".colour"));
    for (size_t i = 0; i < 3; ++i)
        gaussian.color[i] = float(color[i]);
    return gaussian;
}

}  // namespace

void evaluate_gaussians(const Scene &scene, double frame, const std::array<double, 16> &camera_to_world,
                        std::vector<brume_plugin_gaussian> &out)
{
    out.clear();
    if (!scene.medium)
        return;
    const FrameValues values(frame);
    const Pose pose(camera_to_world, scene.metres_per_unit, values);
    Collector collector(pose, out);
    const std::vector<GaussianTerm> &terms = scene.medium->gaussians;
    for (size_t i = 0; i < terms.size(); ++i)
        collector.add(evaluate(terms[i], values, {"medium.gaussians", int64_t(i)}), 1.0);
    for (const GaussianSet &set : scene.medium->gaussian_sets) {
        const double amplitude = values.get(set.amplitude, ranges::not_negative, {set.file, -1, ": amplitude"});
        if (amplitude == 0.0)
            continue;
        const auto gaussians = set.frames ? set.frames->at(frame) : set.fixed;
        for (const Gaussian &gaussian : *gaussians)
            collector.add(gaussian, amplitude);
    }
}

}  // namespace brume
