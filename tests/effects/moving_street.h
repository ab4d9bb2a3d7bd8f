#pragma once
// A foggy street as a camera that moves sees it, and what changes from frame to frame.
#include <cmath>
#include <cstdio>
#include <string>

#include "street.h"

namespace moving_street {

using namespace fog;

inline constexpr int width = 160, height = 90;

inline Shot shot()
{
    return {width, height, 0.5 * height / std::tan(25 * 3.14159265358979323846 / 180), 0.5 * width, 0.5 * height, 0};
}

inline std::string foggy(const std::string &parameters)
{
    return scene("\"scattering\":0.03,\"g\":0.8", parameters);
}

// Of fog's light between consecutive frames: |b - a| / sqrt(a^2 + (m / 20)^2), m the mean of a.
struct Changes {
    double worst = 0, sum = 0;
    size_t count = 0;
    int x = 0, y = 0, frame = 0;

    double add(double a, double b, double mean, int at_x, int at_y, int at_frame)
    {
        const double change = std::abs(b - a) / std::hypot(a, mean / 20);
        sum += change;
        ++count;
        if (change > worst) {
            worst = change;
            x = at_x;
            y = at_y;
            frame = at_frame;
        }
        return change;
    }
    double mean() const { return sum / double(count); }
    void print(const std::string &what) const
    {
        printf("%s: mean change %.2f %%, worst %.1f %% at (%d, %d) of frame %d\n", what.c_str(), 100 * mean(), 100 * worst,
               x, y, frame);
    }
};

inline double mean_of(const Picture &p)
{
    double sum = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            sum += p.at(x, y)[1] / (double(p.width) * p.height);
    return sum;
}

inline Picture fog_light(const Plan &plan, const Shot &s, const Frame &f)
{
    brume_camera c = camera(pose({0, 0, 0}, s.yaw), 50);
    c.center[0] = s.center_x / s.width;
    Options options{{}, {"scattered"}};
    options.camera = &c;
    return plan.execute(f.color, f.depth, options).scattered;
}

}  // namespace moving_street
