#pragma once
// Monte Carlo of a sun above a medium that lies in layers over a ground: backward from a point and a direction, each vertex
// lit by the sun through what is above it. Depths are all that matters of such a medium.
#include "lamp_tracer.h"

namespace lamp_tracer {

struct Slab {
    double albedo;  // of scattering
    double g;
    double depth;      // to the ground, straight down
    double cosine;     // of the sun's slant
    double ground;     // albedo of the ground
    bool sky = false;  // an even sky of radiance 1 / pi and no sun
};

inline double peaked(double g, double cosine)
{
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

// Radiance toward `at`, a depth from the top, from direction d (z up, unit), of light that was scattered `least` times or
// more, for an irradiance across the rays of 1; or of a sky that gives level ground 1.
inline double trace_slab(const Slab &slab, double at, vec3 d, int least, Random &random)
{
    const double slant = std::sqrt(std::max(1 - slab.cosine * slab.cosine, 0.0));
    const vec3 to_sun(slant, 0, slab.cosine);
    double weight = 1, sum = 0;
    for (int order = 0;; ++order) {
        const double flight = -std::log(random()), z = at - flight * d.z;  // depth there
        if (z <= 0) {
            if (slab.sky && order >= least)
                sum += weight / pi;
            break;
        }
        if (z >= slab.depth) {
            at = slab.depth;
            weight *= slab.ground;
            if (weight == 0)
                break;
            if (!slab.sky && order >= least)
                sum += weight / pi * slab.cosine * std::exp(-at / slab.cosine);
            d = vec3(0, 0, 0);
            const double r = std::sqrt(random()), phi = 2 * pi * random();
            d = vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r));
        } else {
            at = z;
            weight *= slab.albedo;
            if (!slab.sky && order + 1 >= least)
                sum += weight * peaked(slab.g, -glm::dot(d, -to_sun)) * std::exp(-at / slab.cosine);
            d = turned(d, sampled_cosine(slab.g, random), 2 * pi * random());
        }
        if (weight < 0.05) {
            if (random() > 0.2)
                break;
            weight *= 5;
        }
    }
    return sum;
}

struct Traced {
    double mean;
    double deviation;
};

// Diffuse irradiance of a plane at this depth whose normal is n.
inline Traced trace_slab_irradiance(const Slab &slab, double at, vec3 n, int paths, uint64_t seed)
{
    Random random(seed);
    double sum = 0, square = 0;
    for (int i = 0; i < paths; ++i) {
        const double c = std::sqrt(random());
        const double v = pi * trace_slab(slab, at, turned(n, c, 2 * pi * random()), 0, random);
        sum += v;
        square += v * v;
    }
    const double mean = sum / paths;
    return {mean, std::sqrt(std::max(square / paths - mean * mean, 0.0) / paths)};
}

}  // namespace lamp_tracer
