// What more lamps cost tier `nodes` on a street, and how much of that a cut by tiles could spare: lamps left out where all
// of them together are a given share of the light that a tile's middle has of the others, were that known exactly, or by a
// bound.
//
//   lamps_bench FRAME.exr
#include <ctime>
#include <iostream>

#include <fmt/format.h>

#include "exr.h"
#include "lit_scene.h"
#include "maths.hpp"

using namespace fog;
namespace f64 = brume::maths_double;
using f64::vec3;

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

f64::Medium medium_of_street(double density)
{
    f64::Medium m{};
    m.scattering = vec3(0.03 * density);
    m.asymmetry = 0.8;
    m.phase = f64::vec4(0.8, 0, 0, 0);
    m.term_count = 2;
    m.terms[0] = f64::vec4(0, 0.06, 0, std::log(0.6) - 0.06 * height);
    m.terms[1] = f64::vec4(0, 0.3, 0, -0.3 * height);
    return m;
}

// Of one lamp, for intensity 1: what the ray has of it, and a bound on that of all rays within an angle of it. The bound
// takes the medium's greatest density, the lamp's least distance, its light's least turn and the least depth along the
// straight ways.
struct Sent {
    double exact, bound;
};

Sent sent_by(const f64::Medium &medium, const f64::Light &light, const vec3 &direction, double distance, double angle)
{
    constexpr int steps = 200;
    const f64::TermEnds ends = f64::term_ends(medium, light);
    const f64::Aspect aspect = f64::aspect_of(light, direction);
    const double sigma = medium.scattering.x, step = distance / steps;
    double sum = 0, most = 0, nearest = 1e30, least_depth = 1e30;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) * step;
        const f64::TermsAt at = f64::terms_at(medium, ends, light, direction, t);
        const double depth = sigma * (at.from_camera + at.from_light);
        sum += step * at.density * sigma * f64::lit_strength(medium, light, aspect, direction, t) * std::exp(-depth);
        most = std::max(most, at.density);
        nearest = std::min(nearest, std::max(glm::length(light.position - t * direction) - t * angle, light.radius));
        least_depth = std::min(least_depth, depth);
    }
    // Light is turned least where it comes to the camera.
    const double turn = std::acos(glm::clamp(glm::dot(light.position, direction) / glm::length(light.position), -1.0, 1.0));
    const double phase = f64::phase(medium, std::cos(std::max(turn - angle, 0.0)));
    return {sum,
            sigma * most * phase * std::min(f64::pi / nearest, distance / (nearest * nearest)) * std::exp(-least_depth)};
}

// The mean share of the lamps that is left.
struct Kept {
    double exact = 0, bound = 0;
};

double kept_of(std::vector<double> sent, double allowed)
{
    std::sort(sent.begin(), sent.end());
    double cut = 0;
    size_t gone = 0;
    while (gone < sent.size() && cut + sent[gone] <= allowed)
        cut += sent[gone++];
    return double(sent.size() - gone) / double(sent.size());
}

Kept kept(int lamps, double density, double share, const Picture &depth)
{
    const f64::Medium medium = medium_of_street(density);
    const double tangent = std::tan(field * f64::pi / 360) * 2 / depth.height;
    constexpr int tile = 16;
    Kept all;
    int tiles = 0;
    for (int y = tile / 2; y < depth.height; y += tile)
        for (int x = tile / 2; x < depth.width; x += tile, ++tiles) {
            const vec3 through((x + 0.5 - 0.5 * depth.width) * tangent, -(y + 0.5 - 0.5 * depth.height) * tangent, -1);
            const double far = std::min(double(*depth.at(x, y)), 1000.0) * glm::length(through);
            std::vector<double> exact, bound;
            double sum = 0;
            for (int i = 0; i < lamps; ++i) {
                f64::Light light{};
                const vec3 p = lamp_at(i, lamps);
                light.position = vec3(p.x - aside, p.z - height, -p.y);
                light.radius = 0.13;
                light.intensity = vec3(1);
                const Sent sent =
                    sent_by(medium, light, through / glm::length(through), far, tile / std::sqrt(2.0) * tangent);
                exact.push_back(sent.exact);
                bound.push_back(sent.bound);
                sum += sent.exact;
            }
            all.exact += kept_of(exact, share * sum);
            all.bound += kept_of(bound, share * sum);
        }
    return {all.exact / tiles, all.bound / tiles};
}

}  // namespace

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::cerr << "usage: lamps_bench FRAME.exr\n";
        return 2;
    }
    const Frame frame{read_exr(argv[1], {"R", "G", "B", "A"}), read_exr(argv[1], {"Z"})};
    fmt::print("{} x {}, tier nodes, scattered once\n\n| lamps | CPU ms | times one lamp | farthest first |\n"
               "| ---: | ---: | ---: | ---: |\n",
               frame.color.width, frame.color.height);
    double one = 0;
    for (int lamps : {1, 8, 64}) {
        Json scene = street(lamps, 1);
        const double nearest_first = gathered_in(scene, frame);
        std::reverse(scene["lights"].begin(), scene["lights"].end());
        one = lamps == 1 ? nearest_first : one;
        fmt::print("| {} | {:.0f} | {:.1f} | {:.1f} |\n", lamps, nearest_first, nearest_first / one,
                   gathered_in(scene, frame) / one);
        std::cout << std::flush;
    }
    fmt::print("\nShare of lamps that tiles keep, the rest being so much of their light: exactly known, by a bound\n\n"
               "| scattering [1/m] | lamps | 1e-4 | 1e-3 | 1e-2 |\n| ---: | ---: | ---: | ---: | ---: |\n");
    for (double density : {1.0, 4.0, 16.0})
        for (int lamps : {8, 64}) {
            fmt::print("| {:.2f} | {} |", 0.03 * density, lamps);
            for (double share : {1e-4, 1e-3, 1e-2}) {
                const Kept k = kept(lamps, density, share, frame.depth);
                fmt::print(" {:.2f}, {:.2f} |", k.exact, k.bound);
            }
            fmt::print("\n");
            std::cout << std::flush;
        }
}
