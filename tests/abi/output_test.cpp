// What comes out: alpha, components that are not finite, half limits, output layers.
#include <limits>

#include "client.h"

using namespace client;

namespace {

constexpr int width = 32, height = 16;

class Outputs : public EachBackend {
protected:
    Picture color{width, height}, depth{width, height, {.channels = 1}}, output{width, height};

    void SetUp() override
    {
        EachBackend::SetUp();
        paint(color);
        paint_depth(depth);
    }
};
INSTANTIATE_EACH_BACKEND(Outputs);

}  // namespace

TEST_P(Outputs, AlphaComesBackUnchanged)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(width, height));
    color.set(3, 3, 3, -2.5f);
    color.set(4, 3, 3, 1e9f);
    color.set_bits(5, 3, 3, 0x7fc12345);
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (x != 5 || y != 3) {
                ASSERT_EQ(output.bits(x, y, 3), color.bits(x, y, 3)) << x << ", " << y;
            }
    EXPECT_TRUE(std::isnan(output.get(5, 3, 3)));
}

TEST_P(Outputs, WhatIsNotFiniteStaysAndDoesNotSpread)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(width, height));
    Picture zeroed = color, expected(width, height);
    const float odd[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 9; ++i) {
        color.set(3 * i + 1, i + 2, i % 3, odd[i / 3]);
        zeroed.set(3 * i + 1, i + 2, i % 3, 0);
    }
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    ASSERT_EQ(execute(plan.get(), zeroed, depth, expected), BRUME_OK) << message(context.get());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c) {
                const float in = color.get(x, y, c), out = output.get(x, y, c);
                SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(c));
                if (std::isnan(in)) {
                    ASSERT_TRUE(std::isnan(out));
                } else if (std::isinf(in)) {
                    ASSERT_EQ(out, in);
                } else {
                    ASSERT_EQ(output.bits(x, y, c), expected.bits(x, y, c));
                }
            }
}

TEST_P(Outputs, HalvesAreClamped)
{
    Scene scene = make_scene(context, R"({"brume": 1, "medium": {"absorption": 1e-9}})");
    Plan plan = make_plan(context, scene, ray_format(width, height));
    color.set(2, 2, 0, 1e8f);
    color.set(3, 2, 1, -1e8f);
    color.set(4, 2, 2, 65519.0f);
    color.set(5, 2, 0, INFINITY);
    Picture half(width, height, {.pixel = BRUME_PIXEL_F16});
    ASSERT_EQ(execute(plan.get(), color, depth, half), BRUME_OK) << message(context.get());
    EXPECT_EQ(half.get(2, 2, 0), 65504.0f);
    EXPECT_EQ(half.get(3, 2, 1), -65504.0f);
    EXPECT_EQ(half.get(4, 2, 2), 65504.0f);
    EXPECT_EQ(half.get(5, 2, 0), INFINITY);
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
    EXPECT_NEAR(output.get(2, 2, 0), 1e8f, 100.0f);
}

