// Properties of multiscatter that cannot be tuned to.
#include <random>

#include <gtest/gtest.h>

#include "fog.h"

using namespace fog;

namespace {

// Kernel `paper`, unless the parameters name another.
std::string paper_scene(const std::string &medium, const std::string &parameters = "")
{
    if (parameters.find("\"kernel\"") != std::string::npos)
        return scene(medium, parameters);
    return scene(medium, "\"kernel\":\"paper\"" + (parameters.empty() ? "" : "," + parameters));
}

const std::string plain_filter = "\"masking\":false,\"separation\":false";

Picture constant_depth(int width, int height, float metres)
{
    return Picture(width, height, 1, metres);
}

Picture random_color(int width, int height, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(0, 1);
    Picture p(width, height, 4, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                p.at(x, y)[c] = u(random) < 0.02f ? 50 * u(random) : u(random);
    return p;
}

double sum(const Picture &p, int channel)
{
    double total = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            total += p.at(x, y)[channel];
    return total;
}

// Variance of channel 0 around its centroid, along x [px^2].
double variance(const Picture &p)
{
    double m0 = 0, m1 = 0, m2 = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            double v = p.at(x, y)[0];
            m0 += v;
            m1 += v * x;
            m2 += v * x * x;
        }
    return m2 / m0 - (m1 / m0) * (m1 / m0);
}

void ray_depth(brume_format &format)
{
    format.depth_kind = BRUME_DEPTH_RAY;
}

}  // namespace

class Backends : public testing::TestWithParam<const char *> {
protected:
    brume_context context()
    {
        if (std::string(GetParam()) == "cpu")
            return cpu();
        Context *context = gl();
        if (!context)
            throw std::runtime_error("no GL backend: Mesa's libegl1 and libgl1-mesa-dri give one anywhere");
        return *context;
    }
};

INSTANTIATE_TEST_SUITE_P(Filter, Backends, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

TEST_P(Backends, ConstantDepthIsBeersLaw)
{
    // Absorption only, so that nothing scatters back: the picture is T L, T = exp(-sigma d).
    double tolerance = std::string(GetParam()) == "cpu" ? 1e-6 : 1e-5;
    for (double sigma : {0.0, 1e-6, 0.01, 0.3, 2.0})
        for (float d : {1e-3f, 1.0f, 17.0f, 1000.0f}) {
            Picture color(5, 3, 4, 1), depth = constant_depth(5, 3, d);
            auto r = run(context(), paper_scene("\"absorption\":" + std::to_string(sigma)), color, depth,
                         {ray_depth, {"transmittance", "optical_depth"}, 0});
            double tau = std::stod(std::to_string(sigma)) * d;
            EXPECT_NEAR(r.output.at(2, 1)[1], std::exp(-tau), tolerance) << sigma << " " << d;
            EXPECT_NEAR(r.transmittance.at(4, 2)[0], std::exp(-tau), tolerance);
            EXPECT_NEAR(r.optical_depth.at(0, 0)[2], tau, tolerance * std::max(1.0, tau));
        }
}

TEST_P(Backends, PlanarDepthIsLongerTowardsTheCorners)
{
    Picture color(9, 9, 4, 1), depth = constant_depth(9, 9, 10);
    auto r = run(context(), paper_scene("\"absorption\":0.1"), color, depth, {{}, {"optical_depth"}, 0});
    double tangent = std::tan(25 * M_PI / 180) * 8 / 9;  // of the outermost pixel centres
    EXPECT_NEAR(r.optical_depth.at(4, 4)[0], 1, 1e-5);
    EXPECT_NEAR(r.optical_depth.at(0, 4)[0], std::sqrt(1 + tangent * tangent), 1e-5);
    EXPECT_NEAR(r.optical_depth.at(8, 8)[0], std::sqrt(1 + 2 * tangent * tangent), 1e-5);
}

// sigma_a = 0 in a uniformly bright scene returns the input: what leaves a line of sight comes in from others.
TEST_P(Backends, WhiteFurnace)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(0, 1);
    for (auto [w, h] : {std::pair(1, 1), {64, 48}, {37, 23}, {1, 200}, {130, 7}})
        for (const char *size : {"2x2", "4x4", "6x6"})
            for (const char *fetch : {"linear_bilinear", "linear_bicubic", "cubic_bicubic"}) {
                Picture color(w, h, 4, 3.5f), depth(w, h, 1);
                for (float &d : depth.data)
                    d = u(random) < 0.2f ? INFINITY : 100 * u(random);
                auto r = run(context(),
                             paper_scene("\"scattering\":0.02,\"g\":0.3",
                                         plain_filter + ",\"kernel_size\":\"" + size + "\",\"fetch\":\"" + fetch + "\""),
                             color, depth, {{}, {"transmittance"}, 0});
                // Depths differ per pixel, so L_sc varies; what is uniform is L. Only where all depths agree is L' = L.
                auto same = run(context(),
                                paper_scene("\"scattering\":0.02,\"g\":0.3",
                                            plain_filter + ",\"kernel_size\":\"" + size + "\",\"fetch\":\"" + fetch + "\""),
                                color, constant_depth(w, h, 40), {ray_depth});
                Worst worst = compare(same.output, color, 1e-3);
                EXPECT_LT(worst.error, 2e-6) << w << "x" << h << " " << size << " " << fetch << " " << worst.describe();
                // A pixel keeps at most its own light and takes at most as much from others.
                for (size_t i = 0; i < r.output.data.size(); ++i)
                    ASSERT_TRUE(r.output.data[i] >= 0 && r.output.data[i] <= 2 * 3.5f) << i;
            }
}

