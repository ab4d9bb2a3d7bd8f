#include "maps/slices.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_maths.hpp"

namespace airlight::maps {
namespace {

using namespace brume::maths_double;

constexpr int bins = 256;
constexpr int before_gaussians = 8, behind_gaussians = 20;

// Along the view: where Gaussians are, and what the smallest of each place is.
struct AlongView {
    double from = 0, to = 0;
    std::array<double, bins> sharpness{};  // 1 / radius

    double width() const { return (to - from) / bins; }
};

AlongView along_view(const brume_plugin_scene &scene)
{
    const Medium medium = medium_of(scene);
    AlongView p;
    p.from = 1e30;
    auto each = [&](auto visit) {
        for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
            const Gaussian g = gaussian_of(given);
            const double reach = gaussian_reach(medium, g);
            if (-g.center.z + reach > 0)
                visit(g, length(g.center), reach);
        }
    };
    if (scene.gaussians)
        each([&](const Gaussian &, double distance, double reach) {
            p.from = std::min(p.from, std::max(distance - reach, 0.0));
            p.to = std::max(p.to, distance + reach);
        });
    if (!(p.from < p.to)) {
        p.from = 0;
        p.to = 0;
        return p;
    }
    each([&](const Gaussian &g, double distance, double reach) {
        const int first = std::clamp(int((distance - reach - p.from) / p.width()), 0, bins - 1),
                  last = std::clamp(int((distance + reach - p.from) / p.width()), 0, bins - 1);
        for (int b = first; b <= last; ++b)
            p.sharpness[size_t(b)] = std::max(p.sharpness[size_t(b)], double(g.scale));
    });
    // Neither gaps nor one tiny puff take it all.
    double mean = 0;
    for (double s : p.sharpness)
        mean += s / bins;
    for (double &s : p.sharpness)
        s = std::clamp(s, 0.2 * mean, 5 * mean);
    return p;
}

bool has_terms(const brume_plugin_scene &scene)
{
    return scene.medium->constant > 0 || scene.medium->term_count > 0;
}

}  // namespace

double end_of_terms(const brume_plugin_scene &scene, double gaussians)
{
    const Medium medium = medium_of(scene);
    double farthest = std::max(gaussians, 1.0);
    bool parallel = false;
    for (const brume_plugin_light &light : brume::lights_in(scene)) {
        const auto &p = light.position;
        if (light.type == BRUME_LIGHT_DIRECTIONAL)
            parallel = true;
        else
            farthest = std::max(farthest, std::hypot(double(p[0]), double(p[1]), double(p[2])));
    }
    const vec3 extinction = medium.scattering + medium.absorption;
    const double least = std::min({extinction.x, extinction.y, extinction.z}) * density_at(medium, vec3(0));
    const double opaque = std::min(12 / std::max(least, 1e-30), 1e7);
    return std::max(parallel ? opaque : std::min(opaque, 40 * farthest), 1.01 * gaussians);
}

int wanted_slices(const brume_plugin_scene &scene, const Fineness &fineness)
{
    const int of_terms = has_terms(scene) ? before_gaussians + behind_gaussians : 1;
    if (!scene.gaussians)
        return std::min(2 * fineness.least_slices + of_terms, most_slices);
    const AlongView p = along_view(scene);
    double steps = 0;
    for (double s : p.sharpness)
        steps += s * p.width() * fineness.steps;
    return std::clamp(int(std::ceil(steps)), fineness.least_slices, most_slices - of_terms) + of_terms;
}

void place_slices(const brume_plugin_scene &scene, int slices, std::vector<float> &distances)
{
    const AlongView p = along_view(scene);
    const bool terms = has_terms(scene);
    distances.assign(1, 0.0f);
    auto add = [&](double t) { distances.push_back(std::nextafter(std::max(float(t), distances.back()), 1e30f)); };
    const int before = p.from <= 0 ? 0
                       : terms     ? std::min(before_gaussians, slices / 4)
                                   : 1,
              behind = terms ? std::min(behind_gaussians, slices / 4) : 0, among = slices - before - behind;
    for (int k = 1; k <= before; ++k)
        add(p.from * k / before);
    double all = 0;
    for (double s : p.sharpness)
        all += s;
    double passed = 0;
    int bin = 0;
    for (int k = 1; k <= among; ++k) {
        const double target = all * k / among;
        while (bin < bins - 1 && passed + p.sharpness[size_t(bin)] < target)
            passed += p.sharpness[size_t(bin++)];
        const double share = all > 0 ? (target - passed) / p.sharpness[size_t(bin)] : double(k) / among * bins;
        add(p.to > 0 ? p.from + p.width() * (bin + share) : double(k) / among);
    }
    if (behind > 0) {
        const double from = std::max(double(distances.back()), 1e-3), to = end_of_terms(scene, from);
        // Growing from the last step's width.
        const double first = std::max(from - distances[distances.size() - 2], 1e-3 * from);
        double low = 1, high = 1e3;
        auto reached = [&](double ratio) {
            double t = from, step = first;
            for (int k = 0; k < behind; ++k)
                t += step *= ratio;
            return t;
        };
        for (int i = 0; i < 60; ++i)
            (reached(0.5 * (low + high)) < to ? low : high) = 0.5 * (low + high);
        double t = from, step = first;
        for (int k = 0; k < behind; ++k)
            add(t += step *= low);
    }
}

}  // namespace airlight::maps
