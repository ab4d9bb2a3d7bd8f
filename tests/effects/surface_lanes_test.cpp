// Lamps, suns and skies on surfaces, pixels side by side: what each pixel is alone, and the same bits with every set of
// instructions.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "gaussians/light_gaussians.h"
#include "lanes.hpp"
#include "scene_maths.hpp"

namespace {

namespace f32 = brume::maths_float;

struct Map {
    int width = 1, height = 1;
    std::vector<float> depths{1e30f};
};

// Pixels of a row, all that may differ from one to the next, and the scene. Data images are texels of four, one after
// another.
struct Relit {
    brume_plugin_scene scene{};
    f32::SurfaceSettings settings{};
    std::vector<float> lights, ungrouped, gaussians, light_gaussians, environment, light_shadows;
    Map shadow_map;
    float row = 300.5f;
    std::vector<float> column, depth, roughness;
    std::array<std::vector<float>, 3> normal, albedo, specular, source;
    std::array<std::array<std::vector<float>, 3>, 6> transfer;
};

namespace one_by_one {

using namespace brume::maths_float;
constexpr size_t at_once = 1;

struct Data {
    Texture texture;
    explicit Data(const std::vector<float> &texels) : texture{texels.data(), 4096, 1024, 1, 4} {}
};

Texture texture_of(const Map &map)
{
    return {map.depths.data(), map.width, map.width, map.height, 1};
}

SurfaceSettings settings_of(const SurfaceSettings &s)
{
    return s;
}

float load(const std::vector<float> &from, size_t i)
{
    return from[i];
}

void store(float value, std::vector<float> &to, size_t i, size_t v)
{
    to[i * 6 + v] = value;
}

#include "surface_lanes_probe.inc"

}  // namespace one_by_one

#define BRUME_LANES_BODY "surface_lanes.inc"
#include "lanes_bodies.inc"

void push(std::vector<float> &to, std::initializer_list<float> values)
{
    to.insert(to.end(), values);
}

class Frames {
public:
    Frames()
    {
        medium_.luminance[0] = medium_.luminance[1] = medium_.luminance[2] = 1 / 3.0f;
        camera_.tangent_scale[0] = 1 / 900.0f;
        camera_.tangent_scale[1] = -1 / 900.0f;
        camera_.center[0] = 480;
        camera_.center[1] = 270;
        camera_.far_distance = 1e6f;
        camera_.sky_distance = 300;
        camera_.metres_per_unit = 1;
        // Turned by .3 about +y.
        const float c = std::cos(0.3f), s = std::sin(0.3f);
        camera_.right[0] = c;
        camera_.right[2] = -s;
        camera_.up[1] = 1;
        camera_.back[0] = s;
        camera_.back[2] = c;
    }

