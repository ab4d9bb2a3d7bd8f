#include <algorithm>
#include <array>
#include <cmath>

#include "sets.h"

using namespace brume::tool;

namespace trade {
namespace {

constexpr double kFov = 50;  // degrees, vertical

struct Random {
    std::mt19937 &engine;
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); }
    double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
    int integer(int a, int b) { return std::uniform_int_distribution<int>(a, b)(engine); }
};

struct Surface {
    double depth = 0;
    std::array<double, 3> radiance{};
};

std::array<double, 3> tinted(Random &r, double radiance)
{
    return {radiance * r.uniform(0.5, 1), radiance * r.uniform(0.5, 1), radiance * r.uniform(0.5, 1)};
}

struct Ball {
    double x, y, radius;  // in heights of the picture
    Surface surface;
};

double median(std::vector<float> values)
{
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

Json lights(Random &r, const Sample &sample)
{
    const double far = median(sample.depth);
    Json all = Json::array();
    const int count = r.integer(1, 5);
    for (int i = 0; i < count; ++i) {
        const double z = far * r.uniform(0.15, 1.1), side = z * std::tan(kFov / 2 * 3.14159265358979 / 180);
        all.push_back({{"type", "point"},
                       {"position", {r.uniform(-1.5, 1.5) * side, r.uniform(-0.9, 0.9) * side, -z}},
                       {"radius", 0.02 * z},
                       {"intensity", tinted(r, z * z * r.log_uniform(0.1, 3))}});
    }
    return all;
}

Json cross_sections(Random &r, double extinction)
{
    Json scattering = Json::array(), absorption = Json::array();
    const double albedo = r.uniform(0.8, 1);
    for (int c = 0; c < 3; ++c) {
        const double sigma = extinction * r.uniform(0.8, 1.2);
        scattering.push_back(sigma * albedo);
        absorption.push_back(sigma * (1 - albedo));
    }
    return {{"scattering", scattering}, {"absorption", absorption}};
}

Json exponential(Random &r, double far)
{
    return {{"type", "exponential"},
            {"value", r.uniform(0.5, 2)},
            {"falloff", r.uniform(0, 3) / far},
            {"direction", {r.uniform(-0.5, 0.5), 1, r.uniform(-0.5, 0.5)}}};
}

Json gaussians(Random &r, double far, int count)
{
    Json all = Json::array();
    for (int i = 0; i < count; ++i)
        all.push_back({{"type", "gaussian"},
                       {"center", {far * r.uniform(-0.5, 0.5), far * r.uniform(-0.3, 0.3), -far * r.uniform(0.2, 1)}},
                       {"scale", 1 / (far * r.log_uniform(0.03, 0.2))},
                       {"amplitude", r.log_uniform(0.3, 5)}});
    return all;
}

Json camera()
{
    return {{"vertical_fov", kFov}, {"camera_to_world", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
}

}  // namespace

Sample random_sample(std::mt19937 &engine, int width, int height)
{
    Random r{engine};
    Sample sample;
    sample.format.width = width;
    sample.format.height = height;
    sample.color.resize(3 * std::size_t(width) * std::size_t(height));
    sample.depth.resize(std::size_t(width) * std::size_t(height));
    const double far = r.log_uniform(10, 100), horizon = r.uniform(0.3, 0.6);
    const int kind = r.integer(0, 2);
    std::vector<Surface> slabs;
    for (int i = 0; i < 7; ++i)
        slabs.push_back({far * r.log_uniform(0.1, 1), tinted(r, r.log_uniform(0.02, 1))});
    std::vector<Ball> balls;
    for (int i = 0; i < (kind == 2 ? 8 : 0); ++i)
        balls.push_back({r.uniform(0, 1.8),
                         r.uniform(0, 1),
                         r.uniform(0.05, 0.2),
                         {far * r.log_uniform(0.1, 0.9), tinted(r, r.log_uniform(0.02, 1))}});
    // Lamps: small and far brighter than the rest.
    for (int i = r.integer(1, 6); i > 0; --i)
        balls.push_back({r.uniform(0, 1.8),
                         r.uniform(0, 1),
                         r.log_uniform(0.006, 0.04),
                         {far * r.log_uniform(0.05, 0.9), tinted(r, r.log_uniform(5, 200))}});
    const Surface wall{far, tinted(r, 0.1)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = (x + 0.5) / height, v = (y + 0.5) / height;
            Surface seen = wall;
            if (kind == 0)
                seen = slabs[std::size_t(7 * x / width)];
            else if (kind == 1 && v > horizon)
                seen.depth = std::min(far, 0.05 * far / (v - horizon));
            const double chequer = (x / 8 + y / 8) % 2 ? 1 : 0.5;
            for (double &radiance : seen.radiance)
                radiance *= chequer;
            for (const Ball &ball : balls)
                if (std::hypot(u - ball.x, v - ball.y) < ball.radius && ball.surface.depth < seen.depth)
                    seen = ball.surface;
            const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
            sample.depth[i] = float(seen.depth);
            std::copy(seen.radiance.begin(), seen.radiance.end(), sample.color.begin() + std::ptrdiff_t(3 * i));
        }
    return sample;
}

Json random_foggy_scene(std::mt19937 &engine, const Sample &sample)
{
    Random r{engine};
    const double far = median(sample.depth);
    Json medium = cross_sections(r, r.log_uniform(0.2, 5) / far);
    medium["g"] = r.uniform(0, 0.9);
    if (r.integer(0, 2) == 0)
        medium["density"] = {exponential(r, far)};
    return {{"brume", 1}, {"camera", camera()}, {"medium", medium}, {"effects", {{"multiscatter", Json::object()}}}};
}

Json random_lit_scene(std::mt19937 &engine, const Sample &sample, Air air)
{
    Random r{engine};
    const double far = median(sample.depth);
    Json medium = cross_sections(r, r.log_uniform(0.1, 4) / far);
    if (air != Air::kHomogeneous) {
        medium["density"] = gaussians(r, far, air == Air::kGaussians ? 20 : 6);
        medium["density"].push_back({{"type", "constant"}, {"value", 0.2}});
    }
    if (air == Air::kAny) {
        medium["g"] = r.uniform(0.3, 0.9);
        medium["density"].push_back(exponential(r, far));
    }
    return {{"brume", 1},
            {"camera", camera()},
            {"medium", medium},
            {"lights", lights(r, sample)},
            {"effects", {{"airlight", Json::object()}}}};
}

}  // namespace trade