TEST_P(Outputs, ClampedValuesAreCountedAndWarnedOfOnce)
{
    std::vector<std::string> warnings;
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = GetParam();
    desc.log_user = &warnings;
    desc.log = [](void *user, uint32_t level, const char *text) {
        if (level == BRUME_LOG_WARNING && std::strstr(text, "65504"))
            static_cast<std::vector<std::string> *>(user)->push_back(text);
    };
    Context counting = make_context(desc);
    Scene scene = make_scene(counting, R"({"brume": 1, "medium": {"absorption": 1e-9}})");
    Plan plan = make_plan(counting, scene, ray_format(width, height, {layer("optical_depth")}));
    Picture half(width, height, {.pixel = BRUME_PIXEL_F16}), tau(width, height, {.channels = 3, .pixel = BRUME_PIXEL_F16});
    const auto clamped = [&] {
        brume_plan_info info = BRUME_PLAN_INFO_INIT;
        EXPECT_EQ(brume_plan_get_info(plan.get(), &info), BRUME_OK) << message(counting.get());
        return info.clamped_values;
    };
    const bool counts = GetParam() == BRUME_BACKEND_CPU;
    EXPECT_EQ(clamped(), -1);
    ASSERT_EQ(execute(plan.get(), color, depth, half), BRUME_OK) << message(counting.get());
    EXPECT_EQ(clamped(), counts ? 0 : -1);
    color.set(2, 2, 0, 1e8f);
    color.set(3, 2, 1, -1e8f);
    color.set(4, 2, 2, 65504.0f);
    color.set(5, 2, 0, INFINITY);
    color.set(6, 2, 3, 65505.0f);
    for (int frame = 0; frame < 2; ++frame) {
        ASSERT_EQ(execute(plan.get(), color, depth, half), BRUME_OK) << message(counting.get());
        EXPECT_EQ(clamped(), counts ? 3 : -1);
    }
    ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(counting.get());
    EXPECT_EQ(clamped(), 0);
    EXPECT_EQ(warnings.size(), counts ? 1u : 0u);
    if (counts) {
        EXPECT_NE(warnings[0].find("3 values beyond 65504"), std::string::npos) << warnings[0];
    }

    // Those of output layers are counted with them: 1e-9 / m over 1e15 m are more than halves hold.
    const std::vector<brume_layer> tau_layer{layer("optical_depth")};
    brume_format format = ray_format(width, height, tau_layer);
    format.sky = BRUME_SKY_CLAMP;
    format.sky_distance = 1e15;
    plan = make_plan(counting, scene, format);
    depth.set(0, 0, 0, INFINITY);
    uint64_t sky = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sky += std::isinf(depth.get(x, y, 0));
    const brume_image tau_image = tau.image();
    ASSERT_EQ(execute(plan.get(), color, depth, output, {layer("optical_depth", &tau_image)}), BRUME_OK)
        << message(counting.get());
    EXPECT_EQ(clamped(), counts ? int64_t(3 * sky) : -1);
    EXPECT_EQ(tau.get(0, 0, 0), 65504.0f);
    EXPECT_EQ(warnings.size(), counts ? 1u : 0u) << "a further plan of the context warns again";
}

TEST_P(Outputs, HugeRadianceStaysFinite)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(width, height));
    for (float value : {1e10f, 3e38f, -3e38f, std::numeric_limits<float>::denorm_min()}) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c)
                    color.set(x, y, c, value);
        ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_TRUE(std::isfinite(output.get(x, y, c))) << value << " at " << x << ", " << y;
    }
}

TEST_P(Outputs, LayersAreWhatTheySay)
{
    Scene scene = make_scene(context, R"({"brume": 1, "camera": {"vertical_fov": 50},
        "medium": {"scattering": [0.01, 0.02, 0.03], "absorption": [0.002, 0.001, 0], "emission": 0.01, "g": 0.5}})");
    const char *const names[] = {"transmittance", "optical_depth", "scattered", "blur_radius"};
    Plan plan = make_plan(context, scene,
                          ray_format(width, height, {layer(names[0]), layer(names[1]), layer(names[2]), layer(names[3])}));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (std::isinf(depth.get(x, y, 0)))
                depth.set(x, y, 0, 5.0f);
    Picture transmittance(width, height), tau(width, height, {.channels = 3}), scattered(width, height),
        radius(width, height, {.channels = 1}), plain(width, height);
    const brume_image images[] = {transmittance.image(), tau.image(), scattered.image(), radius.image()};
    std::vector<brume_layer> layers;
    for (uint32_t i = 0; i < 4; ++i)
        layers.push_back(layer(names[i], &images[i]));
    ASSERT_EQ(execute(plan.get(), color, depth, output, layers), BRUME_OK) << message(context.get());
    const double sigma_t[] = {0.012, 0.021, 0.03};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double d = depth.get(x, y, 0);
            EXPECT_EQ(transmittance.get(x, y, 3), 1.0f);
            EXPECT_EQ(scattered.get(x, y, 3), 1.0f);
            EXPECT_GT(radius.get(x, y, 0), 0.0f);
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(tau.get(x, y, c), sigma_t[c] * d, 2e-6 * (1 + sigma_t[c] * d));
                ASSERT_NEAR(transmittance.get(x, y, c), std::exp(-sigma_t[c] * d), 2e-6);
                ASSERT_NEAR(output.get(x, y, c), color.get(x, y, c) * transmittance.get(x, y, c) + scattered.get(x, y, c),
                            2e-6 * (1 + output.get(x, y, c)));
            }
        }
    // A frame may take none or some of the outputs; the picture is the same.
    ASSERT_EQ(execute(plan.get(), color, depth, plain), BRUME_OK) << message(context.get());
    expect_same_bits(output, plain);
    ASSERT_EQ(execute(plan.get(), color, depth, plain, {layers[2]}), BRUME_OK) << message(context.get());
    expect_same_bits(output, plain);
}

