#include "maps/frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene_maths.hpp"

namespace airlight::maps {
namespace {

using namespace brume::maths_double;

// Nearer to a right angle from the axis the octahedral square's edges are met, where it folds.
constexpr double widest = 88 * std::numbers::pi / 180;

// Of the square: a lamp may be farther away than single precision tells its directions apart.
constexpr double least_size = 1e-3;

// The grid's corners beyond a spot's rim count for the pixels within it.
constexpr double around_cone = 1.1;

constexpr int rim_points = 8;

vec3 three(const float (&v)[3])
{
    return {v[0], v[1], v[2]};
}

std::array<double, 3> in_world(const brume_plugin_camera &camera, vec3 v)
{
    std::array<double, 3> w;
    for (size_t i = 0; i < 3; ++i)
        w[i] = v.x * camera.right[i] + v.y * camera.up[i] + v.z * camera.back[i];
    return w;
}

vec3 in_camera(const brume_plugin_camera &camera, const std::array<double, 3> &w)
{
    auto along = [&](const float(&axis)[3]) { return w[0] * axis[0] + w[1] * axis[1] + w[2] * axis[2]; };
    return {along(camera.right), along(camera.up), along(camera.back)};
}

// What a light sees of a Gaussian.
struct Cap {
    vec3 direction;
    double angle;
};

struct Square {
    vec2 low{1}, high{0};

    void add(vec2 p)
    {
        low = min(low, p);
        high = max(high, p);
    }
};

Square around(const std::vector<Cap> &caps, vec3 u, vec3 v, vec3 axis)
{
    Square square;
    for (const Cap &cap : caps) {
        if (std::acos(std::clamp(dot(cap.direction, axis), -1.0, 1.0)) + cap.angle > widest)
            return {vec2(0), vec2(1)};
        const vec3 e = glm::normalize(cross(cap.direction, std::abs(cap.direction.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0))),
                   f = cross(cap.direction, e);
        // Corners of a polygon around it: the square has straight lines where the sphere has great circles.
        const double reach = std::tan(cap.angle) / std::cos(std::numbers::pi / rim_points);
        for (int i = 0; i < rim_points; ++i) {
            const double turn = 2 * std::numbers::pi * i / rim_points;
            const vec3 at = cap.direction + reach * (std::cos(turn) * e + std::sin(turn) * f);
            square.add(octahedral(vec3(dot(at, u), dot(at, v), std::max(dot(at, axis), 0.0))));
        }
    }
    return square;
}

Square within_cone(double angle)
{
    const double a = around_cone * angle;
    if (a > widest)
        return {vec2(0), vec2(1)};
    const double half = 0.5 * std::sin(a) / (std::sin(a) + std::cos(a));
    return {vec2(0.5 - half), vec2(0.5 + half)};
}

Frame fit(const brume_plugin_scene &scene, const brume_plugin_light &light, bool everywhere)
{
    const Medium medium = medium_of(scene);
    const vec3 position = three(light.position), direction = three(light.direction);
    const bool parallel = light.type == BRUME_LIGHT_DIRECTIONAL, spot = light.type == BRUME_LIGHT_SPOT && !everywhere;
    const double cone = spot ? std::acos(std::clamp(double(light.cos_outer), -1.0, 1.0)) : std::numbers::pi;
    std::vector<Cap> caps;
    bool inside = false;
    vec3 middle(0);
    double near = 1e30, far = -1e30;
    for (uint32_t i = 0; i < scene.gaussian_count; ++i) {
        const Gaussian g = gaussian_of(scene.gaussians[i]);
        const double reach = gaussian_reach(medium, g);
        if (parallel) {
            const double at = dot(direction, g.center);
            near = std::min(near, at - reach);
            far = std::max(far, at + reach);
            continue;
        }
        const vec3 away = g.center - position;
        const double distance = length(away);
        if (distance <= reach) {
            inside = true;
        } else {
            const Cap cap{away / distance, std::asin(reach / distance)};
            if (spot && std::acos(std::clamp(dot(cap.direction, direction), -1.0, 1.0)) > around_cone * cone + cap.angle)
                continue;
            middle += cap.direction;
            caps.push_back(cap);
        }
        near = std::min(near, std::max(distance - reach, 0.0));
        far = std::max(far, distance + reach);
    }
    Frame frame;
    if (!(near < far))
        return frame;
    frame.near = float(near);
    frame.far = float(std::max(far, near + 1e-6 * std::max(1.0, std::abs(near))));
    if (parallel || (!spot && (inside || !(length(middle) > 0))))
        return frame;
    const vec3 axis = glm::normalize(spot ? direction : middle),
               u = glm::normalize(cross(axis, std::abs(axis.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0))), v = cross(axis, u);
    Square square = inside ? Square{vec2(0), vec2(1)} : around(caps, u, v, axis);
    if (spot) {
        const Square lit = within_cone(cone);
        square = {max(square.low, lit.low), min(square.high, lit.high)};
    }
    const vec2 size = clamp(square.high - square.low, vec2(least_size), vec2(1));
    if (size == vec2(1))
        return frame;
    const vec2 low = clamp(0.5 * (square.low + square.high - size), vec2(0), vec2(1) - size);
    frame.u = in_world(*scene.camera, u);
    frame.v = in_world(*scene.camera, v);
    for (int i = 0; i < 2; ++i) {
        frame.low[i] = low[i];
        frame.size[i] = size[i];
    }
    return frame;
}

}  // namespace

void Frames::place(const brume_plugin_scene &scene, const ShadowLists &lists, bool everywhere, bool moved)
{
    frames_.resize(scene.light_count);
    texels.resize(size_t(scene.light_count) * 12);
    for (uint32_t l = 0; l < scene.light_count; ++l) {
        const brume_plugin_light &light = scene.lights[l];
        const bool parallel = light.type == BRUME_LIGHT_DIRECTIONAL;
        Frame &frame = frames_[l];
        if (moved || parallel)
            frame = fit(scene, light, everywhere);
        float *texel = &texels[12 * l];
        std::copy_n(&lists.origins[12 * (1 + l)], 8, texel);
        for (int axis = 0; axis < 2 && !parallel; ++axis) {
            const vec3 a = in_camera(*scene.camera, axis == 0 ? frame.u : frame.v);
            for (int i = 0; i < 3; ++i)
                texel[4 * axis + i] = float(a[i]);
            texel[4 * axis + 3] = float(frame.low[axis]);
        }
        texel[8] = frame.near;
        texel[9] = frame.far;
        texel[10] = float(frame.size[0]);
        texel[11] = float(frame.size[1]);
    }
}

}  // namespace airlight::maps
