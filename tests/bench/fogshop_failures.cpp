// A picture of docs/airlight.md: what Fogshop's paper says that its method fails at (Fig. 7), by that method, by others and
// by the reference.
//
//   fogshop_failures FOLDER
//
// Writes FOLDER/fogshop_failures.png: a lamp close to puffs, and a tube of cloud around a lamp, pierced by a hole through
// which a shaft of light falls into thin fog. Tiers fogshop, maps and nodes from left to right, then the reference; below
// each tier |tier - reference| as bright as the picture.
#include <cmath>
#include <iostream>
#include <numbers>

#include "canvas.h"
#include "lit_scene.h"

using namespace fog;

namespace {

constexpr int width = 64, height = 48, gap = 1;
constexpr const char *tiers[] = {"fogshop", "maps", "nodes"};

// What is close to black and white in all pictures.
double shown(double radiance)
{
    return 1 - std::exp(-radiance);
}

Json lamp_beside_puffs()
{
    Json density;
    for (int i = 0; i < 7; ++i) {
        const double turn = 2 * std::numbers::pi * i / 7;
        density.push_back(
            gaussian({1.5 * std::cos(turn), 1.1 * std::sin(turn), -6 + 0.5 * std::sin(3 * turn)}, 1 / 0.9, 0.5));
    }
    return lit_scene({{"scattering", 0.6}, {"density", density}}, Json::array({point_light({0.3, 0.2, -6}, 12, 0.05)}));
}

Json pierced_tube()
{
    Json density{constant(0.05)};
    constexpr int around = 10, along = 7;
    for (int i = 0; i < along; ++i)
        for (int k = 0; k < around; ++k) {
            const double turn = 2 * std::numbers::pi * k / around, x = 0.6 * (i - along / 2);
            // The hole, as the camera sees it above the middle.
            if (i == along / 2 && std::abs(k - around / 4) <= 1)
                continue;
            density.push_back(gaussian({x, std::sin(turn) - 0.9, -6 + std::cos(turn)}, 1 / 0.45, 3));
        }
    return lit_scene({{"scattering", 0.8}, {"density", density}}, Json::array({point_light({0, -1.3, -6}, 40, 0.05)}));
}

Picture airlight(Json scene, const char *tier)
{
    scene["effects"]["airlight"] = {{"tier", tier}};
    const Picture black(width, height, 4, 0), depth(width, height, 1, 12);
    return run(cpu(), scene.dump(), black, depth, Options{{}, {"airlight"}}).airlight;
}

void draw(Canvas &canvas, int top, const char *name, const Json &scene)
{
    const Picture reference = airlight(scene, "reference");
    double mean = 0;
    for (int i = 0; i < width * height; ++i)
        mean += double(reference.at(i % width, i / width)[1]) / (width * height);
    const auto put = [&](int column, int y, int x, double value) {
        const double grey = shown(0.3 * value / mean);
        canvas.set(column * (width + gap) + x, y, {grey, grey, grey});
    };
    for (int column = 0; column <= int(std::size(tiers)); ++column) {
        const bool exact = column == int(std::size(tiers));
        const Picture of = exact ? reference : airlight(scene, tiers[column]);
        double sum = 0, most = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double value = double(of.at(x, y)[1]), off = std::abs(value - double(reference.at(x, y)[1]));
                put(column, top + y, x, value);
                if (!exact)
                    put(column, top + height + gap + y, x, off);
                sum += off / mean / (width * height);
                most = std::max(most, off / mean);
            }
        if (!exact)
            printf("%s, %s: |difference| %.2g of the picture's mean in the mean, %.2g at most\n", name, tiers[column], sum,
                   most);
    }
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::cerr << "usage: fogshop_failures FOLDER\n";
        return 2;
    }
    Canvas canvas(4 * width + 3 * gap, 4 * height + 3 * gap, 4);
    draw(canvas, 0, "a lamp beside puffs", lamp_beside_puffs());
    draw(canvas, 2 * (height + gap), "a pierced tube", pierced_tube());
    canvas.write(std::string(argv[1]) + "/fogshop_failures.png");
}
