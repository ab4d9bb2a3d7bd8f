#include "scattered/distances.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "maps/slices.h"
#include "scene_maths.hpp"

namespace airlight::scattered {
namespace {

using namespace brume::maths_double;

constexpr int bins = 1024;

// How many of the steps are for each, where there is something of all.
constexpr double of_view = 18, of_lamps = 20, of_gaussians = 26;

// What stands aside of the view counts less and less, so that nothing jumps where the camera turns.
double seen(const brume_plugin_camera &camera, vec3 position, int width, int height)
{
    if (!(position.z < 0))
        return 0.02;
    const int size[2] = {width, height};
    double aside = 0;
    for (int axis = 0; axis < 2; ++axis) {
        const double place = position[axis] / -position.z / camera.tangent_scale[axis] + camera.center[axis];
        aside = std::max(aside, std::abs(2 * place / size[axis] - 1) - 1);
    }
    return std::max(1 / (1 + 10 * aside * aside), 0.02);
}

double power_of(const brume_plugin_light &light)
{
    return std::min((double(light.intensity[0]) + light.intensity[1] + light.intensity[2]) / 3, 1e30);
}

struct Extent {
    double from = 1e30, to = 0;
};

Extent of_the_gaussians(const brume_plugin_scene &scene)
{
    Extent e;
    for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
        const Gaussian g = gaussian_of(given);
        const double distance = length(g.center), reach = 3 / std::max(double(g.scale), 1e-30);
        if (g.center.z - reach > 0)
            continue;
        e.from = std::min(e.from, std::max(distance - reach, 0.0));
        e.to = std::max(e.to, distance + reach);
    }
    return e;
}

// How much of the view's Gaussians' light each bin has, by as many steps as they are small; 1 in all.
void along_gaussians(const brume_plugin_scene &scene, int width, int height, const std::array<double, bins + 1> &at,
                     std::vector<double> &share)
{
    const Medium medium = medium_of(scene);
    const vec3 extinction = medium.scattering + medium.absorption;
    const double most = std::min(std::max({extinction.x, extinction.y, extinction.z}), 1e30);
    share.assign(bins + 1, 0.0);
    for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
        const Gaussian g = gaussian_of(given);
        const double distance = length(g.center), radius = 1 / std::max(double(g.scale), 1e-30),
                     depth = std::min(most * double(g.amplitude) * radius, 2.0), angle = std::min(radius / distance, 1.0);
        auto bin = [&](double t) { return std::upper_bound(at.begin(), at.end(), t) - at.begin() - 1; };
        const auto from = bin(std::max(distance - 2 * radius, 0.0)), to = bin(distance + 2 * radius) + 1;
        if (!(depth > 0) || from >= bins)
            continue;
        const double dense = seen(*scene.camera, g.center, width, height) * depth * angle * angle / radius;
        share[size_t(from)] += dense;
        share[size_t(std::min<std::ptrdiff_t>(to, bins))] -= dense;
    }
    double dense = 0, all = 0;
    for (size_t i = 0; i < bins; ++i) {
        dense += share[i];
        share[i] = std::max(dense, 0.0) * (at[i + 1] - at[i]);
        all += share[i];
    }
    for (double &s : share)
        s = all > 0 ? s / all : 1.0 / bins;
}

}  // namespace

