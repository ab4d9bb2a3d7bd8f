#pragma once
// A street at night in closed form, as cameras that turn see it.
#include <limits>

#include "lit_scene.h"

namespace fog {

// A camera at the origin, turned about +y, and an image of which focal and center are in pixels.
struct Shot {
    int width = 0, height = 0;
    double focal = 0, center_x = 0, center_y = 0, yaw = 0;

    // To planar depth 1.
    Vector ray(double x, double y) const
    {
        const double right = (x - center_x) / focal, up = (center_y - y) / focal, c = std::cos(yaw), s = std::sin(yaw);
        return {c * right - s, up, -s * right - c};
    }
    std::array<double, 2> pixel(const Vector &to) const
    {
        const double c = std::cos(yaw), s = std::sin(yaw), forward = -s * to[0] - c * to[2];
        return {center_x + focal * (c * to[0] - s * to[2]) / forward, center_y - focal * to[1] / forward};
    }
};

class Street {
public:
    // Colour is the mean over a pixel, depth that of the nearest thing in it: a lamp smaller than a pixel has its own.
    static Frame render(const Shot &shot)
    {
        Frame f{Picture(shot.width, shot.height, 4, 1), Picture(shot.width, shot.height, 1)};
        for (int y = 0; y < shot.height; ++y)
            for (int x = 0; x < shot.width; ++x) {
                const int n = near_lamp(shot.ray(x + 0.5, y + 0.5), 1.5 / shot.focal) ? 16 : 4;
                double light = 0, nearest = infinity;
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i) {
                        const auto [radiance, depth] = seen(shot.ray(x + (i + 0.5) / n, y + (j + 0.5) / n));
                        light += radiance / (n * n);
                        nearest = std::min(nearest, depth);
                    }
                std::fill_n(f.color.at(x, y), 3, float(light));
                f.depth.at(x, y)[0] = float(nearest);
            }
        return f;
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    struct Seen {
        double radiance, depth;
    };
    struct Lamp {
        Vector at;
        double radius;
    };
    struct Box {
        Vector low, high;
        double radiance;
    };
    static constexpr Lamp lamps[] = {{{-1, 1.8, -9}, 0.25}, {{5, 3, -14}, 0.25}, {{-5, 5, -24}, 0.25},
                                     {{4, 4, -40}, 0.25},   {{-3, 1, -60}, 0.3}, {{1, 0, -30}, 0.2}};
    static constexpr Box boxes[] = {{{-2.6, -1.6, -8}, {-1.4, 1.2, -7}, 0.05},
                                    {{8, -1.6, -50}, {20, 9, -30}, 0.1},
                                    {{-30, -1.6, -60}, {-10, 6, -35}, 0.2},
                                    {{2.2, -1.6, -6.5}, {2.4, 4, -6.3}, 0.02}};

    static double square(double v) { return v * v; }
    static double along(const Lamp &lamp, const Vector &ray)
    {
        double rr = 0, rc = 0, cc = 0;
        for (int k = 0; k < 3; ++k) {
            rr += ray[k] * ray[k];
            rc += ray[k] * lamp.at[k];
            cc += lamp.at[k] * lamp.at[k];
        }
        const double root = rc * rc - rr * (cc - lamp.radius * lamp.radius);
        return root < 0 || rc < 0 ? infinity : (rc - std::sqrt(root)) / rr;
    }
    static double along(const Box &box, const Vector &ray)
    {
        double from = 0, to = infinity;
        for (int k = 0; k < 3; ++k) {
            const double a = box.low[k] / ray[k], b = box.high[k] / ray[k];
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        return from < to ? from : infinity;
    }
    static bool near_lamp(const Vector &ray, double margin)
    {
        for (Lamp lamp : lamps) {
            lamp.radius += margin * std::hypot(lamp.at[0], lamp.at[1], lamp.at[2]);
            if (along(lamp, ray) < infinity)
                return true;
        }
        return false;
    }
    static Seen seen(const Vector &ray)
    {
        Seen s{0.01, infinity};
        if (ray[1] < 0) {
            const double t = -1.6 / ray[1], fine = std::exp(-square(t * t / 2000));
            s = {0.055 + 0.025 * fine * std::sin(ray[0] * t) * std::sin(ray[2] * t), t};
        }
        for (const Box &box : boxes)
            if (const double t = along(box, ray); t < s.depth)
                s = {box.radiance, t};
        for (const Lamp &lamp : lamps)
            if (const double t = along(lamp, ray); t < s.depth)
                s = {60, t};
        return s;
    }
};

}  // namespace fog