TEST_P(Backends, MaskingLosesHalfOfAUniformImagesScatteredLight)
{
    // As docs/accuracy.md says of the paper's mask, read literally.
    Picture color(256, 256, 4, 1);
    auto r = run(context(), paper_scene("\"scattering\":0.05,\"g\":0.8"), color, constant_depth(256, 256, 30),
                 {ray_depth, {"scattered", "transmittance"}, 0});
    double kept = r.scattered.at(128, 128)[0] / (1 - r.transmittance.at(128, 128)[0]);
    EXPECT_GT(kept, 0.2);
    EXPECT_LT(kept, 0.8);
}

// All the light of one lit pixel arrives somewhere: scattered energy is what the medium prescribes.
TEST_P(Backends, EnergyBalanceOfOnePixel)
{
    for (auto [w, h] : {std::pair(256, 256), {255, 193}})
        for (const char *size : {"2x2", "4x4", "6x6"})
            for (const char *fetch : {"linear_bilinear", "linear_bicubic", "cubic_bicubic"})
                for (double sigma : {0.002, 0.008, 0.02}) {
                    Picture color(w, h, 4, 0);
                    color.at(w / 2 + 1, h / 2 - 2)[0] = 1000;
                    auto r = run(context(),
                                 paper_scene("\"scattering\":" + std::to_string(sigma) + ",\"g\":0.9",
                                             plain_filter + ",\"kernel_size\":\"" + size + "\",\"fetch\":\"" + fetch + "\""),
                                 color, constant_depth(w, h, 20), {ray_depth, {"scattered"}, 0});
                    double expected = 1000 * -std::expm1(-sigma * 20);
                    EXPECT_NEAR(sum(r.scattered, 0) / expected, 1, 2e-3)
                        << w << "x" << h << " " << size << " " << fetch << " " << sigma;
                }
}

// The reference is exact: a lit pixel becomes the Gaussian of the deviation it reports.
TEST(Reference, OnePixelBecomesItsGaussian)
{
    Picture color(161, 161, 4, 0);
    color.at(80, 80)[0] = 1;
    auto r = run(cpu(), paper_scene("\"scattering\":0.005,\"g\":0.8", "\"kernel\":\"paper_reference\""), color,
                 constant_depth(161, 161, 20), {ray_depth, {"scattered", "blur_radius"}, 0});
    double w = r.blur_radius.at(80, 80)[0];
    ASSERT_GT(w, 2);
    ASSERT_LT(w, 12);
    EXPECT_NEAR(sum(r.scattered, 0) / -std::expm1(-0.1), 1, 1e-6);
    EXPECT_NEAR(std::sqrt(variance(r.scattered) - 1.0 / 12), w, 1e-4 * w);  // the receiving pixel adds 1/12
    // Iser eq. 1 without absorption: W = sqrt(P^3 sigma_s (1 - g) / 8), in pixels of this camera.
    double metres = std::sqrt(20.0 * 20 * 20 * 0.005 * 0.2 / 8), focal = 0.5 * 161 / std::tan(25 * M_PI / 180);
    EXPECT_NEAR(w, focal * metres / 20, 1e-4 * w);
}

