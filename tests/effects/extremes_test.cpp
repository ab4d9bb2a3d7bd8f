// Every extreme of the list, on both backends: finite where the input is, within range, and the classes agree.
#include <random>

#include <gtest/gtest.h>

#include "fog.h"

using namespace fog;

namespace {

struct Case {
    std::string name;
    std::string medium;
    float depth;
    float radiance;
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    const float depths[] = {0, 1e-45f, 1e-6f, 1, 1e30f, INFINITY, NAN, -3};
    const double taus[] = {0, 1e-12, 1e-4, 1, 50, 1e4};
    for (float d : depths)
        for (double tau : taus) {
            char medium[200];
            snprintf(medium, sizeof medium, "\"scattering\":[%.9g,0,%.9g],\"absorption\":[0,%.9g,0],\"g\":0.8", tau, tau,
                     tau);
            all.push_back({"depth " + std::to_string(d) + " sigma " + std::to_string(tau), medium, d, 2});
        }
    for (double g : {-1.0, -0.999, 0.0, 0.999, 1.0}) {
        char medium[100];
        snprintf(medium, sizeof medium, "\"scattering\":0.05,\"g\":%.9g", g);
        all.push_back({"g " + std::to_string(g), medium, 20, 2});
    }
    for (float l : {0.0f, 65504.0f, 1e10f, 3e38f, NAN, INFINITY, -INFINITY, -5.0f})
        all.push_back({"radiance " + std::to_string(l), "\"scattering\":0.05,\"absorption\":0.01,\"g\":0.5", 20, l});
    for (const char *direction : {"[0,1,0]", "[0,-1,0]", "[1e-9,1,0]", "[0,0,1]", "[0,0,-1]"})
        for (const char *falloff : {"0", "1e-12", "0.3", "1000"})
            for (const char *origin : {"[0,0,0]", "[0,1000000,0]", "[0,-1000000,0]"})
                all.push_back(
                    {std::string("falloff ") + falloff + " along " + direction + " from " + origin,
                     std::string("\"scattering\":0.1,\"density\":[{\"type\":\"exponential\",\"value\":1,\"falloff\":") +
                         falloff + ",\"direction\":" + direction + ",\"origin\":" + origin + "}]",
                     INFINITY, 1});
    return all;
}

}  // namespace

class Extremes : public testing::TestWithParam<const char *> {
protected:
    brume_context context()
    {
        if (std::string(GetParam()) == "cpu")
            return cpu();
        if (!gl())
            throw std::runtime_error("no GL backend");
        return *gl();
    }
};

INSTANTIATE_TEST_SUITE_P(All, Extremes, testing::Values("cpu", "gl"), [](auto &info) { return std::string(info.param); });

TEST_P(Extremes, MediaDepthsAndRadiances)
{
    for (const Case &c : cases()) {
        // The extreme in the left half beside an ordinary right half.
        Picture color(10, 6, 4, 1), depth(10, 6, 1, 25);
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 5; ++x) {
                depth.at(x, y)[0] = c.depth;
                for (int k = 0; k < 3; ++k)
                    color.at(x, y)[k] = c.radiance;
            }
        Options all{{},
                    BRUME_OUTPUT_TRANSMITTANCE | BRUME_OUTPUT_OPTICAL_DEPTH | BRUME_OUTPUT_SCATTERED |
                        BRUME_OUTPUT_BLUR_RADIUS,
                    0};
        for (const char *parameters : {"", "\"separation\":true,\"kernel_size\":\"6x6\",\"fetch\":\"cubic_bicubic\""}) {
            auto r = run(context(), scene(c.medium, parameters), color, depth, all);
            for (int y = 0; y < 6; ++y)
                for (int x = 0; x < 10; ++x)
                    for (int k = 0; k < 3; ++k) {
                        float in = color.at(x, y)[k], out = r.output.at(x, y)[k];
                        if (!std::isfinite(in)) {
                            ASSERT_TRUE(std::isnan(in) ? std::isnan(out) : in == out)
                                << c.name << ": not returned unchanged";
                            continue;
                        }
                        ASSERT_TRUE(std::isfinite(out)) << c.name << " at " << x << "," << y << ": " << out;
                        float bound = std::max(std::isfinite(c.radiance) ? std::abs(c.radiance) : 1.0f, 1.0f);
                        // A pixel may keep all of its own light and take as much again from others.
                        ASSERT_LE(std::abs(out), bound * 2.0001f) << c.name << ": more light than there is";
                        float t = r.transmittance.at(x, y)[k];
                        ASSERT_TRUE(t >= 0 && t <= 1) << c.name << ": transmittance " << t;
                        ASSERT_TRUE(std::isfinite(r.optical_depth.at(x, y)[k]) && r.optical_depth.at(x, y)[k] >= 0)
                            << c.name;
                        ASSERT_TRUE(std::isfinite(r.blur_radius.at(x, y)[0]) && r.blur_radius.at(x, y)[0] >= 0) << c.name;
                        ASSERT_TRUE(std::isfinite(r.scattered.at(x, y)[k])) << c.name;
                    }
        }
    }
}