const std::vector<float> &Placement::distances(const brume_plugin_scene &scene, int width, int height, int steps,
                                               double angle)
{
    const bool terms = scene.medium->constant > 0 || scene.medium->term_count > 0;
    const Extent gaussians = of_the_gaussians(scene);
    const double end =
        std::clamp(terms ? maps::end_of_terms(scene, std::min(gaussians.to, 1e9)) : std::min(gaussians.to, 1e9), 1e-3, 1e9);
    std::vector<Lamp> &lamps = lamps_;
    lamps.clear();
    double all = 0, brightest = 0;
    for (const brume_plugin_light &light : brume::lights_in(scene))
        if (light.type != BRUME_LIGHT_DIRECTIONAL)
            brightest = std::max(brightest, power_of(light));
    for (const brume_plugin_light &light : brume::lights_in(scene)) {
        const vec3 position(light.position[0], light.position[1], light.position[2]);
        const double distance = length(position);
        if (light.type == BRUME_LIGHT_DIRECTIONAL || !(distance < end) || !(power_of(light) > 0))
            continue;
        // Lamps that fade leave little by little: one that is switched off is as one that is not there.
        const double bright = std::min(100 * (power_of(light) / brightest), 1.0);
        lamps.push_back({distance, std::max({0.5 * angle * distance, double(light.radius), 1e-4 * end}),
                         bright * seen(*scene.camera, position, width, height)});
        all += lamps.back().weight;
    }
    // t = first (e^u - 1): growing steps, as dense as the sum says.
    const double first = end / 300, most = std::log1p(end / first);
    std::array<double, bins + 1> at{};
    for (int i = 0; i <= bins; ++i)
        at[size_t(i)] = first * std::expm1(most * i / bins);
    std::array<double, bins> dense{};
    for (int i = 0; i < bins; ++i)
        dense[size_t(i)] = of_view / bins;
    if (!lamps.empty()) {
        // The integral of 1 / (|t - D| + width).
        auto up_to = [](const Lamp &lamp, double t) {
            const double x = t - lamp.distance, y = std::log1p(std::abs(x) / lamp.width);
            return x < 0 ? -y : y;
        };
        for (const Lamp &lamp : lamps) {
            const double whole = up_to(lamp, end) - up_to(lamp, 0);
            for (int i = 0; i < bins; ++i)
                dense[size_t(i)] += of_lamps * lamp.weight / std::max(all, 1.0) *
                                    (up_to(lamp, at[size_t(i) + 1]) - up_to(lamp, at[size_t(i)])) / whole;
        }
    }
    if (gaussians.from < gaussians.to) {
        std::vector<double> &of_each = shares_;
        along_gaussians(scene, width, height, at, of_each);
        for (int i = 0; i < bins; ++i)
            dense[size_t(i)] +=
                of_gaussians *
                (0.5 * of_each[size_t(i)] +
                 0.5 * std::max(std::min(at[size_t(i) + 1], gaussians.to) - std::max(at[size_t(i)], gaussians.from), 0.0) /
                     (gaussians.to - gaussians.from));
    }
    double sum = 0;
    for (double d : dense)
        sum += d;
    std::vector<float> &distances = distances_;
    distances.assign(1, 0.0f);
    double passed = 0;
    int bin = 0;
    for (int k = 1; k <= steps; ++k) {
        const double target = sum * k / steps;
        while (bin < bins - 1 && passed + dense[size_t(bin)] < target)
            passed += dense[size_t(bin++)];
        const double share = std::clamp((target - passed) / dense[size_t(bin)], 0.0, 1.0);
        const double t = at[size_t(bin)] + share * (at[size_t(bin) + 1] - at[size_t(bin)]);
        distances.push_back(std::nextafter(std::max(float(t), distances.back()), 1e30f));
    }
    return distances;
}

const std::vector<float> &Placement::peaks(const brume_plugin_scene &scene)
{
    const Medium medium = medium_of(scene);
    const double scattering = std::min((medium.scattering.x + medium.scattering.y + medium.scattering.z) / 3, 1e9);
    std::vector<double> &weights = weights_;
    weights.assign(1 + scene.light_count, 0.0);
    for (uint32_t l = 0; l < scene.light_count; ++l) {
        const brume_plugin_light &light = brume::lights_in(scene)[l];
        const double power = power_of(light);
        if (light.type == BRUME_LIGHT_DIRECTIONAL) {
            weights[0] += power;
            continue;
        }
        const vec3 position(light.position[0], light.position[1], light.position[2]);
        double density = density_at(medium, position);
        for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
            const Gaussian g = gaussian_of(given);
            const double x = std::min(g.scale * length(g.center - position), 30.0);
            density += double(g.amplitude) * std::exp(-x * x);
        }
        weights[1 + l] = power * std::min(scattering * density, 1e9);
    }
    const double most = *std::max_element(weights.begin(), weights.end());
    if (!(most > 0))
        weights[0] = 1;
    const double scale = most > 0 ? 1 / most : 1;
    std::vector<float> &peaks = peaks_;
    peaks.clear();
    for (double w : weights)
        peaks.push_back(float(w * scale));
    peaks[0] = std::max(peaks[0], 1e-12f);
    return peaks;
}

}  // namespace airlight::scattered
