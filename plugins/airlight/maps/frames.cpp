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

// Of what a directional light's map has to cover along a side, at least so many.
constexpr double steps_a_side = 8;

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

// Of a side, in metres: what single precision tells apart that far away.
double least_width(double at)
{
    return 1e-6 * std::max(1.0, std::abs(at));
}

// Returns false where nothing is lit.
bool set_range(Frame &frame, double near, double far)
{
    if (!(near < far))
        return false;
    frame.near = float(near);
    frame.far = float(std::max(far, near + least_width(near)));
    return true;
}

// Returns false where it is all there is.
bool set_window(Frame &frame, const Square &square)
{
    const vec2 size = clamp(square.high - square.low, vec2(least_size), vec2(1)),
               low = clamp(0.5 * (square.low + square.high - size), vec2(0), vec2(1) - size);
    for (int i = 0; i < 2; ++i) {
        frame.low[i] = low[i];
        frame.size[i] = size[i];
    }
    return size != vec2(1);
}

Square rims(const std::vector<Cap> &caps, vec3 u, vec3 v, vec3 axis)
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

// Where the view's rays go.
class View {
public:
    View(const brume_plugin_camera &c, int width, int height)
    {
        const int size[2] = {width, height};
        for (int axis = 0; axis < 2; ++axis)
            for (int end = 0; end < 2; ++end) {
                const double tangent = (end * size[axis] - double(c.center[axis])) * c.tangent_scale[axis],
                             side = (end == 0) == (c.tangent_scale[axis] > 0) ? 1 : -1;
                vec3 plane(0, 0, tangent);
                plane[axis] = 1;
                inward_[2 * axis + end] = side * glm::normalize(plane);
            }
    }
    bool meets(vec3 center, double reach) const
    {
        return reach > center.z &&
               std::all_of(std::begin(inward_), std::end(inward_), [&](vec3 plane) { return dot(plane, center) > -reach; });
    }

private:
    vec3 inward_[4];
};

struct Fit {
    const brume_plugin_scene &scene;
    View view;
    bool everywhere;

    // Where nothing but Gaussians scatters, only those that the view's rays meet are lit.
    bool is_lit(vec3 center, double reach) const
    {
        return scene.medium->constant > 0 || scene.medium->term_count > 0 || view.meets(center, reach);
    }
    Frame across(const brume_plugin_light &light) const;
    Frame around(const brume_plugin_light &light) const;
};

// Its sides lie on a lattice that starts where all Gaussians do, so that maps outlive small moves of the camera and are the
// same whatever was seen before.
Frame Fit::across(const brume_plugin_light &light) const
{
    const Medium medium = medium_of(scene);
    const vec3 direction = three(light.direction), x = in_camera(*scene.camera, {1, 0, 0}),
               y = in_camera(*scene.camera, {0, 1, 0}),
               u = glm::normalize(cross(direction, std::abs(dot(direction, x)) < 0.6 ? x : y)), v = cross(direction, u);
    vec3 low(1e30), high(-1e30), lit_low(1e30), lit_high(-1e30);
    for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
        const Gaussian g = gaussian_of(given);
        const double reach = gaussian_reach(medium, g);
        const vec3 at(dot(u, g.center), dot(v, g.center), dot(direction, g.center));
        low = min(low, at - reach);
        high = max(high, at + reach);
        if (is_lit(g.center, reach)) {
            lit_low = min(lit_low, at - reach);
            lit_high = max(lit_high, at + reach);
        }
    }
    Frame frame;
    if (!(lit_low.z < lit_high.z))
        return frame;
    vec3 size;
    for (int i = 0; i < 3; ++i) {
        const double width = std::max(lit_high[i] - lit_low[i], least_width(lit_low[i])),
                     step = std::exp2(std::floor(std::log2(width / steps_a_side))),
                     first = std::floor((lit_low[i] - low[i]) / step);
        frame.after[i] = first * step;
        size[i] = (std::ceil((lit_low[i] + width - low[i]) / step) - first) * step;
    }
    frame.u = in_world(*scene.camera, u);
    frame.v = in_world(*scene.camera, v);
    for (int i = 0; i < 2; ++i) {
        frame.low[i] = low[i] + frame.after[i];
        frame.size[i] = size[i];
    }
    set_range(frame, low.z + frame.after[2], low.z + frame.after[2] + size.z);
    return frame;
}

