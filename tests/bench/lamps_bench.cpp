// What more lamps cost tier `nodes` on a street, by how dense its fog is and in which order they are listed.
//
//   lamps_bench FRAME.exr
#include <ctime>
#include <iostream>

#include <fmt/format.h>

#include "exr.h"
#include "lit_scene.h"
#include "maths.hpp"

using namespace fog;
using brume::maths_double::vec3;

namespace {

constexpr double height = 1.7, aside = -1.75, field = 41.11;  // of the camera of samples/frames

vec3 lamp_at(int i, int count)
{
    return vec3(i % 2 ? 4.5 : -4.5, 9.5 + (count > 8 ? 2 : 8) * i, 3.74);
}

// The medium of samples/frames/street.json; `density` times as dense.
Json street(int lamps, double density)
{
    const Json up{0, 0, 1};
    Json scene = lit_scene({{"scattering", {0.03 * density, 0.03 * density, 0.032 * density}},
                            {"g", 0.8},
                            {"density",
                             {{{"type", "exponential"}, {"value", 0.6}, {"falloff", 0.06}, {"direction", up}},
                              {{"type", "exponential"}, {"value", 1}, {"falloff", 0.3}, {"direction", up}}}}},
                           Json::array(), {{"orders", "single"}, {"tier", "nodes"}});
    scene["camera"] = {{"vertical_fov", field},
                       {"camera_to_world", {{1, 0, 0, aside}, {0, 0, -1, 0}, {0, 1, 0, height}, {0, 0, 0, 1}}}};
    for (int i = 0; i < lamps; ++i) {
        const vec3 p = lamp_at(i, lamps);
        Json lantern = point_light({p.x, p.y, p.z}, 0, 0.13);
        lantern["intensity"] = {91, 61, 33};
        scene["lights"].push_back(lantern);
    }
    return scene;
}

// Milliseconds of CPU time, the least of three.
double gathered_in(const Json &scene, const Frame &frame)
{
    const Options options{{}, {"airlight"}};
    const Plan plan(cpu(), scene.dump(), frame.color.width, frame.color.height, options);
    double least = 1e30;
    for (int round = 0; round < 3; ++round) {
        const std::clock_t start = std::clock();
        plan.execute(frame.color, frame.depth, options);
        least = std::min(least, 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::cerr << "usage: lamps_bench FRAME.exr\n";
        return 2;
    }
    const Frame frame{read_exr(argv[1], {"R", "G", "B", "A"}), read_exr(argv[1], {"Z"})};
    fmt::print("{} x {}, tier nodes, scattered once\n\n"
               "| scattering [1/m] | lamps | CPU ms | times one lamp | farthest first |\n"
               "| ---: | ---: | ---: | ---: | ---: |\n",
               frame.color.width, frame.color.height);
    for (double density : {1.0, 4.0, 16.0}) {
        double one = 0;
        for (int lamps : {1, 8, 64}) {
            Json scene = street(lamps, density);
            const double nearest_first = gathered_in(scene, frame);
            std::reverse(scene["lights"].begin(), scene["lights"].end());
            one = lamps == 1 ? nearest_first : one;
            fmt::print("| {:.2f} | {} | {:.0f} | {:.1f} | {:.1f} |\n", 0.03 * density, lamps, nearest_first,
                       nearest_first / one, gathered_in(scene, frame) / one);
            std::cout << std::flush;
        }
    }
}