TEST_P(Outputs, LayersInAnyLayout)
{
    Scene scene = make_scene(context, foggy);
    Plan plan = make_plan(context, scene, ray_format(width, height, {layer("transmittance"), layer("blur_radius")}));
    const auto outputs_in = [&](Layout layout) {
        Layout scalar = layout;
        scalar.channels = 1;
        std::pair<Picture, Picture> pictures{Picture(width, height, layout), Picture(width, height, scalar)};
        const brume_image transmittance = pictures.first.image(), radius = pictures.second.image();
        EXPECT_EQ(execute(plan.get(), color, depth, output,
                          {layer("transmittance", &transmittance), layer("blur_radius", &radius)}),
                  BRUME_OK)
            << message(context.get());
        EXPECT_TRUE(pictures.first.guards_untouched() && pictures.second.guards_untouched());
        return pictures;
    };
    for (uint32_t pixel : {BRUME_PIXEL_F32, BRUME_PIXEL_F16}) {
        const auto expected = outputs_in({.pixel = pixel});
        for (Layout layout :
             {Layout{.row_padding = 12}, {.pixel_padding = 4}, {.negative_rows = true}, {.pixel_padding = 2, .offset = 1}}) {
            layout.pixel = pixel;
            const auto got = outputs_in(layout);
            expect_same_bits(expected.first, got.first);
            expect_same_bits(expected.second, got.second);
        }
    }
}

TEST_P(Outputs, SkyKinds)
{
    Scene scene = make_scene(context, absorbing);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                color.set(x, y, c, 1);
    for (float far : {float(INFINITY), float(NAN), 1e10f, 0.0f, -3.0f}) {
        depth.set(9, 9, 0, far);
        const double expected[] = {0.0, 1.0, std::exp(-0.01 * 50)};
        for (uint32_t sky : {BRUME_SKY_FOG, BRUME_SKY_KEEP, BRUME_SKY_CLAMP}) {
            brume_format format = ray_format(width, height);
            format.sky = sky;
            format.sky_distance = 50;
            Plan plan = make_plan(context, scene, format);
            ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
            EXPECT_NEAR(output.get(9, 9, 0), expected[sky], 1e-6) << "far " << far << " sky " << sky;
        }
    }
}

