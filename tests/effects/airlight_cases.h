#pragma once
// Random geometries of single scattering, by regime. All numbers are floats, so that float and double see the same scene.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "maths.hpp"

namespace airlight_cases {

using namespace brume::maths_double;

struct Case {
    Medium medium{};
    std::vector<Gaussian> gaussians;
    std::vector<Light> lights;
    vec3 direction{0, 0, -1};
    double distance = 1;
};

class Dice {
public:
    explicit Dice(uint64_t seed) : random_(seed) {}
    double uniform(double a, double b) { return float(a + (b - a) * std::uniform_real_distribution<double>(0, 1)(random_)); }
    double logarithmic(double a, double b) { return float(std::exp(uniform(std::log(a), std::log(b)))); }
    bool chance(double p) { return uniform(0, 1) < p; }
    int count(int a, int b) { return std::uniform_int_distribution<int>(a, b)(random_); }
    vec3 direction()
    {
        const double z = uniform(-1, 1), phi = uniform(0, 6.28318530717958648), r = std::sqrt(1 - z * z);
        return vec3(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z));
    }
    // At an angle from d.
    vec3 near_direction(vec3 d, double angle)
    {
        const vec3 side = glm::normalize(glm::cross(d, direction()));
        return std::cos(angle) * d + std::sin(angle) * side;
    }

private:
    std::mt19937_64 random_;
};

inline vec3 rounded(vec3 v)
{
    return vec3(float(v.x), float(v.y), float(v.z));
}

inline Light light_at(vec3 position)
{
    Light l{};
    l.position = rounded(position);
    l.direction = vec3(0, -1, 0);
    l.intensity = vec3(1);
    l.cos_outer = -1;
    l.cos_inner = -1;
    return l;
}

// A light at a distance, seen at an angle gamma from the ray; the medium's optical depth to it is `depth`.
inline Case with_light(Dice &dice, double gamma, double depth)
{
    Case c;
    c.direction = rounded(dice.direction());
    const double distance = dice.logarithmic(1, 50);
    c.lights.push_back(light_at(distance * dice.near_direction(c.direction, gamma)));
    // Half of the media absorb, and colours differ.
    const double sigma = depth / distance;
    const vec3 colour(1, float(dice.uniform(0.7, 1)), float(dice.uniform(0.5, 1)));
    const double albedo = dice.chance(0.5) ? 1 : dice.uniform(0.3, 1);
    c.medium.scattering = rounded(sigma * albedo * colour);
    c.medium.absorption = rounded(sigma * (1 - albedo) * colour);
    c.medium.luminance = vec3(float(1.0 / 3));
    c.distance = dice.chance(0.2) ? far_away : float(distance * dice.uniform(0.2, 3));
    return c;
}

inline Case homogeneous(Dice &dice, double gamma, double depth)
{
    Case c = with_light(dice, gamma, depth);
    c.medium.constant = 1;
    return c;
}

constexpr double degree = 0.01745329251994329577;

inline Case typical(Dice &dice)
{
    return homogeneous(dice, dice.uniform(1, 90) * degree, dice.logarithmic(0.25, 4));
}

inline Case away(Dice &dice)
{
    return homogeneous(dice, dice.uniform(90, 179) * degree, dice.logarithmic(0.25, 4));
}

inline Case thin(Dice &dice)
{
    return homogeneous(dice, dice.uniform(1, 90) * degree, dice.logarithmic(0.001, 0.25));
}

inline Case toward_the_light(Dice &dice)
{
    return homogeneous(dice, dice.logarithmic(0.001, 1) * degree, dice.logarithmic(0.25, 4));
}

inline Case anisotropic(Dice &dice)
{
    Case c = homogeneous(dice, dice.uniform(1, 120) * degree, dice.logarithmic(0.1, 4));
    c.medium.phase.x = dice.uniform(-0.5, 0.95);
    return c;
}

