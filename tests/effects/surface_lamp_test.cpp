// What lamps give surfaces, as the CPU and shaders work it out: for pixels side by side, with what media settle taken out of
// it.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "lit_scene.h"
#include "maths.hpp"
#include "relit.h"

using namespace fog;

namespace {

namespace f32 = brume::maths_float;
namespace f64 = brume::maths_double;

// By the mean cosine of what was scattered, and what came straight.
double net_of_parts(double scattering, double absorption, double g)
{
    const f64::Rescattered r = f64::rescattered(scattering, absorption, g);
    return r.fluence * r.cosine + std::exp(-scattering - absorption);
}

// Everything that may differ from one pixel to the next: sky, surfaces near and far, normals of all ways and none.
struct Mixed {
    static constexpr int width = 43, height = 9;
    Picture color{width, height, 4}, depth{width, height, 1}, normal{width, height, 3}, albedo{width, height, 3},
        specular{width, height, 3}, roughness{width, height, 1};
    std::vector<Picture> groups{Picture(width, height, 3), Picture(width, height, 3), Picture(width, height, 3)};

    Mixed()
    {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> u(0, 1);
        for (Picture *p : {&color, &normal, &albedo, &specular, &roughness, &groups[0], &groups[1], &groups[2]})
            for (float &v : p->data)
                v = u(random);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                *depth.at(x, y) = u(random) < 0.2f ? INFINITY : std::exp(4 * u(random));
                for (int c = 0; c < 3; ++c)
                    normal.at(x, y)[c] = (x + y) % 11 == 0 ? 0 : 2 * normal.at(x, y)[c] - 1;
            }
        *roughness.at(5, 2) = std::numeric_limits<float>::quiet_NaN();
        *albedo.at(6, 2) = std::numeric_limits<float>::infinity();
    }
    std::map<std::string, Picture> layers(int parts) const
    {
        std::map<std::string, Picture> named;
        if (parts > 0)
            named["normal"] = normal;
        if (parts > 1)
            named["albedo"] = albedo;
        if (parts > 2) {
            named["specular"] = specular;
            named["roughness"] = roughness;
        }
        return named;
    }
};

Json three_lamps()
{
    Json spot = point_light({2, 3, -8}, 100, 0.2);
    spot["type"] = "spot";
    spot["direction"] = {-0.2, -1, -0.1};
    spot["angle"] = 50;
    spot["penumbra"] = 0.3;
    return {point_light({-1.5, 2, -6}, 40, 0.1), point_light({3, -1, -14}, 200), spot};
}

const Json media[] = {{{"scattering", 0.05}, {"g", 0.8}},
                      {{"scattering", {0.03, 0.03, 0.032}}, {"g", 0.5}},
                      {{"scattering", {0.03, 0.05, 0.05}}, {"absorption", {0.01, 0, 0}}, {"g", -0.6}},
                      {{"scattering", {0.5, 0.8, 2}}, {"absorption", {0.1, 0.4, 0}}, {"g", 0.2}}};

}  // namespace

TEST(SurfaceLamp, NetFluxIsThatOfTheParts)
{
    for (double g : {-0.99, -0.5, 0.0, 0.6, 0.95})
        for (double depth : {1e-6, 1e-3, 0.3, 2.0, 30.0})
            for (double albedo : {0.0, 0.3, 0.9, 1.0}) {
                const double s = albedo * depth, d = (1 - albedo) * depth, want = net_of_parts(s, d, g);
                // Deep and nearly isotropic F falls below what comes straight, by less than this of the light in clear air.
                const double bound = 1e-9 * want + (g < 0 ? 0 : 1e-12);
                const f64::LampMedium medium = f64::lamp_medium(s, d, g);
                EXPECT_NEAR(f64::net_flux(medium, g, medium.reduced), want, bound) << g << " " << depth << " " << albedo;
                // A medium by its coefficients, and the way.
                const f64::LampMedium of_coefficients = f64::lamp_medium(s / 7, d / 7, g);
                EXPECT_NEAR(f64::net_flux(of_coefficients, g, 7 * of_coefficients.reduced), want, bound);
                const f32::LampMedium narrow = f32::lamp_medium(float(s), float(d), float(g));
                EXPECT_NEAR(f32::net_flux(narrow, float(g), narrow.reduced), want, 2e-5 * want + 1e-12);
            }
}

// An environment that gives nothing has the CPU go pixel by pixel.
TEST(SurfaceLamp, PixelsSideBySideAreWhatEachIsAlone)
{
    const Mixed frame;
    for (const Json &medium : media)
        for (const char *density : {"constant", "layer and cloud"})
            for (int parts = 0; parts < 4; ++parts)
                for (size_t groups : {0, 3}) {
                    Json scene = lit_scene(medium, three_lamps());
                    if (*density == 'l')
                        scene["medium"]["density"] = Json::array(
                            {{{"type", "exponential"}, {"value", 0.7}, {"direction", {0.1, 1, 0}}, {"falloff", 0.2}},
                             gaussian({0, 0, -6}, 2, 0.8)});
                    scene["effects"] = {{"surface", Json::object()}};
                    const std::vector<Picture> given(frame.groups.begin(), frame.groups.begin() + long(groups));
                    const Picture together = relit(cpu(), scene, frame.color, frame.depth, frame.layers(parts), given);
                    scene["environment"]["sh"] = {{0, 0, 0}};
                    const Picture alone = relit(cpu(), scene, frame.color, frame.depth, frame.layers(parts), given);
                    const Worst worst = compare(together, alone, 0.05);
                    EXPECT_LT(worst.error, 2e-5) << medium << ", " << density << ", " << parts << ": " << worst.describe();
                    EXPECT_GT(compare(together, frame.color, 0.01).error, 0.01);
                }
}