TEST(Reference, SplattingIsLinearAndSymmetric)
{
    Picture a = random_color(33, 20, 1), b = random_color(33, 20, 2), both = a, depth = constant_depth(33, 20, 25);
    for (size_t i = 0; i < both.data.size(); ++i)
        both.data[i] = a.data[i] + b.data[i];
    std::string s = paper_scene("\"scattering\":0.03,\"g\":0.9", "\"kernel\":\"paper_reference\"");
    auto ra = run(cpu(), s, a, depth, {ray_depth}), rb = run(cpu(), s, b, depth, {ray_depth}),
         rab = run(cpu(), s, both, depth, {ray_depth});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 33; ++x)
            EXPECT_NEAR(rab.output.at(x, y)[1], ra.output.at(x, y)[1] + rb.output.at(x, y)[1], 1e-4);
    Picture flipped(33, 20, 4);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 33; ++x)
            std::copy_n(a.at(x, y), 4, flipped.at(32 - x, 19 - y));
    auto rf = run(cpu(), s, flipped, depth, {ray_depth});
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 33; ++x)
            EXPECT_NEAR(rf.output.at(32 - x, 19 - y)[2], ra.output.at(x, y)[2], 1e-5);
}

#ifdef BRUME_GL
TEST(Reference, IsRefusedOnGlWithTheParameter)
{
    if (!gl())
        throw std::runtime_error("no GL backend");
    const std::pair<const char *, const char *> asked[] = {
        {"\"multiscatter\":{\"kernel\":\"reference\"}", "multiscatter: method: reference on OpenGL; expected calibrated"},
        {"\"multiscatter\":{\"kernel\":\"paper_reference\"}",
         "multiscatter: method: paper_reference on OpenGL; expected paper"},
        {"\"airlight\":{\"tier\":\"reference\"}", "airlight: method: reference on OpenGL; expected nodes"}};
    for (const auto &[effect, message] : asked) {
        std::string text = paper_scene("\"scattering\":0.03", "");
        text.replace(text.find("\"effects\""), std::string::npos,
                     std::string("\"lights\":[{\"type\":\"point\",\"position\":[0,1,-5],\"intensity\":9}],\"effects\":{") +
                         effect + "}}");
        try {
            run(*gl(), text, Picture(4, 4, 4, 1), constant_depth(4, 4, 1));
            ADD_FAILURE() << "expected a refusal: " << message;
        } catch (const Failure &failure) {
            EXPECT_EQ(failure.status, BRUME_ERROR_UNSUPPORTED);
            EXPECT_EQ(std::string(failure.what()).find(message), 0u) << failure.what();
        }
    }
}
#endif

// How far the paper's level formula is from the deviation it is asked for, on one constant-depth lit pixel. The chain's and
// the fetch's variances give .893 W at whole levels (4 x 4, bicubic), and mixing two levels more between them.
TEST(Paper, RealisedDeviationAgainstTheOneAskedFor)
{
    double least = 1e9, most = 0;
    for (double sigma = 0.004; sigma < 0.2; sigma *= 1.3) {
        Picture color(513, 513, 4, 0);
        color.at(256, 256)[0] = 1000;
        auto r = run(cpu(), paper_scene("\"scattering\":" + std::to_string(sigma) + ",\"g\":0.9", plain_filter), color,
                     constant_depth(513, 513, 20), {ray_depth, {"scattered", "blur_radius"}, 0});
        double ratio = std::sqrt(variance(r.scattered)) / r.blur_radius.at(256, 256)[0];
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    printf("realised deviation / W: %.3f to %.3f\n", least, most);
    EXPECT_GT(least, 0.85);
    EXPECT_LT(most, 1.05);
}

// The same scene at twice the resolution, averaged down, gives the same picture within a stated bound.
TEST_P(Backends, ResolutionInvariance)
{
    const int w = 240, h = 135;
    Picture color(w, h, 4, 0.05f), depth(w, h, 1), color2(2 * w, 2 * h, 4), depth2(2 * w, 2 * h, 1);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            depth.at(x, y)[0] = y < h / 2 ? 60.0f : 60.0f * float(h / 2 + 1) / float(y + 1);
            bool lamp = (x / 8) % 6 == 2 && (y / 8) % 5 == 1;
            for (int c = 0; c < 3; ++c)
                color.at(x, y)[c] = lamp ? 40.0f / float(c + 1) : 0.02f + 0.2f * float((x / 16 + y / 16) % 2);
        }
    for (int y = 0; y < 2 * h; ++y)
        for (int x = 0; x < 2 * w; ++x) {
            std::copy_n(color.at(x / 2, y / 2), 4, color2.at(x, y));
            depth2.at(x, y)[0] = depth.at(x / 2, y / 2)[0];
        }
    std::string s = paper_scene("\"scattering\":0.03,\"g\":0.8");
    auto one = run(context(), s, color, depth), two = run(context(), s, color2, depth2);
    double error = 0, mean = 0, difference = 0;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (int c = 0; c < 3; ++c) {
                double b = 0.25 * (two.output.at(2 * x, 2 * y)[c] + two.output.at(2 * x + 1, 2 * y)[c] +
                                   two.output.at(2 * x, 2 * y + 1)[c] + two.output.at(2 * x + 1, 2 * y + 1)[c]);
                double a = one.output.at(x, y)[c];
                mean += a / (3.0 * w * h);
                difference += std::abs(a - b) / (3.0 * w * h);
                error = std::max(error, std::abs(a - b));
            }
    printf("1x against 2x: mean difference %.2f %% of the mean, largest %.2f of it\n", 100 * difference / mean,
           error / mean);
    EXPECT_LT(difference / mean, 0.01);
}

