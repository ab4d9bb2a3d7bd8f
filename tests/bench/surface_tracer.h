#pragma once
// Monte Carlo of what a point lamp gives a black plane below it through a homogeneous medium that fills the space above.
#include "lamp_tracer.h"

namespace lamp_tracer {

// A ring of the plane, by the cosine under which the lamp shines on it.
struct Ring {
    double cosine;     // its middle
    double clear;      // flux in clear air, for an intensity of 1
    double factor;     // flux in the medium over that in clear air
    double deviation;  // of the factor, absolute
};

constexpr std::array<double, 9> ring_edges{1, 0.94, 0.82, 0.66, 0.5, 0.34, 0.2, 0.1, 0.05};

// Lengths in units of 1 / s' = 1 / (sigma_a + (1 - g) sigma_s); absorption: sigma_a / s'.
inline std::vector<Ring> trace_onto_plane(double g, double absorption, double height, int photons, uint64_t seed)
{
    constexpr size_t rings = ring_edges.size() - 1;
    const double scattering = (1 - absorption) / (1 - g), limit = 12 + 8 * height, nearest = 0.01 * height,
                 span = std::log(limit / nearest);
    std::array<double, rings> sum{}, square{}, now{};
    Random random(seed);
    for (int n = 0; n < photons; ++n) {
        vec3 p(0, 0, height), d = uniform_direction(random);
        // Half of the first scatterings are spread evenly over the logarithm of their distance: few would be near the lamp.
        double flight = random() < 0.5 ? -std::log(random()) / scattering : nearest * std::exp(span * random());
        const double likely = 0.5 * scattering * std::exp(-scattering * flight) +
                              (flight > nearest && flight < limit ? 0.5 / (span * flight) : 0);
        double weight = scattering * std::exp(-scattering * flight) / likely;
        for (int order = 0; glm::dot(p, p) < limit * limit; ++order) {
            if (order > 0) {
                d = turned(d, sampled_cosine(g, random), 2 * pi * random());
                flight = -std::log(random()) / scattering;
            }
            const double to_plane = d.z < 0 ? -p.z / d.z : 1e30;
            // What falls on the plane counts by what is expected to.
            if (order > 0 && to_plane < 1e30) {
                const vec3 x = p + to_plane * d;
                const double cosine = height / std::sqrt(x.x * x.x + x.y * x.y + height * height);
                for (size_t i = 0; i < rings; ++i)
                    if (cosine <= ring_edges[i] && cosine > ring_edges[i + 1])
                        now[i] += weight * std::exp(-(scattering + absorption) * to_plane);
            }
            if (to_plane <= flight)
                break;
            p += flight * d;
            weight *= std::exp(-absorption * flight);
            if (weight < 0.1) {
                if (random() > 0.2)
                    break;
                weight *= 5;
            }
        }
        for (size_t i = 0; i < rings; ++i) {
            sum[i] += now[i];
            square[i] += now[i] * now[i];
            now[i] = 0;
        }
    }
    std::vector<Ring> out;
    for (size_t i = 0; i < rings; ++i) {
        const double from = ring_edges[i + 1], to = ring_edges[i], clear = 2 * pi * (to - from),
                     unit = 4 * pi / photons / clear;
        double straight = 0;
        for (int k = 0; k < 32; ++k)
            straight += std::exp(-(scattering + absorption) * height / (from + (to - from) * (k + 0.5) / 32)) / 32;
        out.push_back({0.5 * (from + to), clear, straight + unit * sum[i], unit * std::sqrt(square[i])});
    }
    return out;
}

}  // namespace lamp_tracer
