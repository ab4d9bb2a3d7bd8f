// What lamps give surfaces, as the CPU and shaders work it out, with what media settle taken out of it.
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

namespace {

class SurfaceLampOn : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, SurfaceLampOn, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

Json surfaces_in(const Json &medium, const Json &lights)
{
    Json scene = lit_scene(medium, lights);
    scene["effects"] = {{"surface", Json::object()}};
    return scene;
}

// As many as a pass takes at once, and more.
Json many_lamps()
{
    Json many = three_lamps();
    for (const Json &lamp : three_lamps()) {
        many.push_back(lamp);
        many.back()["position"][0] = double(lamp["position"][0]) - 1;
    }
    return many;
}

}  // namespace

// What each lamp's layer becomes is one thing, whether other layers come with it or not.
TEST_P(SurfaceLampOn, LayersOfManyLampsAreEachLampsOwn)
{
    const Mixed frame;
    const Json lights = many_lamps();
    Picture apart(Mixed::width, Mixed::height, 3, 0), all = apart;
    std::vector<Picture> groups;
    for (size_t l = 0; l < lights.size(); ++l) {
        Picture group = frame.groups[l % 3];
        for (float &v : group.data)
            v *= float(l + 1);
        const Json alone = surfaces_in(media[3], Json::array({lights[l]}));
        const Picture one = relit(cpu(), alone, group, frame.depth, frame.layers(3), {group});
        for (size_t i = 0; i < all.data.size(); ++i) {
            all.data[i] += group.data[i];
            apart.data[i] += one.data[i];
        }
        groups.push_back(std::move(group));
    }
    const Picture both = relit(context(), surfaces_in(media[3], lights), all, frame.depth, frame.layers(3), groups);
    const Worst worst = compare(both, apart, 0.05);
    EXPECT_LT(worst.error, 1e-3) << worst.describe();
}

// Programs are made for what the planned scene has.
TEST_P(SurfaceLampOn, ScenesThatPlansAreGivenLaterMayHaveMore)
{
    const Mixed frame;
    const Json lamp = Json::array({point_light({-1.5, 2, -6}, 40, 0.1)}), spot = Json::array({three_lamps()[2]}),
               sun = Json::array({{{"type", "directional"}, {"direction", {-0.2, -1, -0.1}}, {"intensity", 3}}});
    const Json grey{{"scattering", {0.05, 0.05, 0.051}}, {"absorption", {0.01, 0.01, 0.01}}, {"g", 0.6}},
        colours{{"scattering", {0.02, 0.07, 0.05}}, {"absorption", {0.01, 0.01, 0.01}}, {"g", -0.6}};
    Options options;
    options.inputs = frame.layers(3);
    options.inputs_of_lights["light_group"] = {frame.groups[0]};
    Options without_groups = options;
    without_groups.inputs_of_lights["light_group"].clear();
    const Plan plan(context(), surfaces_in(grey, lamp).dump(), Mixed::width, Mixed::height, options);
    for (const auto &[medium, lights] :
         {std::pair(grey, lamp), std::pair(grey, spot), std::pair(grey, sun), std::pair(colours, lamp)})
        for (const Options &brought : {options, without_groups}) {
            const std::string text = surfaces_in(medium, lights).dump();
            brume_scene scene = nullptr;
            Context::check(brume_scene_create_from_text(context(), text.data(), text.size(), "later.json", &scene),
                           context());
            Context::check(brume_plan_update(plan, scene, nullptr), context());
            brume_scene_destroy(scene);
            const Worst worst = compare(
                plan.execute(frame.color, frame.depth, brought).output,
                Plan(cpu(), text, Mixed::width, Mixed::height, options).execute(frame.color, frame.depth, brought).output,
                0.05);
            EXPECT_LT(worst.error, 1e-3) << medium << lights << ": " << worst.describe();
        }
}