    // media: 0 grey, 1 of two colours, 2 of three that absorb; densities: 0 constant, 1 falls off, and clouds, 2 next to
    // nothing.
    Relit frame(int medium, int density, int material, int transfer, bool sky, bool shadows)
    {
        const float scattering[][3] = {{0.05f, 0.05f, 0.05f}, {0.03f, 0.03f, 0.032f}, {0.5f, 0.8f, 2}},
                    absorption[][3] = {{0, 0, 0}, {0, 0, 0}, {0.1f, 0.4f, 0}}, asymmetry[] = {0.8f, 0.5f, -0.6f};
        std::copy_n(scattering[medium], 3, medium_.scattering);
        std::copy_n(absorption[medium], 3, medium_.absorption);
        medium_.asymmetry = asymmetry[medium];
        medium_.phase[0] = asymmetry[medium];
        medium_.constant = density == 0 ? 1.0f : 0.0f;
        medium_.term_count = density == 0 ? 0 : 2;
        const float terms[][4] = {{0.02f, 0.2f, 0, -0.4f}, {0, 0.05f, 0.01f, -2}};
        for (int t = 0; t < 2; ++t)
            std::copy_n(terms[t], 4, medium_.terms[t]);
        if (density == 2) {
            medium_.term_count = 1;
            medium_.terms[0][3] = -14;
        }
        camera_.sky = density == 0 ? f32::sky_clamp : f32::sky_fog;
        Relit r;
        r.scene.medium = &medium_;
        r.scene.camera = &camera_;
        r.settings.method = f32::method_calibrated;
        r.settings.material = material;
        r.settings.transfer = transfer;
        r.settings.ground = 0.3f;
        r.settings.environment_order = sky ? 3 : 0;
        r.settings.shadowed = shadows;
        r.settings.light_count = 4;
        // A lamp, a high sun, a spot, a sun behind falling density's horizon.
        push(r.lights, {-1.5f, 2, -6, 0.1f, 0, -1, 0, 0, 40, 40, 30, 0, float(f32::light_point), 0, 0, 0});
        push(r.lights, {0, 0, 0, 0, -0.2673f, -0.8018f, -0.5345f, 0, 3, 3, 2, 0, float(f32::light_directional), 20, 0, 0});
        push(r.lights,
             {2, 3, -8, 0.2f, -0.195f, -0.976f, -0.0976f, 0.64f, 100, 90, 80, 0.8f, float(f32::light_spot), 0, 0, 0});
        push(r.lights, {0, 0, 0, 0, 0.6f, 0.05f, -0.7984f, 0, 1, 1, 2, 0, float(f32::light_directional), 5, 0, 0});
        for (int l = 0; l < 4; ++l)
            push(r.ungrouped, {float(f32::part_ungrouped), 0, 0, 0});
        if (density == 1) {
            push(r.gaussians, {0, 0, -6, 0.5f, 0.8f, 1, 1, 1});
            push(r.gaussians, {3, 1, -20, 0.1f, 0.2f, 1, 1, 1});
            for (int i = 0; i < 40; ++i)
                push(r.gaussians, {float(i % 7) - 3, float(i % 5) - 2, -5 - float(i), 1, 0.1f, 1, 1, 1});
        }
        list(r);
        for (int i = 0; i < 9; ++i)
            push(r.environment,
                 {i == 0 ? 1.2f : 0.1f * float(i % 4), i == 0 ? 1.0f : -0.05f * float(i), i == 0 ? 0.9f : 0.2f, 0});
        // An orthographic map of the high sun, of 16 x 16 texels of a metre; no other light has one.
        for (int l = 0; l < 4; ++l)
            push(r.light_shadows, {1, 0, 0, 0, 0, 0, -1, -8, 0, 1, 0, -30, l == 1 ? 2.0f : 0.0f, 8, 0, 0, 0, 0, 16, 16});
        r.shadow_map = {16, 16, std::vector<float>(256)};
        std::mt19937 random(5);
        std::uniform_real_distribution<float> u(0, 1);
        for (float &d : r.shadow_map.depths)
            d = u(random) < 0.5f ? 1e30f : 28 + 4 * u(random);
        fill(r, random);
        return r;
    }

private:
    static void list(Relit &r)
    {
        static_assert(sizeof(brume_plugin_gaussian) == 8 * sizeof(float));
        std::vector<brume_plugin_gaussian> gaussians(r.gaussians.size() / 8);
        std::vector<brume_plugin_light> lights(r.lights.size() / 16);
        for (size_t i = 0; i < gaussians.size(); ++i)
            std::memcpy(&gaussians[i], &r.gaussians[8 * i], 8 * sizeof(float));
        for (size_t l = 0; l < lights.size(); ++l) {
            std::memcpy(lights[l].position, &r.lights[16 * l], 16 * sizeof(float));
        }
        brume_plugin_scene scene = r.scene;
        scene.gaussians = gaussians.data();
        scene.gaussian_count = uint32_t(gaussians.size());
        scene.gaussian_size = sizeof gaussians[0];
        scene.lights = lights.data();
        scene.light_count = uint32_t(lights.size());
        scene.light_size = sizeof lights[0];
        r.settings.gaussian_count = int(gaussians.size());
        brume::LightGaussians lists;
        lists.refresh(scene, true, false);
        r.light_gaussians = lists.texels;
    }
    static void fill(Relit &r, std::mt19937 &random)
    {
        constexpr size_t pixels = 96;
        std::uniform_real_distribution<float> u(0, 1);
        for (size_t i = 0; i < pixels; ++i) {
            r.column.push_back(480 + 8 * float(i) - 380);
            r.depth.push_back(u(random) < 0.15f ? std::numeric_limits<float>::infinity() : std::exp(4 * u(random)));
            r.roughness.push_back(u(random));
            const bool known = u(random) < 0.85f;
            for (size_t c = 0; c < 3; ++c) {
                r.normal[c].push_back(known ? 2 * u(random) - 1 : 0);
                r.albedo[c].push_back(u(random));
                r.specular[c].push_back(u(random));
                r.source[c].push_back(u(random));
                for (size_t l = 0; l < 6; ++l)
                    r.transfer[l][c].push_back(l == 0 && c == 0 ? 0.25f * u(random) : 0.3f * u(random) - 0.15f);
            }
        }
        r.roughness[5] = std::numeric_limits<float>::quiet_NaN();
        r.albedo[1][6] = std::numeric_limits<float>::infinity();
        r.source[2][7] = std::numeric_limits<float>::quiet_NaN();
    }

    brume_plugin_medium medium_{};
    brume_plugin_camera camera_{};
};

}  // namespace

TEST(LanesOfSurfaces, AreWhatEachPixelIsAlone)
{
    Frames frames;
    for (int medium = 0; medium < 3; ++medium)
        for (int density = 0; density < 3; ++density)
            for (int material = 0; material < 3; ++material)
                for (int transfer : {0, 4})
                    for (const bool sky : {false, true})
                        for (const bool shadows : {false, true}) {
                            if (transfer > 0 && material == 0)
                                continue;
                            const Relit frame = frames.frame(medium, density, material, transfer, sky, shadows);
                            const std::vector<float> alone = one_by_one::relit_pixels(frame),
                                                     together = generic::relit_pixels(frame);
#ifdef BRUME_AVX2
                            if (brume::runs_avx2()) {
                                const std::vector<float> wide = avx2::relit_pixels(frame);
                                EXPECT_EQ(std::memcmp(wide.data(), together.data(), wide.size() * sizeof(float)), 0);
                            }
#endif
                            size_t changed = 0;
                            for (size_t i = 0; i < alone.size(); ++i) {
                                if (std::isnan(alone[i])) {
                                    EXPECT_TRUE(std::isnan(together[i]));
                                    continue;
                                }
                                ASSERT_NEAR(together[i], alone[i], 2e-5 * (0.05 + std::abs(alone[i])))
                                    << "pixel " << i / 6 << ", value " << i % 6 << " of medium " << medium << ", density "
                                    << density << ", material " << material << ", transfer " << transfer << ", sky " << sky
                                    << ", shadows " << shadows;
                                changed += i % 6 < 3 && std::abs(alone[i] - frame.source[i % 6][i / 6]) > 0.01f;
                            }
                            if (density < 2) {
                                EXPECT_GT(changed, 50u);
                            }
                        }
}