// planar, inverse, normalized and device depths of the same scene agree with ray distances.
TEST_P(Outputs, DepthKindsAgree)
{
    Scene scene = make_scene(context, absorbing);
    const double near = 0.5, far = 200;
    struct Kind {
        uint32_t kind;
        double range[2];
        std::function<double(double)> of_planar;
    };
    const Kind kinds[] = {
        {BRUME_DEPTH_PLANAR, {0, 1}, [](double z) { return z; }},
        {BRUME_DEPTH_INVERSE, {0, 1}, [](double z) { return 1 / z; }},
        {BRUME_DEPTH_NORMALIZED, {near, far}, [&](double z) { return (z - near) / (far - near); }},
        {BRUME_DEPTH_DEVICE, {near, far}, [&](double z) { return (1 / z - 1 / near) / (1 / far - 1 / near); }},
        {BRUME_DEPTH_DEVICE, {far, near}, [&](double z) { return (1 / z - 1 / far) / (1 / near - 1 / far); }},
        {BRUME_DEPTH_DEVICE, {INFINITY, near}, [&](double z) { return near / z; }},
    };
    Plan by_ray = make_plan(context, scene, ray_format(width, height));
    Picture planar(width, height, {.channels = 1}), ray(width, height, {.channels = 1}), expected(width, height);
    const double focal = 0.5 * height / std::tan(25 * M_PI / 180);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double z = 2 + (x * 7 + y * 3) % 90;
            planar.set(x, y, 0, float(z));
            ray.set(x, y, 0, float(z * std::hypot(1.0, (x + 0.5 - width / 2.0) / focal, (y + 0.5 - height / 2.0) / focal)));
        }
    ASSERT_EQ(execute(by_ray.get(), color, ray, expected), BRUME_OK) << message(context.get());
    for (const Kind &kind : kinds) {
        brume_format format = ray_format(width, height);
        format.depth_kind = kind.kind;
        format.depth_range[0] = kind.range[0];
        format.depth_range[1] = kind.range[1];
        Plan plan = make_plan(context, scene, format);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                depth.set(x, y, 0, float(kind.of_planar(planar.get(x, y, 0))));
        ASSERT_EQ(execute(plan.get(), color, depth, output), BRUME_OK) << message(context.get());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                ASSERT_NEAR(output.get(x, y, 0), expected.get(x, y, 0), 2e-4 * (1e-3 + expected.get(x, y, 0)))
                    << "kind " << kind.kind << " range " << kind.range[0] << " at " << x << ", " << y;
    }
}

TEST_P(Outputs, OfLightsOnePicturePerLight)
{
    Scene scene = make_scene(context, R"({"brume": 1, "medium": {"scattering": 0.05}, "camera": {"vertical_fov": 50,
        "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}, "effects": {"airlight": {}}, "lights": [
        {"type": "point", "position": [1,0,-9], "intensity": [30,0,0]},
        {"type": "point", "position": [-1,0,-9], "intensity": [0,30,0]}]})");
    Plan plan = make_plan(context, scene, ray_format(width, height, {layer("transmittance"), layer("light_airlight")}));
    Picture first(width, height, {.channels = 3}), second(width, height, {.channels = 3});
    const brume_image first_image = first.image(), second_image = second.image();
    const auto of_light = [](uint32_t light, const brume_image *image) {
        brume_layer of = layer("light_airlight", image);
        of.light = light;
        return of;
    };
    ASSERT_EQ(execute(plan.get(), color, depth, output, {of_light(1, &second_image), of_light(0, &first_image)}), BRUME_OK)
        << message(context.get());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            ASSERT_GT(first.get(x, y, 0), 0.0f);
            ASSERT_EQ(first.get(x, y, 1), 0.0f);
            ASSERT_EQ(second.get(x, y, 0), 0.0f);
            ASSERT_GT(second.get(x, y, 1), 0.0f);
        }
    }

    const auto refused = [&](const std::vector<brume_layer> &layers, const char *named) {
        expect_status(context.get(), execute(plan.get(), color, depth, output, layers), BRUME_ERROR_ARGUMENT, named);
    };
    refused({of_light(2, &first_image)}, "outputs[0] (light_airlight): light 2; expected an index below 2");
    refused({of_light(0, &first_image), of_light(0, &second_image)}, "outputs[1] (light_airlight): given twice");
    brume_layer misplaced = layer("transmittance", &first_image);
    misplaced.light = 1;
    refused({misplaced}, "outputs[0] (transmittance): light 1; expected 0");
    refused(std::vector<brume_layer>(BRUME_MAX_LAYERS + 1, of_light(0, &first_image)), "outputs: 8193 layers");
}