inline Case droplets(Dice &dice)
{
    Case c = homogeneous(dice, dice.uniform(0.5, 120) * degree, dice.logarithmic(0.1, 4));
    const double d = dice.uniform(5, 50);
    c.medium.phase =
        vec4(float(std::exp(-.0990567 / (d - 1.67154))), float(std::exp(-2.20679 / (d + 3.91029) - .428934)),
             float(std::exp(3.62489 - 8.29288 / (d + 5.52825))), float(std::exp(-.599085 / (d - .641583) - .665888)));
    return c;
}

inline Case exponential(Dice &dice)
{
    Case c = with_light(dice, dice.uniform(1, 120) * degree, dice.logarithmic(0.1, 4));
    c.medium.constant = dice.chance(0.5) ? 0 : dice.uniform(0, 0.5);
    c.medium.term_count = dice.count(1, 2);
    for (int i = 0; i < c.medium.term_count; ++i) {
        const double falloff = dice.logarithmic(0.003, 0.5);
        c.medium.terms[i] = vec4(rounded(falloff * dice.direction()), float(dice.uniform(-2, 1)));
    }
    return c;
}

inline Case spot(Dice &dice)
{
    Case c = homogeneous(dice, dice.uniform(1, 120) * degree, dice.logarithmic(0.1, 4));
    Light &l = c.lights[0];
    l.type = light_spot;
    const double half = dice.uniform(5, 60) * degree;
    l.cos_outer = float(std::cos(half));
    l.cos_inner = float(std::cos(half * (1 - dice.uniform(0.05, 0.6))));
    // Mostly such that the ray is lit.
    const double t = glm::dot(l.position, c.direction) * dice.uniform(0, 1.5);
    l.direction =
        rounded(dice.near_direction(glm::normalize(std::max(t, 0.5) * c.direction - l.position), half * dice.uniform(0, 1)));
    return c;
}

inline Case sunlit(Dice &dice)
{
    Case c = dice.chance(0.5) ? typical(dice) : exponential(dice);
    Light &l = c.lights[0];
    l.type = light_directional;
    l.position = vec3(0);
    l.direction = rounded(dice.direction());
    l.distance = dice.uniform(0, 10);
    return c;
}

// A Gaussian that the ray comes within 1.5 radii of, of an optical depth of its own.
inline Gaussian on_ray(Dice &dice, const Case &c, double t, double radius, double depth)
{
    const vec3 side = glm::normalize(glm::cross(c.direction, dice.direction()));
    const double extinction = c.medium.scattering.x + c.medium.absorption.x;
    Gaussian g{};
    g.center = rounded(t * c.direction + side * radius * dice.uniform(0, 1.5));
    g.scale = float(1 / radius);
    g.amplitude = float(depth / (extinction * radius * 1.7724539));
    g.color = vec3(1, 1, float(dice.uniform(0.5, 1)));
    return g;
}

inline double distance_in_radii(const Gaussian &g, vec3 point)
{
    return g.scale * glm::length(g.center - point);
}

// `near` to `far` radii between light and Gaussian.
inline Case with_gaussian(Dice &dice, double near, double far)
{
    for (;;) {
        Case c = with_light(dice, dice.uniform(1, 90) * degree, dice.logarithmic(0.1, 2));
        c.medium.constant = dice.chance(0.5) ? 0 : 0.3;
        const double light = glm::length(c.lights[0].position);
        const double t = light * dice.uniform(0.2, 1.5), radius = light * dice.logarithmic(0.02, 0.4);
        c.distance = dice.chance(0.2) ? far_away : float(t + radius * dice.uniform(3, 20));
        c.gaussians.push_back(on_ray(dice, c, t, radius, dice.logarithmic(0.05, 3)));
        const double d = distance_in_radii(c.gaussians[0], c.lights[0].position);
        if (d >= near && d <= far)
            return c;
    }
}

inline Case beside_gaussian(Dice &dice)
{
    return with_gaussian(dice, 2, 6);
}

inline Case light_inside(Dice &dice)
{
    return with_gaussian(dice, 0, 2);
}

inline Case cut_by_surface(Dice &dice)
{
    Case c = with_gaussian(dice, 2, 20);
    const Gaussian &g = c.gaussians[0];
    c.distance = std::max(0.1, double(float(glm::dot(g.center, c.direction) + dice.uniform(-1.5, 1) / g.scale)));
    return c;
}

