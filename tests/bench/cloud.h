// The cloud of Fogshop's Table 1 and what its airlight is exactly.
#pragma once
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "airlight_world.h"
#include "fog.h"

namespace bench {

using brume::maths_float::Gaussian;
using brume::maths_float::Light;
using brume::maths_float::vec3;

inline constexpr float half_tangent = 0.36397f, wall = 14;  // of the camera's field of view; planar [m]

inline unsigned threads()
{
    return std::max(1u, std::thread::hardware_concurrency());
}

template <class F> void in_parallel(size_t count, F f)
{
    std::vector<std::jthread> all;
    for (unsigned k = 0; k < threads(); ++k)
        all.emplace_back([&, k] {
            for (size_t i = k; i < count; i += threads())
                f(i);
        });
}

// A cloud of optical depth 1.5 that fills the view, with lights around it. More Gaussians are smaller ones.
struct Cloud {
    std::vector<Gaussian> gaussians;
    std::vector<Light> lights;
    float radius;

    Cloud(int count, int light_count)
    {
        std::mt19937 random{uint32_t(count)};
        auto uniform = [&](float a, float b) { return a + (b - a) * float(random() % 65536u) / 65536.0f; };
        radius = 0.6f * std::cbrt(144.0f / float(count));
        for (int i = 0; i < count; ++i) {
            const float share = uniform(0.7f, 1.4f);
            gaussians.push_back({vec3(uniform(-3, 3), uniform(-2, 2), uniform(-12, -6)), 1 / (share * radius),
                                 0.25f / 1.2f * uniform(0.5f, 1.2f), vec3(1)});
        }
        const vec3 places[8] = {{-4, 2.5f, -8}, {4, 2, -9},     {0, -3.2f, -5}, {0, 3.5f, -11},
                                {-4, -2, -11},  {4, -2.5f, -7}, {-2, 3.5f, -5}, {2, 3, -4}};
        for (int l = 0; l < light_count; ++l) {
            Light light{};
            light.position = places[l];
            light.intensity = vec3(30);
            light.cos_outer = light.cos_inner = -1;
            lights.push_back(light);
        }
    }
    // As many again where neither the view nor the lights' paths meet them.
    void hide(int count)
    {
        std::mt19937 random(7);
        for (int i = 0; i < count; ++i) {
            auto uniform = [&](float a, float b) { return a + (b - a) * float(random() % 65536u) / 65536.0f; };
            gaussians.push_back({vec3(uniform(-30, 30), uniform(-30, 30), uniform(10, 40)), 1 / radius, 0.2f, vec3(1)});
        }
    }

    // All but its Gaussians, for the airlight with these parameters.
    nlohmann::ordered_json scene(const nlohmann::ordered_json &airlight) const
    {
        using Json = nlohmann::ordered_json;
        Json listed = Json::array();
        for (const Light &l : lights)
            listed.push_back(
                {{"type", "point"}, {"position", {l.position.x, l.position.y, l.position.z}}, {"intensity", l.intensity.x}});
        return {{"brume", 1},
                {"camera",
                 {{"vertical_fov", 2 * std::atan(half_tangent) * 57.29577951308232},
                  {"camera_to_world", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}}},
                {"medium", {{"scattering", 1}}},
                {"lights", listed},
                {"effects", {{"airlight", airlight}}}};
    }

    void describe(brume_scene scene, brume_context context) const
    {
        std::vector<brume_gaussian> gs;
        for (const Gaussian &g : gaussians) {
            brume_gaussian out = BRUME_GAUSSIAN_INIT;
            for (int i = 0; i < 3; ++i)
                out.center[i] = double(g.center[i]);
            out.scale = double(g.scale);
            out.amplitude = double(g.amplitude);
            gs.push_back(out);
        }
        brume_medium medium = BRUME_MEDIUM_INIT;
        for (double &s : medium.scattering)
            s = 1;
        medium.gaussians = gs.data();
        medium.gaussian_count = uint32_t(gs.size());
        fog::Context::check(brume_scene_set_medium(scene, &medium), context);
    }
};

struct Probe {
    int x, y;
    double exact = 0;
};

// The middle of a picture, a `part`-th of each of its sides.
struct View {
    int width, height;
    int part = 1;

    int image_width() const { return width / part; }
    int image_height() const { return height / part; }
    int left() const { return (width - image_width()) / 2; }
    int top() const { return (height - image_height()) / 2; }
    // Pixels of the whole picture; the cloud looks alike everywhere.
    double scale() const { return double(part) * part; }

    vec3 direction(const Probe &p) const
    {
        const float scale = 2 * half_tangent / float(height);
        return glm::normalize(vec3((float(p.x) + 0.5f - 0.5f * float(width)) * scale,
                                   -(float(p.y) + 0.5f - 0.5f * float(height)) * scale, -1));
    }
};

// Exact to some 1e-5: every Gaussian near the ray integrated by itself, with all Gaussians near its plane with the light.
inline double exact_airlight(const Cloud &cloud, vec3 direction)
{
    using namespace airlight_cases;
    using vec3 = brume::maths_double::vec3;
    double sum = 0;
    for (const Light &l : cloud.lights) {
        Case c;
        c.medium.scattering = vec3(1);
        c.medium.luminance = vec3(1.0 / 3);
        c.direction = direction;
        c.distance = wall / -direction.z;
        c.lights.push_back(airlight_cases::light_at(l.position));
        c.lights[0].intensity = l.intensity;
        const vec3 across = glm::normalize(glm::cross(c.direction, c.lights[0].position));
        std::vector<int> near;
        for (const auto &g : cloud.gaussians) {
            const vec3 center(g.center);
            if (double(g.scale) * std::abs(glm::dot(center, across)) > 4)
                continue;
            if (double(g.scale) * glm::length(glm::cross(center, c.direction)) < 4)
                near.push_back(int(c.gaussians.size()));
            c.gaussians.push_back({center, g.scale, g.amplitude, vec3(1)});
        }
        World world(c, 1e-5);
        world.settings.dense_from = std::numeric_limits<int>::max();
        world.see_only(near);
        sum += world.airlight(airlight_nodes).radiance.x;
    }
    return sum;
}

}  // namespace bench