Frame Fit::around(const brume_plugin_light &light) const
{
    const Medium medium = medium_of(scene);
    const vec3 position = three(light.position), direction = three(light.direction);
    const bool spot = light.type == BRUME_LIGHT_SPOT && !everywhere;
    const double cone = spot ? std::acos(std::clamp(double(light.cos_outer), -1.0, 1.0)) : std::numbers::pi;
    std::vector<Cap> caps;
    bool inside = false;
    vec3 middle(0);
    double near = 1e30, far = -1e30;
    for (const brume_plugin_gaussian &given : brume::gaussians_in(scene)) {
        const Gaussian g = gaussian_of(given);
        const double reach = gaussian_reach(medium, g);
        if (!is_lit(g.center, reach))
            continue;
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
    if (!set_range(frame, near, far))
        return frame;
    if (!spot && (inside || !(length(middle) > 0)))
        return frame;
    // In the world's axes, so that the map outlives a turn of the camera.
    const vec3 axis = glm::normalize(spot ? direction : middle), x = in_camera(*scene.camera, {1, 0, 0}),
               y = in_camera(*scene.camera, {0, 1, 0}),
               u = glm::normalize(cross(axis, std::abs(dot(axis, x)) < 0.6 ? x : y)), v = cross(axis, u);
    Square square = inside ? Square{vec2(0), vec2(1)} : rims(caps, u, v, axis);
    if (spot) {
        const Square lit = within_cone(cone);
        square = {max(square.low, lit.low), min(square.high, lit.high)};
    }
    if (set_window(frame, square)) {
        frame.u = in_world(*scene.camera, u);
        frame.v = in_world(*scene.camera, v);
    }
    return frame;
}

// But for rounding: positions are from the camera.
bool alike(const Frame &a, const Frame &b, bool parallel)
{
    bool same = true;
    auto compare = [&](double x, double y, double scale) { same = same && std::abs(x - y) <= 1e-3 * scale; };
    for (size_t i = 0; i < 3 && !parallel; ++i) {
        compare(a.u[i], b.u[i], std::min(a.size[0], a.size[1]));
        compare(a.v[i], b.v[i], std::min(a.size[0], a.size[1]));
    }
    const double depth = double(a.far) - double(a.near);
    compare(double(b.far) - double(b.near), depth, depth);
    compare(a.after[2], b.after[2], depth);
    for (int i = 0; i < 2; ++i) {
        if (!parallel)
            compare(a.low[i], b.low[i], a.size[i]);
        compare(a.after[i], b.after[i], a.size[i]);
        compare(a.size[i], b.size[i], a.size[i]);
    }
    return same;
}

}  // namespace

bool Frames::place(const brume_plugin_scene &scene, int width, int height, bool everywhere, bool moved)
{
    frames_.resize(scene.light_count);
    texels.resize(size_t(scene.light_count) * 12);
    const Fit fit{scene, View(*scene.camera, width, height), everywhere};
    bool again = moved;
    for (uint32_t l = 0; l < scene.light_count; ++l) {
        const brume_plugin_light &light = brume::lights_in(scene)[l];
        const bool parallel = light.type == BRUME_LIGHT_DIRECTIONAL;
        const Frame fitted = parallel ? fit.across(light) : fit.around(light);
        Frame &frame = frames_[l];
        const bool stays = !moved && alike(frame, fitted, parallel);
        again = again || !stays;
        // A box is from the camera.
        if (parallel || !stays)
            frame = fitted;
        float *texel = &texels[12 * l];
        for (int axis = 0; axis < 2; ++axis) {
            const vec3 a = in_camera(*scene.camera, axis == 0 ? frame.u : frame.v);
            const double size = parallel ? frame.size[axis] : 1;
            for (int i = 0; i < 3; ++i)
                texel[4 * axis + i] = float(a[i] / size);
            texel[4 * axis + 3] = float(parallel ? -frame.low[axis] / size : frame.low[axis]);
        }
        texel[8] = frame.near;
        texel[9] = frame.far;
        texel[10] = float(frame.size[0]);
        texel[11] = float(frame.size[1]);
    }
    return again;
}

}  // namespace airlight::maps