// Some Gaussians on the ray, and as many between them and the light.
inline Case shadowing(Dice &dice)
{
    for (;;) {
        Case c = with_gaussian(dice, 3, 20);
        c.medium.constant = dice.chance(0.3) ? 0.1 : 0;
        const int n = dice.count(1, 4);
        const double light = glm::length(c.lights[0].position);
        for (int i = 0; i < n; ++i)
            c.gaussians.push_back(on_ray(dice, c, light * dice.uniform(0.2, 1.5), light * dice.logarithmic(0.03, 0.2),
                                         dice.logarithmic(0.1, 3)));
        const size_t seen = c.gaussians.size();
        for (size_t i = 0; i < seen; ++i) {
            Gaussian g = c.gaussians[i];
            g.center = rounded(mix(g.center, c.lights[0].position, dice.uniform(0.3, 0.7)) +
                               dice.uniform(0, 1) / g.scale * dice.direction());
            g.amplitude = float(g.amplitude * dice.uniform(0.2, 1.5));
            c.gaussians.push_back(g);
        }
        bool clear = true;
        for (const Gaussian &g : c.gaussians)
            clear = clear && distance_in_radii(g, c.lights[0].position) > 2;
        if (clear)
            return c;
    }
}

// A bank of many overlapping Gaussians with the light in or beside it.
inline Case bank(Dice &dice, int n)
{
    Case c = with_light(dice, dice.uniform(5, 60) * degree, dice.logarithmic(0.3, 3));
    const double light = glm::length(c.lights[0].position), extinction = c.medium.scattering.x + c.medium.absorption.x;
    const double radius = 2 * light / std::cbrt(double(n)) * dice.uniform(0.5, 1.2);
    const double density = dice.logarithmic(0.3, 5) / (light * extinction);
    c.distance = float(light * dice.uniform(0.5, 2.5));
    for (int i = 0; i < n; ++i) {
        Gaussian g{};
        // Along the ray's tube only, as a tile's list has them.
        const double r = radius * dice.uniform(0.6, 1.4);
        const vec3 side = glm::normalize(glm::cross(c.direction, dice.direction()));
        g.center = rounded(light * dice.uniform(0.2, 2.2) * c.direction + side * r * dice.uniform(0, 2.0));
        g.scale = float(1 / r);
        // So many along the ray add up to the optical depth.
        g.amplitude = float(density * 2 * light / (n * 0.6 * 1.77 * r) * dice.uniform(0.5, 1.5));
        g.color = vec3(1);
        c.gaussians.push_back(g);
    }
    return c;
}

// What of a medium a regime has: terms only, or Gaussians, all at least two radii from the lights or not.
enum class Kind { smooth, apart, near };

struct Regime {
    std::string name;
    std::function<Case(Dice &)> make;
    Kind kind;
    int published;      // the tier of the papers that is meant for it: 0 sun, 1 fogshop, -1 none
    int rays = 100000;  // of a full measurement
};

inline std::vector<Regime> regimes()
{
    return {{"typical", typical, Kind::smooth, 0},
            {"away from the light", away, Kind::smooth, 0},
            {"thin fog", thin, Kind::smooth, 0},
            {"gamma < 1 degree", toward_the_light, Kind::smooth, 0},
            {"anisotropic, g -.5 to .95", anisotropic, Kind::smooth, -1},
            {"droplets", droplets, Kind::smooth, -1},
            {"exponential", exponential, Kind::smooth, -1},
            {"spot", spot, Kind::smooth, -1},
            {"directional", sunlit, Kind::smooth, -1},
            {"light 2 to 6 radii from a blob", beside_gaussian, Kind::apart, 1},
            {"light inside a blob", light_inside, Kind::near, 1},
            {"surface cutting a blob", cut_by_surface, Kind::apart, 1},
            {"blobs shadowing blobs", shadowing, Kind::apart, 1},
            {"bank of 50 blobs", [](Dice &d) { return bank(d, 50); }, Kind::near, 1},
            // The reference takes .2 s for each.
            {"bank of 300 blobs", [](Dice &d) { return bank(d, 300); }, Kind::near, 1, 1500}};
}

}  // namespace airlight_cases
