// The Monte Carlo behind the lamps' higher orders against closed forms, and what it says of the model.
#include <gtest/gtest.h>

#include "../bench/lamp_tracer.h"
#include "maths.hpp"

namespace f64 = brume::maths_double;
using lamp_tracer::Endless;
using lamp_tracer::pi;
using lamp_tracer::Shell;

namespace {

// Fluence of what has scattered once at x in an endless medium, I = 1, lengths in 1 / s': all pairs of ways, by the angle u
// by which light is turned and how it is shared between the lamp's end and the point's.
double scattered_once(double g, double albedo, double x)
{
    const double absorption = 1 / albedo - 1, unit = 1 / (absorption + 1 - g), depth = x * unit / albedo;
    const int pieces = 400;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const double w = (i + 0.5) / pieces, u = pi * w * w, du = 2 * pi * w / pieces;
        double inner = 0;
        for (int j = 0; j < pieces; ++j)
            inner += std::exp(-depth * std::cos(u * ((j + 0.5) / pieces - 0.5)) / std::cos(0.5 * u)) * u / pieces;
        sum += 2 * pi * f64::henyey_greenstein(g, std::cos(u)) * inner * du;
    }
    return unit * sum / x;
}

}  // namespace

TEST(LampTracer, FirstScatteringIsThatOfQuadrature)
{
    for (double g : {0.0, 0.5}) {
        double excess = 0;
        int count = 0;
        for (const Endless &m : lamp_tracer::trace_endless(g, {1, 0.8}, {0.04, 0.16, 0.5, 1.2}, 6000, 1))
            for (const Shell &s : m.shells) {
                const double ratio = s.once / scattered_once(g, m.albedo, s.radius);
                EXPECT_NEAR(ratio, 1, 0.2) << "g " << g << " albedo " << m.albedo << " at " << s.radius;
                excess += ratio - 1;
                ++count;
            }
        EXPECT_NEAR(excess / count, 0, 0.06) << g;
    }
}

TEST(LampTracer, FluxIsKeptAndFarAwayIsDiffusion)
{
    for (double g : {0.0, 0.7}) {
        const auto shells = lamp_tracer::trace_endless(g, {1}, {0.1, 0.5, 2, 6}, 6000, 2)[0].shells;
        for (const Shell &s : shells) {
            const double through = s.radius * s.radius * s.fluence * s.moments[0] + std::exp(-s.radius / (1 - g));
            EXPECT_NEAR(through, 1, 0.06) << "g " << g << " at " << s.radius;
        }
        EXPECT_NEAR(shells.back().fluence * shells.back().radius, 3, 0.15);
    }
}

TEST(LampTracer, TheModelIsWithinItsNoise)
{
    for (double g : {0.0, 0.5, 0.85})
        for (const Endless &m : lamp_tracer::trace_endless(g, {1, 0.95}, {0.1, 0.4, 1.2, 3}, 4000, 3))
            for (const Shell &s : m.shells) {
                const double r = s.radius / (1 / m.albedo - g), x = s.radius;
                const f64::Rescattered model = f64::rescattered(r, (1 / m.albedo - 1) * r, g);
                EXPECT_NEAR(model.fluence / (x * x * s.fluence), 1, 0.03 + 4 * s.deviation)
                    << "g " << g << " albedo " << m.albedo << " at " << x;
                EXPECT_NEAR(model.cosine, s.moments[0], 0.02 + 4 * s.deviation)
                    << "g " << g << " albedo " << m.albedo << " at " << x;
                const double k = std::sqrt(model.cosine);
                EXPECT_NEAR(k * k * k, s.moments[1], 0.08 + 4 * s.deviation)
                    << "g " << g << " albedo " << m.albedo << " at " << x;
            }
}
