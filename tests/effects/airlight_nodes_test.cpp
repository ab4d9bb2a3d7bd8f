// Nodes of a panel side by side (nodes.cpp of the effect): the integrals of airlight_parts.glsl but for the rounding.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "passes.h"

namespace {

using namespace brume::maths_float;

constexpr int width = 23, height = 9;

struct Case {
    float g;
    int terms;
    float light[16];  // four texels (light.glsl)
};

class LanesAirlight : public testing::TestWithParam<Case> {};

TEST_P(LanesAirlight, AsNodeByNode)
{
    const Case &of = GetParam();
    brume_plugin_medium m{};
    for (int i = 0; i < 3; ++i) {
        m.scattering[i] = 0.02f + 0.01f * float(i);
        m.absorption[i] = 0.003f;
    }
    m.phase[0] = m.asymmetry = of.g;
    m.constant = 0.5f;
    m.term_count = of.terms;
    m.terms[0][1] = 0.2f;
    brume_plugin_camera c{};
    c.focal[0] = c.focal[1] = 20;
    c.tangent_scale[0] = 1 / 20.0f;
    c.tangent_scale[1] = -1 / 20.0f;
    c.center[0] = width / 2.0f;
    c.center[1] = height / 2.0f;
    c.far_distance = 1e6f;
    c.metres_per_unit = 1;
    brume_plugin_scene scene{};
    scene.medium = &m;
    scene.camera = &c;
    std::vector<float> depth(width * height), light(of.light, of.light + 16), radiance(width * height * 4),
        error(width * height * 4);
    for (size_t i = 0; i < depth.size(); ++i)
        depth[i] = i % 7 == 0 ? 1e30f : 0.5f * float(i);
    brume_plugin_pixels slots[airlight::gather::slot_count]{};
    slots[airlight::gather::depth] = {depth.data(), width, width, height, 1, 0};
    slots[airlight::gather::lights] = {light.data(), 4096, 1024, 1, 4, 0};
    slots[airlight::gather::radiance] = {radiance.data(), width * 4, width, height, 4, 0};
    slots[airlight::gather::error] = {error.data(), width * 4, width, height, 4, 0};
    airlight::Constants constants{};
    constants.airlight.light_count = 1;
    constants.airlight.panels = 8;
    constants.airlight.tolerance = 1e-3f;
    constants.airlight.near_radii = 3;
    constants.size = ivec2(width, height);
    constants.light_range = ivec2(0, 1);
    constants.reduction = 1;
    constants.tier = airlight_nodes;
    brume_plugin_rows call{};
    call.width = width;
    call.height = height;
    call.slot_count = airlight::gather::slot_count;
    call.slots = slots;
    call.constants = &constants;
    call.scene = &scene;
    ASSERT_EQ(airlight::gather_nodes_rows(&call, 0, height), BRUME_OK);

    const Medium medium = medium_of(scene);
    const Camera camera = camera_of(scene);
    const Texture none, lights = texture_of(slots[airlight::gather::lights]);
    float brightest = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Ray ray = pixel_ray(camera, vec2(float(x) + 0.5f, float(y) + 0.5f), depth[size_t(y * width + x)]);
            const Sight sight{ray.direction, ray.distance, 0, 0};
            // Without lists of Gaussians a node's shadow is none.
            Airlight expected{vec3(0), vec3(0)};
            const Light one = light_at(lights, 0);
            const Aspect aspect = aspect_of(one, sight.direction);
            const vec3 terms = terms_range(medium, sight);
            const float of_two_origins[28] = {0, 0, 0, 0, 0, 0, 0, 0, 6, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 6, 1};
            const Texture lists{of_two_origins, 28, 7, 1, 4};
            expected = light_by_parts(medium, camera, constants.airlight, none, lists, none, sight, 0, one, aspect, true,
                                      terms, vec2(0, std::min(sight.distance, quadrature_limit)), expected);
            for (int i = 0; i < 3; ++i) {
                const float found = radiance[size_t((y * width + x) * 4 + i)];
                ASSERT_NEAR(found, expected.radiance[i], 2e-5f * expected.radiance[i] + 1e-30f) << x << ", " << y;
                ASSERT_LE(error[size_t((y * width + x) * 4 + i)], expected.error[i] * 1.5f + 1e-5f * expected.radiance[i]);
                brightest = std::max(brightest, found);
            }
        }
    EXPECT_GT(brightest, 0);

    // Rows one by one: the same bits.
    const std::vector<float> whole = radiance;
    for (int y = height - 1; y >= 0; --y)
        ASSERT_EQ(airlight::gather_nodes_rows(&call, y, y + 1), BRUME_OK);
    EXPECT_EQ(radiance, whole);
}

constexpr float point = light_point, spot = light_spot, sun = light_directional;
INSTANTIATE_TEST_SUITE_P(All, LanesAirlight,
                         testing::Values(Case{0.2f, 0, {1, 2, -10, 0.1f, 0, -1, 0, 0, 30, 20, 10, 0, point, 0}},
                                         Case{0.9f, 1, {0, 1, 6, 0.1f, 0, -1, 0, 0, 30, 20, 10, 0, point, 0}},
                                         Case{0.9f, 0, {0.5f, 0.3f, -40, 0, 0, -1, 0, 0, 30, 20, 10, 0, point, 0}},
                                         Case{0.5f, 1, {0, 3, -9, 0.05f, 0, -1, 0, 0.7f, 30, 20, 10, 0.8f, spot, 0}},
                                         Case{0.7f, 1, {0, 0, 0, 0, 0, -1, 0, 0, 3, 2, 1, 0, sun, 4}}));

}  // namespace