// A crop whose margin is wider than the blur shows the middle of the whole, within a stated bound.
TEST_P(Backends, CropWithMarginEqualsTheWhole)
{
    const int w = 320, h = 192, margin = 64;  // offsets in multiples of 2^levels keep the pyramids aligned
    Picture color = random_color(w, h, 5), depth(w, h, 1);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            depth.at(x, y)[0] = 5 + float((x / 40 + y / 30) % 3) * 5;
    const int cw = w - 2 * margin, ch = h - margin;
    Picture crop(cw, ch, 4), crop_depth(cw, ch, 1);
    for (int y = 0; y < ch; ++y)
        for (int x = 0; x < cw; ++x) {
            std::copy_n(color.at(x + margin, y), 4, crop.at(x, y));
            crop_depth.at(x, y)[0] = depth.at(x + margin, y)[0];
        }
    std::string s = paper_scene("\"scattering\":0.02,\"g\":0.9", "\"levels\":4");
    auto whole = run(context(), s, color, depth);
    auto part = run(context(), s, crop, crop_depth, {[&](brume_format &f) {
                        f.display_x = -margin;
                        f.display_width = w;
                        f.display_height = h;
                    }});
    double error = 0;
    for (int y = 0; y < ch - 64; ++y)
        for (int x = 64; x < cw - 64; ++x)
            for (int c = 0; c < 3; ++c)
                error = std::max<double>(error, std::abs(part.output.at(x, y)[c] / whole.output.at(x + margin, y)[c] - 1));
    EXPECT_LT(error, 1e-5);
}

TEST_P(Backends, ThePictureDoesNotDriftWhereSizesAreOdd)
{
    for (int size : {255, 256, 257, 333}) {
        Picture color(size, size, 4, 0);
        color.at(size / 2, size / 2)[0] = 1000;
        auto r = run(context(), paper_scene("\"scattering\":0.01,\"g\":0.9", plain_filter), color,
                     constant_depth(size, size, 20), {ray_depth, {"scattered"}, 0});
        double m0 = 0, mx = 0, my = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                double v = r.scattered.at(x, y)[0];
                m0 += v;
                mx += v * x;
                my += v * y;
            }
        EXPECT_NEAR(mx / m0, size / 2, 0.1) << size;
        EXPECT_NEAR(my / m0, size / 2, 0.1) << size;
    }
}

// The same medium, written with half the cross-sections at twice the density ratio, and as an exponential that hardly falls.
TEST_P(Backends, DensityTimesCrossSectionIsAllThatCounts)
{
    Picture color = random_color(90, 50, 7), depth = constant_depth(90, 50, 60);
    for (int x = 0; x < 90; ++x)
        for (int y = 0; y < 12; ++y)
            depth.at(x, y)[0] = 400;
    Options blur{{}, {"blur_radius"}, 0};
    auto one = run(context(), paper_scene("\"scattering\":0.02,\"absorption\":0.004,\"g\":0.7"), color, depth, blur);
    auto two = run(
        context(),
        paper_scene("\"scattering\":0.01,\"absorption\":0.002,\"g\":0.7,\"density\":[{\"type\":\"constant\",\"value\":2}]"),
        color, depth, blur);
    auto limit = run(
        context(),
        paper_scene(
            "\"scattering\":0.02,\"absorption\":0.004,\"g\":0.7,\"density\":[{\"type\":\"exponential\",\"falloff\":1e-9}]"),
        color, depth, blur);
    EXPECT_LT(compare(two.output, one.output, 1e-2).error, 1e-5);
    EXPECT_LT(compare(two.blur_radius, one.blur_radius, 1e-2).error, 1e-5);
    EXPECT_LT(compare(limit.output, one.output, 1e-2).error, 1e-3);
}

