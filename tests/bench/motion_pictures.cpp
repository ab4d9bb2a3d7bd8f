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
#include "moving_street.h"

using namespace fog;
using namespace moving_street;

namespace {

constexpr int frames = 17, gap = 2;

Shot window(int frame)
{
    Shot s = shot();
    s.center_x += 16 - frame;
    return s;
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
    const Frame first = Street::render(window(0));
    const Picture seen = run(cpu(), foggy(""), first.color, first.depth).output;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double shown[3];
            for (int c = 0; c < 3; ++c)
                shown[c] = 1 - std::exp(-1.5 * double(seen.at(x, y)[c]));
            canvas.set(x, y, shown);
        }
    for (int k = 0; k < 3; ++k) {
        // Directions are columns of the first frame; the last frames no longer see the first ones.
        const std::string parameters = "\"resolution\":\"" + resolutions[k] + "\"";
        const Plan plan(cpu(), foggy(parameters), width, height, {{}, {"scattered"}});
        Picture most(width, height, 1), before;
        Changes changes;
        for (int frame = 0; frame < frames; ++frame) {
            const Picture now = fog_light(plan, window(frame), Street::render(window(frame)));
            const double mean = mean_of(now);
            for (int y = 0; y < height && frame > 0; ++y)
                for (int x = 0; x + 1 < width; ++x) {
                    const double change = changes.add(before.at(x + 1, y)[1], now.at(x, y)[1], mean, x, y, frame);
                    if (x + frame < width)
                        most.at(x + frame, y)[0] = std::max(most.at(x + frame, y)[0], float(change));
                }
            before = now;
        }
        changes.print("resolution " + resolutions[k]);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double v = 10 * double(most.at(x, y)[0]);
                canvas.set((k + 1) % 2 * (width + gap) + x, (k + 1) / 2 * (height + gap) + y, {v, v, v});
            }
    }
    canvas.write(std::string(argv[1]) + "/resolution.png");
}
