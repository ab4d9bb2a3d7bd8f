// surface_calibration [--quick]: shaders/lib/surface.glsl against Monte Carlo: how far off is what a black plane receives of
// a lamp through a medium, by the angle under which the lamp shines on it. Seeded; the same on every run.
#include <cstdio>
#include <cstring>

#include "surface_tables.h"
#include "surface_tracer.h"

namespace {

using namespace lamp_tracer;

// Mean of a method over a ring.
double mean_share(int method, double g, double absorption, double height, size_t ring)
{
    brume::maths_double::SurfaceSettings settings{};
    settings.method = method;
    const double scattering = (1 - absorption) / (1 - g), from = ring_edges[ring + 1], to = ring_edges[ring];
    double sum = 0;
    for (int i = 0; i < 16; ++i) {
        const double c = from + (to - from) * (i + 0.5) / 16, x = height / c;
        sum += share_by_method(settings, surface_tables::of(method), scattering * x, absorption * x, g, c) / 16;
    }
    return sum;
}

}  // namespace

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > (quick ? 2 : 1)) {
        fprintf(stderr, "surface_calibration: %s: expected --quick or nothing\n", argv[1]);
        return 2;
    }
    printf("What a plane receives over what it does in clear air; lamp at s' h = .01 to 3, s' r up to 8, cosines from .1. "
           "Errors "
           "relative to the\n"
           "share plus .03, of method calibrated and the published ones. As if nothing changed, and as if what leaves the "
           "beam were "
           "lost: the same errors of 1 and of e^(-sigma_t r).\n"
           "    g sigma_a/s'  points     rms   worst  sun: rms  psf: rms  nothing: rms  lost: rms  Monte Carlo\n");
    for (double g : {0.0, 0.4, 0.7, 0.85, 0.95})
        for (double absorption : {0.0, 0.02, 0.1, 0.3, 0.7}) {
            double square = 0, worst = 0, sun = 0, psf = 0, nothing = 0, lost = 0, noise = 0;
            int points = 0;
            for (double height : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0}) {
                const int photons = quick ? 2000 : int(600000 * (1 - 0.9 * g));
                const auto rings = trace_onto_plane(g, absorption, height, photons, 1);
                for (size_t i = 0; i + 1 < rings.size(); ++i) {
                    const double x = height / rings[i].cosine, unit = rings[i].factor + 0.03;
                    if (x > 8)
                        continue;
                    auto error = [&](int method) {
                        return (mean_share(method, g, absorption, height, i) - rings[i].factor) / unit;
                    };
                    const double e = error(brume::maths_double::method_calibrated);
                    sun += std::pow(error(brume::maths_double::method_sun), 2);
                    psf += std::pow(error(brume::maths_double::method_psf), 2);
                    square += e * e;
                    worst = std::max(worst, std::abs(e));
                    nothing += std::pow((1 - rings[i].factor) / unit, 2);
                    lost += std::pow((std::exp(-((1 - absorption) / (1 - g) + absorption) * x) - rings[i].factor) / unit, 2);
                    noise += std::pow(rings[i].deviation / unit, 2);
                    ++points;
                }
            }
            auto rms = [&](double sum) { return std::sqrt(sum / points); };
            printf("%5.2f %10.2f %7d %7.3f %7.3f %9.3f %9.3f %13.3f %10.3f %12.3f\n", g, absorption, points, rms(square),
                   worst, rms(sun), rms(psf), rms(nothing), rms(lost), rms(noise));
            fflush(stdout);
        }
}
