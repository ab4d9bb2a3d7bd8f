// surface_accuracy [--quick]: what the methods of effect surface say that surfaces reflect of light scattered once, against
// quadrature (plugins/surface/hemisphere.h), over random media, lamps and views; of light scattered any number of times,
// against paths; and which optical depth serves where a cloud is on one side. Seeded; the same on every run.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <random>

#include "surface/hemisphere.h"
#include "surface_arrival.h"
#include "surface_tables.h"

namespace {

using namespace surface_reference;
using brume::airlight::ReferenceScene;
using std::numbers::pi;

struct Figures {
    std::vector<double> errors;
    double at(double share)
    {
        if (errors.empty())
            return 0;
        std::sort(errors.begin(), errors.end());
        return errors[std::min(errors.size() - 1, size_t(share * double(errors.size())))];
    }
};

vec3 direction(std::mt19937 &random)
{
    std::uniform_real_distribution<double> u(0, 1);
    const double z = 2 * u(random) - 1, phi = 2 * pi * u(random), s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

vec3 beside(vec3 axis, double cosine, std::mt19937 &random)
{
    vec3 u = direction(random);
    u = glm::normalize(u - glm::dot(u, axis) * axis);
    return cosine * axis + std::sqrt(1 - cosine * cosine) * u;
}

struct Kind {
    const char *name;
    double exponent, roughness;  // of which one counts; neither: Lambert
};

constexpr Kind kinds[] = {{"Lambert", 0, 0},  {"Phong 5", 5, 0},  {"Phong 25", 25, 0}, {"Phong 100", 100, 0},
                          {"GGX .1", 0, 0.1}, {"GGX .3", 0, 0.3}, {"GGX .6", 0, 0.6},  {"GGX 1", 0, 1}};

struct Sample {
    ReferenceScene scene;
    Surface surface;
    Light lamp;
    Material material;
    Reflection reflection;
};

// What a method gives beside own e^-T.
double brought(const Sample &s, int method, double own, double kept)
{
    SurfaceSettings settings{};
    settings.method = method;
    settings.material = 2;
    const Medium &medium = s.scene.medium;
    const Change change = change_by_light(medium, lamp_colours(medium), settings, s.surface, s.lamp, s.material,
                                          shine_of(s.surface, s.material), terms_to_light(medium, s.lamp, s.surface.point),
                                          surface_tables::of(method));
    return becomes(change, vec3(own)).x - own * kept;
}

// The paper's coefficients of depth 1 at another.
double brought_by_one(const Sample &s, double depth)
{
    const vec3 to_lamp = glm::normalize(s.lamp.position - s.surface.point);
    const double as_published = depth * std::exp(1 - depth), irradiance = s.lamp.intensity.x / 9;
    const bool glossy = s.material.specular.x > 0;
    return irradiance * as_published *
           psf_lobe(surface_tables::degrees(), 1, glossy ? s.material.exponent : 1, glm::dot(s.reflection.peak, to_lamp));
}

void once(int count)
{
    printf("Light scattered once that surfaces reflect: relative error, median and 95 %%, of %d geometries each; T .01 to 8 "
           "by its "
           "logarithm,\ng 0, lamps all around, grazing: within 8 degrees of the surface's horizon. psf at 1: with the "
           "published "
           "coefficients, which are those of T = 1.\n"
           "surface     lamp            sun             psf        psf at 1\n",
           count);
    for (const Kind &kind : kinds) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> u(0, 1);
        Figures figures[3][3];
        for (int i = 0; i < count; ++i) {
            const double depth = 0.01 * std::pow(800, u(random));
            Sample s;
            s.surface = Surface{true, vec3(0, 0, -2), beside(vec3(0, 0, 1), 0.1 + 0.9 * u(random), random)};
            const bool grazing = i % 3 == 0;
            const double cosine = grazing ? 0.14 * (2 * u(random) - 1) : 2 * u(random) - 1;
            const vec3 to_lamp = beside(s.surface.normal, cosine, random), view(0, 0, 1);
            s.lamp = Light{s.surface.point + 3.0 * to_lamp, 0, vec3(0), 0, vec3(1), 0, light_point, 0};
            s.scene.medium.constant = 1;
            s.scene.medium.scattering = vec3(depth / 3);
            const bool lambert_kind = kind.exponent == 0 && kind.roughness == 0;
            const vec3 mirrored = 2 * glm::dot(s.surface.normal, view) * s.surface.normal - view;
            s.material = lambert_kind ? Material{true, vec3(1), vec3(0), false, 1}
                                      : Material{true, vec3(0), vec3(1), false,
                                                 kind.exponent > 0 ? kind.exponent : phong_exponent(kind.roughness)};
            s.reflection = lambert_kind        ? lambert(s.surface.normal)
                           : kind.exponent > 0 ? phong(mirrored, kind.exponent)
                                               : ggx(s.surface.normal, view, kind.roughness);
            Light seen = s.lamp;
            seen.position = 3.0 * to_lamp;
            s.scene.lights = {&seen, 1};
            const double want = reflected_once(s.scene, s.reflection).x, kept = std::exp(-depth);
            const double own = cosine > 0 ? s.reflection.of(to_lamp) / 9 : 0;
            const double got[] = {brought(s, method_sun, own, kept), brought(s, method_psf, own, kept),
                                  brought_by_one(s, depth)};
            for (int m = 0; m < 3; ++m)
                figures[grazing ? 1 : cosine > 0 ? 0 : 2][m].errors.push_back(std::abs(got[m] / want - 1));
        }
        for (int where = 0; where < 3; ++where) {
            printf("%-11s %-8s", kind.name, where == 0 ? "before" : where == 1 ? "grazing" : "behind");
            for (Figures &f : figures[where])
                printf("  %6.3f %6.3f", f.at(0.5), f.at(0.95));
            printf("\n");
        }
        fflush(stdout);
    }
}

// Once by quadrature, with the medium's own phase function, and more often by paths.
void often(int photons)
{
    printf("\nLight scattered any number of times that a lobe of Phong sees in an endless medium, T .1 to 8, its axis 0 to "
           "135 degrees "
           "from the lamp:\nmean of the methods over the paths', and rms error relative to it.\n"
           "    g sigma_a/sigma_t    n  once only    calibrated           sun           psf\n");
    const std::vector<double> depths{0.1, 0.3, 1, 3, 8};
    for (double g : {0.0, 0.7, 0.9})
        for (double absorption : {0.0, 0.1}) {
            const auto arrivals = lamp_tracer::trace_arrivals(g, absorption, depths, photons, 1);
            for (double exponent : {1.0, 5.0, 25.0, 100.0}) {
                double mean[3] = {}, square[3] = {}, single = 0;
                int count = 0;
                for (const auto &arrival : arrivals)
                    for (double theta : {0.0, pi / 6, pi / 3, pi / 2, 3 * pi / 4}) {
                        Sample s;
                        s.surface = Surface{true, vec3(0, 0, -2), vec3(0, 0, 1)};
                        const vec3 to_lamp(std::sin(theta), 0, std::cos(theta));
                        s.lamp = Light{s.surface.point + to_lamp, 0, vec3(0), 0, vec3(1), 0, light_point, 0};
                        s.scene.medium.constant = 1;
                        s.scene.medium.scattering = vec3((1 - absorption) * arrival.depth);
                        s.scene.medium.absorption = vec3(absorption * arrival.depth);
                        s.scene.medium.asymmetry = g;
                        s.scene.medium.phase = vec4(g, 0, 0, 0);
                        s.material = Material{true, vec3(0), vec3(1), false, exponent};
                        s.reflection = phong(vec3(0, 0, 1), exponent);
                        Light seen = s.lamp;
                        seen.position = to_lamp;
                        s.scene.lights = {&seen, 1};
                        const double once = reflected_once(s.scene, s.reflection, 1, 1e-4).x,
                                     want = once + lamp_tracer::lobe_of_arrival(arrival, exponent, theta);
                        single += once / want;
                        const int methods[] = {method_calibrated, method_sun, method_psf};
                        for (size_t m = 0; m < 3; ++m) {
                            const double ratio = brought(s, methods[m], 0, 0) / want;
                            mean[m] += ratio;
                            square[m] += (ratio - 1) * (ratio - 1);
                        }
                        ++count;
                    }
                printf("%5.2f %15.2f %4.0f %10.2f", g, absorption, exponent, single / count);
                for (size_t m = 0; m < 3; ++m)
                    printf("  %6.2f %5.2f", mean[m] / count, std::sqrt(square[m] / count));
                printf("\n");
                fflush(stdout);
            }
        }
}

void published_coefficients()
{
    printf("\nA Lambert surface that faces the lamp, light scattered once: relative error\n    T      sun      psf  psf at "
           "1\n");
    for (double depth : {0.05, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0}) {
        Sample s;
        s.surface = Surface{true, vec3(0, 0, -2), vec3(0, 0, 1)};
        s.lamp = Light{vec3(0, 0, 1), 0, vec3(0), 0, vec3(1), 0, light_point, 0};
        s.scene.medium.constant = 1;
        s.scene.medium.scattering = vec3(depth / 3);
        s.material = Material{true, vec3(1), vec3(0), false, 1};
        s.reflection = lambert(s.surface.normal);
        Light seen = s.lamp;
        seen.position = vec3(0, 0, 3);
        s.scene.lights = {&seen, 1};
        const double want = reflected_once(s.scene, s.reflection).x;
        printf("%5.2f %8.4f %8.4f %9.4f\n", depth, brought(s, method_sun, 0, 0) / want - 1,
               brought(s, method_psf, 0, 0) / want - 1, brought_by_one(s, depth) / want - 1);
    }
}

// A Lambert receiver at the origin that faces +z, a lamp 6 m above it, an environment of 1 all around, and one cloud.
void clouds(int count)
{
    printf("\nA receiver and a Gaussian cloud of 1 m in clear air: what it receives of a lamp 6 m above it over clear air, "
           "and of an even "
           "environment\n(Monte Carlo); psf with the depth between lamp and receiver, T(s,p), and with the mean depth "
           "around it, "
           "T-bar.\ncloud           T(s,p)  T-bar     lamp   T(s,p)   T-bar      sky   T-bar\n");
    struct Place {
        const char *name;
        vec3 at;
    };
    for (const Place &place : {Place{"between", {0, 0, 3}},
                               {"around", {0, 0, 0}},
                               {"beside", {3, 0, 0}},
                               {"behind", {0, 0, -1.5}},
                               {"behind, far", {0, 0, -4}}}) {
        ReferenceScene scene;
        scene.medium.scattering = vec3(1);
        const Gaussian cloud{place.at, 1, 0.8, vec3(1)};
        const Light lamp{vec3(0, 0, 6), 0, vec3(0), 0, vec3(36), 0, light_point, 0};
        scene.gaussians = {&cloud, 1};
        scene.lights = {&lamp, 1};
        auto depth_along = [&](vec3 from, vec3 d, double distance) {
            return profile_depth(profile_along(cloud, from, d), 0.0, distance);
        };
        const double path = depth_along(vec3(0), vec3(0, 0, 1), 6),
                     mean = 0.8 * mean_depth_of_gaussian(surface_tables::degrees(), glm::length(place.at));
        const double lit = std::exp(-path) + pi * reflected_once(scene, lambert(vec3(0, 0, 1)), 1, 1e-4).x;
        auto lamp_by = [](double depth) { return std::exp(-depth) + pi * psf_lobe(surface_tables::degrees(), depth, 1, 1); };
        std::mt19937 random(3);
        std::uniform_real_distribution<double> u(0, 1);
        double sky = 0;
        for (int i = 0; i < count; ++i) {
            const double c = std::sqrt(u(random)), phi = 2 * pi * u(random), s = std::sqrt(1 - c * c);
            const vec3 d(s * std::cos(phi), s * std::sin(phi), c);
            const double reach = glm::length(place.at) + 5, t = reach * u(random);
            const vec3 x = t * d, beside = x - place.at;
            const double density = 0.8 * std::exp(-glm::dot(beside, beside));
            sky += std::exp(-depth_along(vec3(0), d, 1e3)) +
                   reach * density * std::exp(-depth_along(vec3(0), d, t) - depth_along(x, direction(random), 1e3));
        }
        sky /= count;
        Degrees even{};
        even.of[0] = vec3(1);
        const double sky_by_mean = std::exp(-mean) + psf_lobe_of_environment(surface_tables::degrees(), even, 1, 0, mean, 1);
        printf("%-14s %7.3f %6.3f %8.3f %8.3f %7.3f %8.3f %7.3f\n", place.name, path, mean, lit, lamp_by(path),
               lamp_by(mean), sky, sky_by_mean);
    }
}

}  // namespace

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    if (argc > (quick ? 2 : 1)) {
        fprintf(stderr, "surface_accuracy: %s: expected --quick or nothing\n", argv[1]);
        return 2;
    }
    once(quick ? 12 : 600);
    often(quick ? 100 : 20000);
    published_coefficients();
    clouds(quick ? 20000 : 4000000);
}
