// lamp_arrival [--quick]: what of a lamp's light arrives scattered, by Monte Carlo, against the arrived fraction of kernel
// `calibrated`, which is that of walls. Seeded; the same on every run.
//
// A lamp is a point that shines as much in all directions, in an endless medium or before a black plane through it across
// the view. What a camera at a distance of 1 receives within 50 degrees of the lamp, over what it has of the lamp in clear
// air, comes from photons that cross the sphere of that radius: each counts by 1 / cosine of its way against the radius.
#include <cmath>
#include <cstdio>
#include <cstring>

#include "lamp_tracer.h"

namespace {

using namespace lamp_tracer;

constexpr double widest = 0.87;     // what spread.cpp tells apart
constexpr double near_axis = 0.94;  // cosine of where cameras stand that see the plane from the front

struct Arrived {
    double all = 0;
    double once = 0;
    double net = 0;  // flux through the sphere, of the lamp's
};

Arrived trace(double g, double albedo, double depth, bool plane, int photons, uint64_t seed)
{
    const double extinction = depth / albedo, beyond = std::min(40 / ((1 - g) * depth), 60.0) + 4;
    Random random(seed);
    Arrived arrived;
    // Of photons into the half space before the plane twice as many come near the axis.
    const double unit = plane ? 1 / (1 - near_axis) / photons : 1.0 / photons;
    for (int i = 0; i < photons; ++i) {
        vec3 x(0), d = uniform_direction(random);
        if (plane)
            d.z = std::abs(d.z);
        double weight = 1;
        for (int scatterings = 0; glm::length(x) < beyond; ++scatterings) {
            const double flight = -std::log(random()) / extinction, along = glm::dot(x, d),
                         under = along * along - glm::dot(x, x) + 1;
            for (double t : {-along - std::sqrt(std::max(under, 0.0)), -along + std::sqrt(std::max(under, 0.0))}) {
                if (under <= 0 || t <= 0 || t > flight || (plane && (x + t * d).z < near_axis))
                    continue;
                const double cosine = along + t;
                arrived.net += unit * std::copysign(weight, cosine);
                if (scatterings == 0 || cosine < std::cos(widest))
                    continue;
                arrived.all += unit * weight / cosine;
                arrived.once += scatterings == 1 ? unit * weight / cosine : 0;
            }
            x += flight * d;
            weight *= albedo;
            if (plane && x.z < 0)
                break;
            if (weight < 0.1) {
                if (random() > 0.5)
                    break;
                weight *= 2;
            }
            d = turned(d, sampled_cosine(g, random), 2 * pi * random());
        }
    }
    return arrived;
}

// What is scattered once, by quadrature: dt / d^2 = dtheta / sin(gamma), theta being the angle by which light is turned.
double once(double g, double albedo, double depth)
{
    constexpr int steps = 600;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double gamma = widest * (i + 0.5) / steps, theta = gamma + (pi - gamma) * (j + 0.5) / steps,
                         way = (std::sin(theta - gamma) + std::sin(gamma)) / std::sin(theta),
                         q = 1 + g * g - 2 * g * std::cos(theta);
            sum += (1 - g * g) / (4 * pi * q * std::sqrt(q)) * std::exp(-depth / albedo * way) * (pi - gamma);
        }
    return 2 * pi * depth * sum * widest / (double(steps) * steps);
}

double wall(double g, double albedo, double depth)
{
    return std::exp(depth - depth / albedo) * (1 / (1 + 0.45 * std::pow((1 - g) * depth, 1.2)) - std::exp(-depth));
}

}  // namespace

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > (quick ? 2 : 1)) {
        fprintf(stderr, "lamp_arrival: %s: expected --quick or nothing\n", argv[1]);
        return 2;
    }
    const int photons = quick ? 20000 : 100000;
    printf("What of a lamp's light arrives scattered, within 50 degrees of it, over what the filter takes, T_tot - e^-tau. "
           "The net flux\n"
           "is 1 in media that do not absorb; what is scattered once is held against quadrature.\n"
           "    g  albedo  tau_s    filter  endless: over it  net flux  once, quadrature    black plane: over it\n");
    for (double g : {0.0, 0.5, 0.8, 0.9, 0.95})
        for (double albedo : {1.0, 0.88})
            for (double depth : {0.1, 0.4, 1.2, 3.6}) {
                const double filter = wall(g, albedo, depth);
                const Arrived endless = trace(g, albedo, depth, false, photons / 4, 1),
                              plane = trace(g, albedo, depth, true, photons, 2);
                printf("%5.2f %7.2f %6.1f %9.3f %9.3f %7.2f %9.3f %6.3f %11.3f %9.3f %9.2f\n", g, albedo, depth, filter,
                       endless.all, endless.all / filter, endless.net, endless.once, once(g, albedo, depth), plane.all,
                       plane.all / filter);
                fflush(stdout);
            }
}
