#pragma once
// Clouds of Gaussians with lamps in and around them, their airlight, and how far it is from what is exact.
#include "lit_scene.h"

namespace fog {

inline Json cloud(int count, unsigned seed, double coloured = 0)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0, 1);
    Json all = Json::array();
    for (int i = 0; i < count; ++i) {
        const double radius = (0.5 + 0.5 * u(random)) * 4 / std::cbrt(double(count));
        Json g = gaussian({6 * u(random) - 3, 4 * u(random) - 2, -6 - 6 * u(random)}, 1 / radius, 0.25 * u(random));
        if (coloured > 0)
            g["colour"] = {1, 1 - coloured * u(random), 1 - coloured};
        all.push_back(g);
    }
    return all;
}

inline Json lamps(int count)
{
    const Vector places[] = {{-4, 2.5, -8}, {4, 2, -9},    {0, 0.3, -8.5}, {0, 3.5, -11}, {-4, -2, -11},
                             {4, -2.5, -7}, {-2, 3.5, -5}, {2, 3, -4},     {0, -3, -6}};
    Json all = Json::array();
    for (int i = 0; i < count; ++i)
        all.push_back(point_light(places[i], 10 + 5 * i, 0.05 * (i % 2)));
    return all;
}

inline Json scene_of(const Json &density, const Json &lights, const Json &further = Json::object())
{
    Json medium{{"scattering", 1}, {"density", density}};
    medium.update(further);
    return lit_scene(medium, lights);
}

inline Json with(Json scene, const char *key, const Json &value)
{
    scene["effects"]["airlight"][key] = value;
    return scene;
}

inline Picture airlight_of(brume_context context, const Json &scene, const Frame &frame)
{
    return run(context, scene.dump(), frame.color, frame.depth, Options{{}, {"airlight"}}).airlight;
}

struct Errors {
    double mean = 0, median = 0, p95 = 0, p99 = 0, worst = 0;
    int x = 0, y = 0;
};

// Relative to the pixel or to a hundredth of the picture's mean.
inline Errors errors(const Picture &a, const Picture &exact)
{
    double mean = 0;
    for (float v : exact.data)
        mean += std::abs(double(v)) / double(exact.data.size());
    Errors e;
    std::vector<double> all;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(double(a.at(x, y)[c]) - double(exact.at(x, y)[c])) /
                                     std::max(double(exact.at(x, y)[c]), 0.01 * mean);
                if (!(error <= e.worst)) {
                    e.worst = error;
                    e.x = x;
                    e.y = y;
                }
                all.push_back(error);
                e.mean += error;
            }
    e.mean /= double(all.size());
    std::sort(all.begin(), all.end());
    e.median = all[all.size() / 2];
    e.p95 = all[size_t(0.95 * double(all.size()))];
    e.p99 = all[size_t(0.99 * double(all.size()))];
    return e;
}

inline void report(const char *name, const Errors &e)
{
    printf("%s: mean %.2e, median %.2e, 95 %% %.2e, worst %.2e at %d, %d\n", name, e.mean, e.median, e.p95, e.worst, e.x,
           e.y);
}

}  // namespace fog
