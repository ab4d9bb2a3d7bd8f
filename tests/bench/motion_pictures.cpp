// What multiscatter's resolution changes where a picture moves: a picture of docs/accuracy.md.
//
//   motion_pictures FOLDER
//
// Writes FOLDER/resolution.png: a street seen through a window that moves by a pixel a frame, and for resolution full, half
// and quarter the largest change of a direction's light out of the fog from one frame to the next: black none, white a
// tenth.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "canvas.h"
#include "fog.h"
#include "street.h"

using namespace fog;

namespace {

constexpr int width = 160, height = 90, frames = 17, gap = 2;

Shot shot(int frame)
{
    const double pi = 3.14159265358979323846;
    return {width, height, 0.5 * height / std::tan(25 * pi / 180), 0.5 * width + 16 - frame, 0.5 * height, 0};
}

Result fogged(const std::string &resolution, const Shot &s)
{
    const Frame frame = Street::render(s);
    brume_camera c = camera(pose({0, 0, 0}, s.yaw), 50);
    c.center[0] = s.center_x / s.width;
    Options options{{}, {"scattered"}};
    options.camera = &c;
    const std::string text = scene("\"scattering\":0.03,\"g\":0.8", "\"resolution\":\"" + resolution + "\"");
    return Plan(cpu(), text, width, height, options).execute(frame.color, frame.depth, options);
}

double mean_of(const Picture &p)
{
    double sum = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            sum += p.at(x, y)[1] / (double(p.width) * p.height);
    return sum;
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::cerr << "usage: motion_pictures FOLDER\n";
        return 2;
    }
    const std::string resolutions[] = {"full", "half", "quarter"};
    Canvas canvas(2 * width + gap, 2 * height + gap, 2);
    const Picture seen = fogged("full", shot(0)).output;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double shown[3];
            for (int c = 0; c < 3; ++c)
                shown[c] = 1 - std::exp(-1.5 * double(seen.at(x, y)[c]));
            canvas.set(x, y, shown);
        }
    for (int k = 0; k < 3; ++k) {
        // Directions are columns of the first frame; the last frames no longer see the first ones.
        Picture most(width, height, 1), before;
        double sum = 0, worst = 0;
        for (int frame = 0; frame < frames; ++frame) {
            const Picture now = fogged(resolutions[k], shot(frame)).scattered;
            const double mean = mean_of(now);
            for (int y = 0; y < height && frame > 0; ++y)
                for (int x = 0; x + 1 < width; ++x) {
                    const double a = before.at(x + 1, y)[1], b = now.at(x, y)[1],
                                 change = std::abs(b - a) / std::hypot(a, mean / 20);
                    if (x + frame < width)
                        most.at(x + frame, y)[0] = std::max(most.at(x + frame, y)[0], float(change));
                    sum += change / (double(frames - 1) * (width - 1) * height);
                    worst = std::max(worst, change);
                }
            before = now;
        }
        printf("resolution %s: mean change %.2f %%, worst %.1f %%\n", resolutions[k].c_str(), 100 * sum, 100 * worst);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double v = 10 * double(most.at(x, y)[0]);
                canvas.set((k + 1) % 2 * (width + gap) + x, (k + 1) / 2 * (height + gap) + y, {v, v, v});
            }
    }
    canvas.write(std::string(argv[1]) + "/resolution.png");
}