TEST_P(Extremes, CamerasFarFromTheOrigin)
{
    // The same relative scene near the origin and 1e6 m away.
    auto text = [](double shift) {
        char buffer[500];
        snprintf(
            buffer, sizeof buffer,
            "{\"brume\":1,\"camera\":{\"vertical_fov\":50,\"camera_to_world\":[[1,0,0,%.17g],[0,1,0,%.17g],[0,0,1,%.17g],[0,"
            "0,0,1]]},"
            "\"medium\":{\"scattering\":0.05,\"density\":[{\"type\":\"exponential\",\"falloff\":0.2,\"direction\":[0,1,0],"
            "\"origin\":[%.17g,%.17g,%.17g]}]}}",
            shift, shift + 2, -shift, shift, shift, -shift);
        return std::string(buffer);
    };
    Picture color(20, 20, 4, 1), depth(20, 20, 1, 30);
    auto near_one = run(context(), text(0), color, depth), far_one = run(context(), text(1e6), color, depth);
    Worst worst = compare(far_one.output, near_one.output, 1e-2);
    EXPECT_LT(worst.error, 1e-6) << worst.describe();
}

TEST_P(Extremes, Sizes)
{
    for (auto [w, h] : {std::pair(1, 1), {1, 4096}, {3, 5}, {4096, 1}, {16384, 2}, {2, 1}, {1, 2}}) {
        Picture color(w, h, 4, 0.5f), depth(w, h, 1, 30);
        color.at(w / 2, h / 2)[1] = 500;
        auto r = run(context(), scene("\"scattering\":0.03,\"g\":0.7"), color, depth);
        for (float v : r.output.data)
            ASSERT_TRUE(std::isfinite(v) && v >= 0) << w << "x" << h;
    }
}

TEST_P(Extremes, OneBadPixelStaysAlone)
{
    Picture color(64, 64, 4, 1), depth(64, 64, 1, 30);
    auto clean_color = color;
    clean_color.at(30, 31)[0] = 0;
    clean_color.at(31, 31)[1] = 0;
    color.at(30, 31)[0] = NAN;
    color.at(31, 31)[1] = INFINITY;
    auto r = run(context(), scene("\"scattering\":0.03,\"g\":0.7"), color, depth),
         clean = run(context(), scene("\"scattering\":0.03,\"g\":0.7"), clean_color, depth);
    EXPECT_TRUE(std::isnan(r.output.at(30, 31)[0]));
    EXPECT_EQ(r.output.at(31, 31)[1], INFINITY);
    r.output.at(30, 31)[0] = clean.output.at(30, 31)[0];
    r.output.at(31, 31)[1] = clean.output.at(31, 31)[1];
    EXPECT_EQ(r.output.data, clean.output.data);
}

TEST_P(Extremes, OneLitPixelAmongZeros)
{
    for (float l : {1e-30f, 1.0f, 65504.0f, 1e10f}) {
        Picture color(65, 65, 4, 0), depth(65, 65, 1, 30);
        color.at(32, 32)[2] = l;
        auto r = run(context(), scene("\"scattering\":0.03,\"g\":0.9", "\"masking\":false"), color, depth);
        double total = 0;
        for (int y = 0; y < 65; ++y)
            for (int x = 0; x < 65; ++x) {
                ASSERT_TRUE(r.output.at(x, y)[2] >= 0 && r.output.at(x, y)[2] <= l);
                total += r.output.at(x, y)[2];
            }
        EXPECT_GT(total, 0.5 * l);
        EXPECT_LT(total, 1.01 * l);
    }
}

// Fuzzed media and parameters: whatever a scene file may say, no crash and nothing but finite output.
TEST(Fuzz, RandomMediaAndParameters)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(0, 1);
    auto magnitude = [&](double low, double high) {
        return u(random) < 0.1 ? 0.0 : std::pow(10, low + (high - low) * u(random));
    };
    for (int i = 0; i < 1500; ++i) {
        char medium[600], parameters[300];
        snprintf(
            medium, sizeof medium,
            "\"scattering\":[%.6g,%.6g,%.6g],\"absorption\":[%.6g,%.6g,%.6g],\"g\":%.6g,\"density\":[{\"type\":\"constant\","
            "\"value\":%.6g},{\"type\":\"exponential\",\"value\":%.6g,\"falloff\":%.6g,\"direction\":[%.6g,%.6g,1e-3]}]",
            magnitude(-12, 8), magnitude(-12, 8), magnitude(-12, 8), magnitude(-12, 8), magnitude(-12, 8), magnitude(-12, 8),
            2 * u(random) - 1, magnitude(-20, 20), magnitude(-20, 20), magnitude(-9, 6), 2 * u(random) - 1,
            2 * u(random) - 1);
        const char *const sizes[] = {"2x2", "4x4", "6x6"}, *const fetches[] = {"linear_bilinear", "linear_bicubic",
                                                                               "cubic_bicubic"};
        snprintf(parameters, sizeof parameters,
                 "\"kernel_size\":\"%s\",\"fetch\":\"%s\",\"masking\":%s,\"mask_width\":%.6g,\"level_scale\":%.6g,"
                 "\"separation\":%s,"
                 "\"separation_luminance\":%.6g,\"separation_level\":%.6g,\"density_blurring\":%s",
                 sizes[random() % 3], fetches[random() % 3], random() % 2 ? "true" : "false", 100 * u(random),
                 0.1 + 9.9 * u(random), random() % 2 ? "true" : "false", magnitude(-3, 9), u(random),
                 random() % 2 ? "true" : "false");
        Picture color(7, 5, 4), depth(7, 5, 1);
        for (float &v : color.data)
            v = float(magnitude(-30, 30)) * (random() % 8 ? 1.0f : -1.0f);
        for (float &v : depth.data)
            v = float(magnitude(-30, 35));
        auto r = run(cpu(), scene(medium, parameters), color, depth);
        for (float v : r.output.data)
            ASSERT_TRUE(std::isfinite(v)) << i << ": " << medium << " " << parameters;
    }
}
