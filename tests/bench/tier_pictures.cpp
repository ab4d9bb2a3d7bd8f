// Pictures of docs/airlight.md: a street lit by four lanterns through each tier, and below each how far it is from the
// reference.
//
//   tier_pictures FRAME.exr FOLDER
//
// Writes FOLDER/airlight_blobs.png (fogshop, nodes; twelve Gaussians) and FOLDER/airlight_homogeneous.png (sun, nodes).
// Errors are |tier - reference| / reference of the airlight's green, by decades: a colour for each from 1e-7 to 1.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "canvas.h"
#include "exr.h"
#include "lit_scene.h"

using namespace fog;

namespace {

constexpr int reduction = 3, gap = 2, legend = 6;

// Colour is averaged, depth is not.
Frame reduced_frame(const std::string &file)
{
    const Picture color = read_exr(file, {"R", "G", "B", "A"}), depth = read_exr(file, {"Z"});
    Frame f{Picture(color.width / reduction, color.height / reduction, 4),
            Picture(color.width / reduction, color.height / reduction, 1)};
    for (int y = 0; y < f.depth.height; ++y)
        for (int x = 0; x < f.depth.width; ++x) {
            for (int c = 0; c < 4; ++c)
                for (int i = 0; i < reduction * reduction; ++i)
                    f.color.at(x, y)[c] +=
                        color.at(reduction * x + i % reduction, reduction * y + i / reduction)[c] / (reduction * reduction);
            f.depth.at(x, y)[0] = depth.at(reduction * x + reduction / 2, reduction * y + reduction / 2)[0];
        }
    return f;
}

// The camera and the lanterns of samples/frames, and a medium of isotropic scattering.
Json street(const Json &medium)
{
    Json scene = lit_scene(medium, Json::array());
    scene["camera"] = {{"vertical_fov", 41.11},
                       {"camera_to_world", {{1, 0, 0, -1.75}, {0, 0, -1, 0}, {0, 1, 0, 1.7}, {0, 0, 0, 1}}}};
    for (const Vector &at : {Vector{-4.5, 9.5, 3.74}, {4.5, 17.5, 3.74}, {-4.5, 26, 3.74}, {4.507, 34, 3.74}}) {
        Json lantern = point_light(at, 0, 0.13);
        lantern["intensity"] = {91, 61, 33};
        scene["lights"].push_back(lantern);
    }
    return scene;
}

Json bank()
{
    std::mt19937 random(4);
    auto uniform = [&](double a, double b) { return a + (b - a) * double(random() % 65536u) / 65536; };
    Json density{constant(0.01)};
    for (int i = 0; i < 12; ++i) {
        const double radius = uniform(1, 2.2);
        density.push_back(gaussian({uniform(-5, 4), 9 + 2.2 * i, uniform(0.3, 2.5)}, 1 / radius, uniform(0.15, 0.5)));
    }
    return {{"scattering", {1, 1, 1.03}}, {"density", density}};
}

Result through(const char *tier, Json scene, const Frame &frame)
{
    scene["effects"]["airlight"] = {{"tier", tier}};
    return run(cpu(), scene.dump(), frame.color, frame.depth, Options{{}, {"airlight"}});
}

// Black, violet, blue, cyan, green, yellow, red, white: up to 1e-7, 1e-6, ... 1e-1, above.
const double decades[8][3] = {{0, 0, 0},         {0.1, 0, 0.2},   {0.02, 0.05, 0.6}, {0, 0.4, 0.7},
                              {0.05, 0.5, 0.05}, {0.9, 0.8, 0.1}, {0.8, 0.05, 0.02}, {1, 1, 1}};

int decade(double error)
{
    return error > 1e-7 ? std::clamp(int(std::floor(std::log10(error))) + 8, 1, 7) : 0;
}

void draw(const std::string &file, const Json &scene, const std::vector<const char *> &tiers, const Frame &frame)
{
    const Picture reference = through("reference", scene, frame).airlight;
    const int w = frame.depth.width, h = frame.depth.height, columns = int(tiers.size());
    Canvas canvas(columns * w + (columns - 1) * gap, 2 * h + 2 * gap + legend, 2);
    for (int k = 0; k < columns; ++k) {
        const Result r = through(tiers[size_t(k)], scene, frame);
        double sum = 0;
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                double shown[3];
                for (int c = 0; c < 3; ++c)
                    shown[c] = 1 - std::exp(-1.5 * double(r.output.at(x, y)[c]));
                canvas.set(k * (w + gap) + x, y, shown);
                const double exact = double(reference.at(x, y)[1]),
                             error = std::abs(double(r.airlight.at(x, y)[1]) - exact) / exact;
                sum += error;
                canvas.set(k * (w + gap) + x, h + gap + y, decades[decade(error)]);
            }
        printf("%s, %s: mean relative error %.2g\n", file.c_str(), tiers[size_t(k)], sum / w / h);
    }
    const int whole = columns * w + (columns - 1) * gap;
    for (int x = 0; x < whole; ++x)
        for (int y = 0; y < legend; ++y)
            canvas.set(x, 2 * h + 2 * gap + y, decades[x * 8 / whole]);
    canvas.write(file);
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 3) {
        std::cerr << "usage: tier_pictures FRAME.exr FOLDER\n";
        return 2;
    }
    const Frame frame = reduced_frame(argv[1]);
    const std::string folder = argv[2];
    draw(folder + "/airlight_homogeneous.png", street({{"scattering", {0.03, 0.03, 0.031}}}), {"sun", "nodes"}, frame);
    draw(folder + "/airlight_blobs.png", street(bank()), {"fogshop", "nodes"}, frame);
}
