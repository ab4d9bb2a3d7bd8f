#pragma once
// Monte Carlo of the directions from which a point lamp's light arrives that an endless homogeneous medium scattered twice
// and more.
#include "lamp_tracer.h"

namespace lamp_tracer {

constexpr int arrival_bins = 36;  // of the angle from the lamp, 5 degrees each

struct Arrival {
    double depth;                            // sigma_t r
    std::array<double, arrival_bins> often;  // radiance times r^2 / I
};

// absorption: sigma_a / sigma_t. Shells are +-5 %. As in trace_endless(), what comes back from beyond a sphere around all is
// even.
inline std::vector<Arrival> trace_arrivals(double g, double absorption, const std::vector<double> &depths, int photons,
                                           uint64_t seed)
{
    const double reduced = absorption + (1 - g) * (1 - absorption), edge = 30 / reduced;
    std::vector<Arrival> all;
    for (double depth : depths)
        all.push_back({depth, {}});
    Random random(seed);
    for (int n = 0; n < photons; ++n) {
        vec3 p(0), d = uniform_direction(random);
        double weight = 1;
        for (int order = 0; glm::dot(p, p) < edge * edge && weight > 1e-4; ++order) {
            const double flight = -std::log(random());
            const double b = glm::dot(p, d), h2 = glm::dot(p, p) - b * b;
            for (size_t i = 0; order > 1 && i < all.size(); ++i) {
                const double inner = 0.95 * depths[i], outer = 1.05 * depths[i];
                if (h2 >= outer * outer)
                    continue;
                const double far = std::sqrt(outer * outer - h2),
                             near = h2 < inner * inner ? std::sqrt(inner * inner - h2) : 0;
                for (auto [from, to] : {std::pair(-far - b, -near - b), {near - b, far - b}}) {
                    from = std::max(from, 0.0);
                    to = std::min(to, flight);
                    if (to <= from)
                        continue;
                    const vec3 at = p + (from + (to - from) * random()) * d;
                    const double angle = std::acos(std::clamp(glm::dot(glm::normalize(at), d), -1.0, 1.0));
                    all[i].often[size_t(std::min(int(angle / pi * arrival_bins), arrival_bins - 1))] += weight * (to - from);
                }
            }
            p += flight * d;
            weight *= 1 - absorption;
            d = turned(d, sampled_cosine(g, random), 2 * pi * random());
        }
    }
    const double kappa = std::sqrt(3 * absorption * reduced), out = edge + 0.7104 / reduced;
    for (Arrival &arrival : all) {
        const double r = arrival.depth, volume = 4 / 3.0 * pi * r * r * r * (std::pow(1.05, 3) - std::pow(0.95, 3));
        const double beyond = kappa * out < 1e-6
                                  ? 3 * reduced / out
                                  : 3 * reduced * std::sinh(kappa * r) / r * std::exp(-kappa * out) / std::sinh(kappa * out);
        for (int k = 0; k < arrival_bins; ++k) {
            const double solid = 2 * pi * (std::cos(pi * k / arrival_bins) - std::cos(pi * (k + 1) / arrival_bins));
            double &v = arrival.often[size_t(k)];
            v = r * r * (4 * pi * v / photons / volume / solid + beyond / (4 * pi));
        }
    }
    return all;
}

// What a lobe of Phong sees of it, theta between its axis and the lamp.
inline double lobe_of_arrival(const Arrival &arrival, double exponent, double theta)
{
    constexpr int steps = 8, turns = 64;
    double sum = 0;
    for (int k = 0; k < arrival_bins * steps; ++k) {
        const double gamma = pi * (k + 0.5) / arrival_bins / steps;
        double around = 0;
        for (int j = 0; j < turns; ++j) {
            const double c =
                std::cos(gamma) * std::cos(theta) + std::sin(gamma) * std::sin(theta) * std::cos(pi * (j + 0.5) / turns);
            around += c > 0 ? std::pow(c, exponent) : 0;
        }
        sum += arrival.often[size_t(k / steps)] * std::sin(gamma) * around * 2 * pi / turns * pi / arrival_bins / steps;
    }
    return (exponent + 1) / (2 * pi) * sum;
}

}  // namespace lamp_tracer
