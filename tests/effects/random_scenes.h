#pragma once
// Scenes and frames at random, as a user's might be: media, depths, lights and sizes. The same seed, the same scene.
#include "lit_scene.h"

namespace fog {

struct RandomScene {
    Json scene;
    Frame frame;
};

class RandomScenes {
public:
    explicit RandomScenes(unsigned seed, int largest = 96) : random_(seed), largest_(largest) {}

    RandomScene next(bool lit)
    {
        RandomScene s;
        distance_ = logarithmic(5, 200);
        const int width = int(logarithmic(largest_ / 3.0, largest_)),
                  height = int(logarithmic(largest_ / 4.0, largest_ / 1.5));
        s.frame = {Picture(width, height, 4), Picture(width, height, 1)};
        draw_depth(s.frame.depth);
        draw_color(s.frame);
        s.scene = {{"brume", 1},
                   {"camera", {{"vertical_fov", uniform(25, 80)}, {"camera_to_world", pose({0, 2, 0}, uniform(-3, 3))}}},
                   {"medium", medium()}};
        if (lit)
            for (int i = 0, n = 1 + int(uniform(0, 3)); i < n; ++i)
                s.scene["lights"].push_back(light(s.scene["camera"]["camera_to_world"]));
        return s;
    }

private:
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
    double logarithmic(double a, double b) { return a * std::pow(b / a, uniform(0, 1)); }
    bool one_in(double n) { return uniform(0, n) < 1; }

    // A floor or a wall, boxes and balls in front of it, maybe a sky.
    void draw_depth(Picture &depth)
    {
        const bool floor = one_in(2), sky = one_in(3);
        const int horizon = int(depth.height * uniform(0.2, 0.5));
        for (int y = 0; y < depth.height; ++y)
            for (int x = 0; x < depth.width; ++x) {
                double d = distance_;
                if (floor && y > horizon)
                    d = std::min(d, 0.4 * distance_ * 0.5 * depth.height / (y - horizon));
                if (sky && y < horizon)
                    d = INFINITY;
                depth.at(x, y)[0] = float(d);
            }
        for (int i = 0, n = int(uniform(1, 7)); i < n; ++i) {
            const double cx = uniform(0, depth.width), cy = uniform(0, depth.height),
                         r = depth.height * logarithmic(0.04, 0.4), d = distance_ * logarithmic(0.05, 0.9);
            const bool ball = one_in(2);
            for (int y = 0; y < depth.height; ++y)
                for (int x = 0; x < depth.width; ++x) {
                    const double ax = (x - cx) / r, ay = (y - cy) / r, q = ax * ax + ay * ay;
                    if (ball ? q < 1 : std::abs(ax) < 0.5 && std::abs(ay) < 1.5)
                        depth.at(x, y)[0] = std::min(depth.at(x, y)[0], float(ball ? d * (1 - 0.02 * std::sqrt(1 - q)) : d));
                }
        }
    }

    // Textures of different scales, by depth, and a few lamps.
    void draw_color(Frame &f)
    {
        const double grain = logarithmic(1, 20), contrast = uniform(0, 0.9), level = logarithmic(0.05, 2);
        const Vector tint{uniform(0.4, 1), uniform(0.4, 1), uniform(0.4, 1)};
        for (int y = 0; y < f.color.height; ++y)
            for (int x = 0; x < f.color.width; ++x) {
                const double d = f.depth.at(x, y)[0], k = std::isfinite(d) ? d / distance_ : 3;
                const double pattern = 1 + contrast * std::sin(x / grain + 9 * k) * std::cos(y / grain - 5 * k);
                for (size_t c = 0; c < 3; ++c)
                    f.color.at(x, y)[c] =
                        float(level * tint[c] * pattern * (0.3 + 0.7 * std::abs(std::sin(7 * k + double(c)))));
                f.color.at(x, y)[3] = 1;
            }
        for (int i = 0, n = int(uniform(0, 6)); i < n; ++i) {
            const int cx = int(uniform(0, f.color.width)), cy = int(uniform(0, f.color.height)), r = int(uniform(0, 2.5));
            const double strength = level * logarithmic(5, 200);
            for (int y = std::max(0, cy - r); y <= std::min(f.color.height - 1, cy + r); ++y)
                for (int x = std::max(0, cx - r); x <= std::min(f.color.width - 1, cx + r); ++x)
                    for (size_t c = 0; c < 3; ++c)
                        f.color.at(x, y)[c] = float(strength * (0.5 + 0.5 * tint[2 - c]));
        }
    }

    Json medium()
    {
        const double extinction = logarithmic(0.1, 6) / distance_, albedo = one_in(2) ? 1 : uniform(0.7, 1);
        const double phases[] = {0, 0, 0.3, 0.6, 0.8, 0.9};
        Json m{{"g", phases[int(uniform(0, 6))]}};
        const bool coloured = one_in(2);
        for (int c = 0; c < 3; ++c) {
            const double s = extinction * (coloured ? logarithmic(0.5, 1.6) : 1);
            m["scattering"].push_back(s * albedo);
            m["absorption"].push_back(s * (1 - albedo));
        }
        if (const int kind = int(uniform(0, 4)); kind == 2) {
            m["density"] = {{{"type", "exponential"},
                             {"value", uniform(0.5, 2)},
                             {"falloff", logarithmic(0.2, 4) / distance_},
                             {"direction", {uniform(-0.2, 0.2), 1, 0}}}};
        } else if (kind == 3) {
            m["density"] = random_gaussians(int(uniform(1, 12)), random_(), distance_, 0.5 * distance_, 4);
            m["density"].push_back(constant(uniform(0, 0.5)));
        }
        return m;
    }

    Json light(const Json &camera_to_world)
    {
        const double d = distance_ * logarithmic(0.1, 1), x = d * uniform(-0.6, 0.6), y = d * uniform(-0.3, 0.4);
        Vector at;
        for (size_t i = 0; i < 3; ++i)
            at[i] = camera_to_world[i][0].get<double>() * x + camera_to_world[i][1].get<double>() * y -
                    camera_to_world[i][2].get<double>() * d + camera_to_world[i][3].get<double>();
        return point_light(at, logarithmic(0.01, 1) * distance_ * distance_, logarithmic(0.002, 0.02) * distance_);
    }

    std::mt19937 random_;
    int largest_;
    double distance_ = 1;  // of the background
};

}  // namespace fog
