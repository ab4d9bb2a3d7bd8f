// slab_calibration [--quick]: shaders/lib/slab_field.glsl, suns and sky above fog that lies in layers, against Monte Carlo:
// what the ground and walls on it receive, and the radiance that fog has been lit to. Seeded; the same on every run.
#include <cstdio>
#include <cstring>
#include <string>

#include "maths.hpp"
#include "slab_tracer.h"

namespace {

using namespace lamp_tracer;
namespace f64 = brume::maths_double;
using f64::vec2;

struct Errors {
    double square = 0, worst = 0, noise = 0;
    int count = 0;

    void add(double error, double deviation)
    {
        square += error * error;
        noise += deviation * deviation;
        worst = std::max(worst, std::abs(error));
        ++count;
    }
    double rms() const { return std::sqrt(square / count); }
};

const double depths[] = {0.1, 0.3, 1, 3, 10};  // (1 - g) sigma_t times the layer's thickness

f64::SlabField field(const Slab &slab, double at)
{
    return f64::slab_field(slab.albedo * vec2(at, slab.depth), (1 - slab.albedo) * vec2(at, slab.depth), slab.g,
                           slab.sky ? 0 : 1, slab.cosine, slab.ground);
}

// Relative to clear air.
Errors onto_ground(double g, double albedo, double cosine, bool sky, int paths)
{
    Errors errors;
    for (double ground : {0.0, 0.4, 0.8})
        for (double reduced : depths) {
            const Slab slab{albedo, g, reduced / (1 - g), cosine, ground, sky};
            const double lit = sky ? 0 : 1;
            const f64::SlabStreams streams = f64::slab_streams(slab.albedo * slab.depth, (1 - slab.albedo) * slab.depth, g,
                                                               sky ? 0 : f64::low_sun(cosine), lit, cosine, ground);
            const double down = f64::slab_ground(streams, lit, ground);
            const Traced traced = trace_slab_irradiance(slab, slab.depth, {0, 0, 1}, paths, 1);
            const double clear = sky ? 1 : cosine, straight = sky ? 0 : cosine * std::exp(-slab.depth / cosine);
            errors.add((down + cosine * streams.straight - traced.mean - straight) / clear, traced.deviation / clear);
        }
    return errors;
}

// On black ground, over the sun's irradiance across its rays: n horizontal at this angle from the sun's side, or n to the
// sun.
Errors onto_walls(double g, double albedo, double cosine, int paths)
{
    Errors errors;
    const double slant = std::sqrt(1 - cosine * cosine);
    const vec3 to_sun(slant, 0, cosine), normals[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, to_sun};
    for (const vec3 &n : normals)
        for (double reduced : {0.1, 0.3, 1.0, 3.0}) {
            const Slab slab{albedo, g, reduced / (1 - g), cosine, 0};
            const f64::SlabStreams streams =
                f64::slab_streams(albedo * slab.depth, (1 - albedo) * slab.depth, g, f64::low_sun(cosine), 1, cosine, 0);
            const double to = glm::dot(n, to_sun), faced = std::max(to, 0.0);
            const double model = f64::onto_surface(f64::slab_ground(streams, 1, 0), f64::slab_side(streams),
                                                   f64::below_sun(n.z, to, f64::SunSlant{f64::vec3(0, 0, 1), cosine})) +
                                 faced * streams.straight;
            const Traced traced = trace_slab_irradiance(slab, slab.depth, n, paths, 1);
            errors.add(model - traced.mean - faced * std::exp(-slab.depth / cosine), traced.deviation);
        }
    return errors;
}

// Through the whole layer above black ground, from its top and from its ground: the model's of orders two and more beside
// what is scattered once; relative to all, or with `once` what is missing without them.
void add_radiance(double g, double albedo, double cosine, int paths, Errors &all, Errors &once)
{
    const vec3 to_sun(std::sqrt(1 - cosine * cosine), 0, cosine);
    for (double reduced : {0.3, 1.0, 3.0, 10.0})
        for (double up : {-0.9, -0.3, 0.3, 0.9})
            for (double turn : {0.0, 0.5, 1.0}) {
                const Slab slab{albedo, g, reduced / (1 - g), cosine, 0};
                const double aside = std::sqrt(1 - up * up), at = up < 0 ? 0 : slab.depth;
                const vec3 d(aside * std::cos(pi * turn), aside * std::sin(pi * turn), up);
                const double turned_by = glm::dot(d, to_sun);
                Random random(3);
                double sum = 0, square = 0;
                for (int i = 0; i < paths; ++i) {
                    const double v = trace_slab(slab, at, d, 2, random);
                    sum += v / paths;
                    square += v * v / paths;
                }
                constexpr int steps = 200;
                double more = 0, single = 0;
                for (int i = 0; i < steps; ++i) {
                    const double t = slab.depth / std::abs(up) * (i + 0.5) / steps,
                                 width = slab.depth / std::abs(up) / steps, z = at - t * up,
                                 straight = std::exp(-z / cosine);
                    more += albedo * f64::slab_source(field(slab, z), g, straight, turned_by, up) * std::exp(-t) * width;
                    single += albedo * peaked(g, turned_by) * straight * std::exp(-t) * width;
                }
                const double exact = sum + single, unit = exact + 0.003;
                all.add((more + single - exact) / unit, std::sqrt((square - sum * sum) / paths) / unit);
                once.add((single - exact) / unit, 0);
            }
}

}  // namespace

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > (quick ? 2 : 1)) {
        fprintf(stderr, "slab_calibration: %s: expected --quick or nothing\n", argv[1]);
        return 2;
    }
    const int paths = quick ? 500 : 6000;
    printf(
        "What level ground receives below a layer of (1 - g) sigma_t z from .1 to 10, over what it does in clear air; "
        "ground "
        "albedos 0, .4,\n.8: errors, absolute. What walls on black ground receive of a sun, facing it, aside of it, turned "
        "away and across its rays,\nup to (1 - g) sigma_t z of 3, over its irradiance across its rays. Radiance of the "
        "layer above black ground, seen from its top and from the "
        "ground, "
        "relative to itself plus\n.003 of the sun's irradiance.\n"
        "    g  albedo  light         ground: rms   worst  Monte Carlo  walls: rms   worst  Monte Carlo  radiance: rms  "
        "scattered once: rms  Monte Carlo\n");
    for (double g : {0.0, 0.5, 0.85})
        for (double albedo : {1.0, 0.95, 0.7})
            for (double cosine : {1.0, 0.5, 0.2, 0.0}) {
                const bool sky = cosine == 0;
                const Errors ground = onto_ground(g, albedo, sky ? 1 : cosine, sky, paths);
                const std::string light = sky ? "sky" : "sun, cosine " + std::to_string(cosine).substr(0, 3);
                printf("%5.2f %7.2f  %-15s %9.3f %7.3f %12.3f", g, albedo, light.c_str(), ground.rms(), ground.worst,
                       std::sqrt(ground.noise / ground.count));
                if (!sky) {
                    const Errors walls = onto_walls(g, albedo, cosine, paths);
                    printf(" %11.3f %7.3f %12.3f", walls.rms(), walls.worst, std::sqrt(walls.noise / walls.count));
                    Errors all, once;
                    add_radiance(g, albedo, cosine, paths / 2, all, once);
                    printf(" %14.3f %19.3f %12.3f", all.rms(), once.rms(), std::sqrt(all.noise / all.count));
                }
                printf("\n");
                fflush(stdout);
            }
}
