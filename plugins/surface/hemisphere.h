#pragma once
// What surfaces reflect of a lamp's light that the medium scattered once, by quadrature in double over the directions that
// it comes from, each ray's part by adaptive quadrature (plugins/airlight/reference_ray.h): any medium, phase function and
// reflection.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "airlight/quadrature.h"
#include "airlight/reference_ray.h"

namespace surface_reference {

using namespace brume::maths_double;

using brume::airlight::Node;

// The nodes of each of `pieces` of [0, 1].
inline std::vector<Node> panels(int pieces)
{
    std::vector<Node> all;
    for (int p = 0; p < pieces; ++p)
        for (const Node &node : brume::airlight::gauss_legendre())
            all.push_back({(p + node.at) / pieces, node.weight / pieces});
    return all;
}

// A surface's point is the origin. Reflection toward the viewer of light from a unit direction: BRDF times cosine, of the
// hemisphere around `up`; `peak` is where it has one.
struct Reflection {
    std::function<double(vec3)> of;
    vec3 up;
    vec3 peak;
};

inline Reflection lambert(vec3 normal)
{
    return {[=](vec3 d) { return std::max(glm::dot(d, normal), 0.0) / std::numbers::pi; }, normal, normal};
}

// As surface.glsl has it: no surface cosine, and the lobe's own hemisphere.
inline Reflection phong(vec3 mirrored, double exponent)
{
    return {[=](vec3 d) {
                return (exponent + 1) / (2 * std::numbers::pi) * std::pow(std::max(glm::dot(d, mirrored), 0.0), exponent);
            },
            mirrored, mirrored};
}

// Microfacets of GGX with Smith's masking, correlated by height, that reflect all; view: toward the viewer.
inline Reflection ggx(vec3 normal, vec3 view, double roughness)
{
    const double a2 = std::pow(roughness, 4), cv = glm::dot(normal, view);
    return {[=](vec3 d) {
                const double cd = glm::dot(d, normal);
                if (cd <= 0)
                    return 0.0;
                const double ch = glm::dot(glm::normalize(d + view), normal), q = ch * ch * (a2 - 1) + 1;
                const double masked = cd * std::sqrt(a2 + (1 - a2) * cv * cv) + cv * std::sqrt(a2 + (1 - a2) * cd * cd);
                return a2 / (std::numbers::pi * q * q) * 0.5 / masked * cd;
            },
            normal, 2 * glm::dot(normal, view) * normal - view};
}

// Calls f(direction, angle from the axis, solid angle) for directions around `axis`. They crowd toward it, toward the
// reflection's peak and where its horizon touches circles around the axis, and keep above that.
template <class Function> void for_directions(vec3 axis, const Reflection &reflection, int fine, const Function &f)
{
    constexpr double pi = std::numbers::pi;
    auto aside = [&](vec3 d) { return d - glm::dot(d, axis) * axis; };
    vec3 u = aside(reflection.up);
    if (glm::length(u) < 1e-6)
        u = aside(reflection.peak);
    if (glm::length(u) < 1e-6)
        u = std::abs(axis.x) < 0.5 ? glm::cross(axis, vec3(1, 0, 0)) : glm::cross(axis, vec3(0, 1, 0));
    u = glm::normalize(u);
    const vec3 v = glm::cross(axis, u);
    auto angle = [&](vec3 d) { return std::acos(std::clamp(glm::dot(axis, d), -1.0, 1.0)); };
    const double tilt = angle(reflection.up), touches = std::abs(pi / 2 - tilt);
    const vec3 peak = aside(reflection.peak);
    const double peak_turn = glm::length(peak) < 1e-6 ? 0 : std::atan2(glm::dot(peak, v), glm::dot(peak, u));
    std::array<double, 5> ends{0, touches, angle(reflection.peak), pi - touches, pi};
    std::sort(ends.begin(), ends.end());
    const auto nodes = panels(fine);
    for (size_t i = 0; i + 1 < ends.size(); ++i)
        for (const Node &p : nodes) {
            const double x = p.at, from = ends[i], width = ends[i + 1] - from;
            if (width <= 0)
                continue;
            const double gamma = from + width * x * x * x * (10 - 15 * x + 6 * x * x);
            const double of_gamma = std::sin(gamma) * p.weight * width * 30 * x * x * (1 - x) * (1 - x);
            const double horizon = std::cos(gamma) * std::cos(tilt), swing = std::sin(gamma) * std::sin(tilt);
            const double reach = swing < 1e-12 ? (horizon > 0 ? pi : 0) : std::acos(std::clamp(-horizon / swing, -1.0, 1.0));
            const double middle = std::clamp(peak_turn, -reach, reach);
            for (double end : {-reach, reach})
                for (const Node &q : nodes) {
                    const double phi = middle + (end - middle) * q.at * q.at * q.at;
                    f(std::cos(gamma) * axis + std::sin(gamma) * (std::cos(phi) * u + std::sin(phi) * v), gamma,
                      of_gamma * std::abs(end - middle) * q.weight * 3 * q.at * q.at);
                }
        }
}

// Of lights[0], a point or spot. Where nothing but the angle from it matters a ray serves a whole ring.
inline vec3 reflected_once(const brume::airlight::ReferenceScene &scene, const Reflection &reflection, int fine = 2,
                           double tolerance = 1e-7)
{
    const Light &lamp = scene.lights[0];
    const vec3 axis = glm::normalize(lamp.position);
    const bool rings = scene.gaussians.empty() && scene.medium.term_count == 0 && lamp.type == light_point;
    double last = -1;
    vec3 arrives(0), sum(0);
    for_directions(axis, reflection, fine, [&](vec3 d, double gamma, double solid_angle) {
        const double reflects = reflection.of(d);
        if (!rings ? reflects > 0 : gamma != last) {
            // Rays know no narrower way past a lamp than smallest_light_angle; below it radiance goes by 1 / sin.
            const double off = std::clamp(gamma, 2 * smallest_light_angle, std::numbers::pi - 2 * smallest_light_angle);
            const vec3 aside = d - glm::dot(d, axis) * axis;
            const vec3 ray = off == gamma ? d : std::cos(off) * axis + std::sin(off) * glm::normalize(aside);
            arrives = brume::airlight::reference_airlight(scene, ray, far_away, 0, 1, tolerance).radiance * std::sin(off) /
                      std::sin(gamma);
        }
        last = gamma;
        sum += reflects * solid_angle * arrives;
    });
    return sum;
}

}  // namespace surface_reference