// Fog that thins out upwards lets some of the sky through and blurs it: its deviation is finite and not zero.
TEST_P(Backends, SkyBehindFiniteFogIsBlurred)
{
    Picture color(60, 60, 4, 0.2f), depth = constant_depth(60, 60, INFINITY);
    auto r = run(
        context(),
        paper_scene(
            "\"scattering\":0.02,\"g\":0.8,\"density\":[{\"type\":\"exponential\",\"falloff\":0.05,\"direction\":[0,1,0]}]"),
        color, depth, {{}, {"blur_radius", "optical_depth"}, 0});
    float w = r.blur_radius.at(30, 5)[0], tau = r.optical_depth.at(30, 5)[0];
    EXPECT_GT(tau, 0.5);
    EXPECT_LT(tau, 5);
    EXPECT_GT(w, 1);
    EXPECT_LT(w, 60);
}

TEST_P(Backends, EmissionSaturatesAtItsSourceFunction)
{
    Picture color(4, 4, 4, 0);
    for (float d : {0.01f, 1.0f, 100.0f, INFINITY}) {
        auto r = run(context(), paper_scene("\"absorption\":0.05,\"emission\":[0.1,0.05,0]"), color, constant_depth(4, 4, d),
                     {ray_depth});
        double share = std::isinf(d) ? 1 : -std::expm1(-0.05 * d);
        EXPECT_NEAR(r.output.at(1, 1)[0], 2 * share, 2e-5 * share + 1e-9) << d;
        EXPECT_NEAR(r.output.at(1, 1)[1], 1 * share, 2e-5 * share + 1e-9) << d;
        EXPECT_EQ(r.output.at(1, 1)[2], 0.0f);
    }
}

TEST_P(Backends, SkyOptions)
{
    Picture color(8, 8, 4, 1), depth = constant_depth(8, 8, INFINITY);
    std::string s = paper_scene("\"absorption\":0.1");
    EXPECT_EQ(run(context(), s, color, depth).output.at(3, 3)[0], 0.0f);
    EXPECT_EQ(run(context(), s, color, depth, {[](brume_format &f) { f.sky = BRUME_SKY_KEEP; }}).output.at(3, 3)[0], 1.0f);
    auto clamped = run(context(), s, color, depth, {[](brume_format &f) {
                           f.sky = BRUME_SKY_CLAMP;
                           f.sky_distance = 5;
                       }});
    EXPECT_NEAR(clamped.output.at(3, 3)[0], std::exp(-0.5), 1e-5);
}

TEST_P(Backends, SeparationKeepsTheGlowOfNearLightsBeforeAFarBackground)
{
    // The paper's Fig. 5d: density blurring cuts a bright foreground's glow at its edge; separation brings it back.
    Picture color(128, 128, 4, 0), depth = constant_depth(128, 128, 20000);
    for (int y = 60; y < 68; ++y)
        for (int x = 60; x < 68; ++x) {
            color.at(x, y)[0] = 100;
            depth.at(x, y)[0] = 30;
        }
    auto glow = [&](const std::string &parameters) {
        auto r = run(context(), paper_scene("\"scattering\":0.01,\"g\":0.5", parameters), color, depth,
                     {ray_depth, {"scattered"}, 0});
        double total = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                if (std::hypot(x - 63.5, y - 63.5) > 8)
                    total += r.scattered.at(x, y)[0];
        return total;
    };
    double without = glow(""), with = glow("\"separation\":true");
    EXPECT_GT(with, 2 * without + 1);
}

// K stopping early caps the blur: with one level a lit pixel reaches its neighbourhood, with all of them the whole image.
TEST_P(Backends, FewerLevelsCapTheBlur)
{
    Picture color(100, 60, 4, 0), depth = constant_depth(100, 60, 50);
    color.at(20, 30)[0] = 1000;
    auto far_away = [&](int levels) {
        auto r = run(context(), paper_scene("\"scattering\":0.05", plain_filter + ",\"levels\":" + std::to_string(levels)),
                     color, depth, {ray_depth, {"scattered"}, 0});
        EXPECT_GT(r.scattered.at(20, 30)[0], 0);
        return r.scattered.at(60, 30)[0];
    };
    EXPECT_EQ(far_away(1), 0);
    EXPECT_EQ(far_away(2), 0);
    EXPECT_GT(far_away(0), 0);
}
