// Properties of kernel `calibrated` that cannot be tuned to.
#include <random>

#include <gtest/gtest.h>

#include "lit_scene.h"

using namespace fog;

namespace {

const std::string kernel = "\"kernel\":\"calibrated\"";

const char *clear_media[] = {"\"scattering\":0.02,\"g\":0.3", "\"scattering\":[0.05,0.02,0.01],\"g\":0.9",
                             "\"scattering\":2,\"g\":-0.5",
                             ("\"scattering\":0.1,\"density\":[{\"type\":\"exponential\",\"value\":1,\"falloff\":0.25,"
                              "\"direction\":[0.1,1,0.2]}]")};
const char *dark_media[] = {"\"scattering\":[0.02,0.03,0.05],\"absorption\":[0.01,0,0.002],\"g\":0.8",
                            "\"scattering\":0.001,\"g\":-0.3,\"emission\":[0.01,0.02,0.03]"};

Picture random_depth(int width, int height, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(0, 1);
    Picture depth(width, height, 1);
    for (float &d : depth.data)
        d = u(random) < 0.2f ? INFINITY : 100 * u(random);
    return depth;
}

Picture random_lights(int width, int height, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> u(0, 1);
    Picture p(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 4; ++c)
                p.at(x, y)[c] = c < 3 && u(random) < 0.01f ? 200 * u(random) : 0.5f * u(random);
    return p;
}

// The kernel at its full and its reduced qualities.
const char *qualities[] = {"",
                           ",\"lobes\":\"every\"",
                           ",\"lobes\":\"third\"",
                           ",\"resolution\":\"half\"",
                           ",\"resolution\":\"quarter\"",
                           ",\"resolution\":\"quarter\",\"lobes\":\"third\""};

double scattered_sum(const Result &r)
{
    double sum = 0;
    for (int y = 0; y < r.scattered.height; ++y)
        for (int x = 0; x < r.scattered.width; ++x)
            sum += r.scattered.at(x, y)[0];
    return sum;
}

class Calibrated : public testing::TestWithParam<const char *> {
protected:
    brume_context context() { return backend(GetParam()); }
};

}  // namespace

// In a medium that absorbs nothing a uniform image stays as it is, whatever lies where.
TEST_P(Calibrated, WhiteFurnace)
{
    for (auto [w, h] : {std::pair(1, 1), {64, 48}, {37, 23}, {1, 200}, {130, 7}, {2, 2}})
        for (const char *medium : clear_media)
            for (const std::string levels : {"", ",\"levels\":3"})
                for (const char *quality : qualities) {
                    const Picture color(w, h, 4, 3.5f);
                    const Worst worst = compare(
                        run(context(), scene(medium, kernel + levels + quality), color, random_depth(w, h, 3)).output, color,
                        1e-3);
                    EXPECT_LT(worst.error, 1e-5)
                        << w << "x" << h << " " << medium << levels << quality << " " << worst.describe();
                }
}

// Nor does it matter that most of it is a sky without fog in front.
TEST_P(Calibrated, WhiteFurnaceBeneathAKeptSky)
{
    for (auto [w, h] : {std::pair(4, 15), {7, 3}, {5, 15}, {37, 23}})
        for (const char *quality : qualities)
            for (unsigned seed = 0; seed < 20; ++seed) {
                const Picture color(w, h, 4, 3.5f);
                Picture depth = random_depth(w, h, seed);
                for (size_t i = 0; i < depth.data.size(); ++i)
                    if (i % 19 != 0)
                        depth.data[i] = INFINITY;
                const Worst worst = compare(run(context(), scene(clear_media[1], kernel + quality), color, depth,
                                                {[](brume_format &format) { format.sky = BRUME_SKY_KEEP; }})
                                                .output,
                                            color, 1e-3);
                EXPECT_LT(worst.error, 1e-5) << w << "x" << h << quality << " " << worst.describe();
            }
}

// What arrives of a pixel's scattered light: T_tot - e^-tau, of which none is lost on the way over the pyramid. The image
// spans 160 degrees and so holds the widest spread.
TEST_P(Calibrated, EnergyOfOnePixel)
{
    for (double tau : {0.01, 0.1, 1.0, 4.0})
        for (const char *quality : qualities) {
            const int w = 256, h = 256;
            Picture color(w, h, 4, 0);
            color.at(w / 2 + 1, h / 2 - 2)[0] = 1000;
            Json s = Json::parse(scene("\"scattering\":" + std::to_string(tau / 20) + ",\"g\":0.9", kernel + quality));
            s["camera"]["vertical_fov"] = 160;
            const Result r = run(context(), s.dump(), color, Picture(w, h, 1, 20),
                                 {[](brume_format &f) { f.depth_kind = BRUME_DEPTH_RAY; }, {"scattered"}, 0});
            const double expected = 1000 * (1 / (1 + 0.45 * std::pow(0.1 * tau, 1.2)) - std::exp(-tau));
            EXPECT_NEAR(scattered_sum(r) / expected, 1, 1e-3) << tau << quality;
        }
}

TEST_P(Calibrated, DensityTimesCrossSectionIsAllThatCounts)
{
    const Picture color = random_lights(90, 50, 7), depth = random_depth(90, 50, 8);
    const Picture one =
        run(context(), scene("\"scattering\":0.02,\"absorption\":0.004,\"g\":0.7", kernel), color, depth).output;
    const Picture two = run(context(),
                            scene("\"scattering\":0.01,\"absorption\":0.002,\"g\":0.7,"
                                  "\"density\":[{\"type\":\"constant\",\"value\":2}]",
                                  kernel),
                            color, depth)
                            .output;
    const Worst worst = compare(two, one, 1e-2);
    EXPECT_LT(worst.error, 1e-4) << worst.describe();
}

// Steps of a fifth of a pixel; what arrives does not flicker.
TEST_P(Calibrated, AMovingLightKeepsItsEnergy)
{
    const int w = 160, h = 120;
    double least = 1e30, most = 0;
    for (int step = 0; step <= 20; ++step) {
        const double x = 80 + 0.2 * step;
        Picture color(w, h, 4, 0);
        color.at(int(x), 61)[0] = float(1000 * (1 - (x - std::floor(x))));
        color.at(int(x) + 1, 61)[0] = float(1000 * (x - std::floor(x)));
        const double sum = scattered_sum(run(context(), scene("\"scattering\":0.05,\"g\":0.8", kernel), color,
                                             Picture(w, h, 1, 20), {{}, {"scattered"}, 0}));
        least = std::min(least, sum);
        most = std::max(most, sum);
    }
    EXPECT_LT(most / least, 1.01);
}

// The same scene at twice the resolution, averaged down.
// A part of one view of 240 x 135 squares, `factor` pixels each way a square.
struct View {
    int factor = 1, x = 0, y = 0, width = 240, height = 135;  // in squares
    static constexpr int whole_width = 240, whole_height = 135;

    Frame frame() const
    {
        Frame f{Picture(width * factor, height * factor, 4), Picture(width * factor, height * factor, 1)};
        for (int j = 0; j < height * factor; ++j)
            for (int i = 0; i < width * factor; ++i) {
                const int column = x + i / factor, row = y + j / factor;
                const bool lamp = (column / 8) % 6 == 2 && (row / 8) % 5 == 1;
                for (int c = 0; c < 3; ++c)
                    f.color.at(i, j)[c] = lamp ? 40.0f / float(c + 1) : 0.02f + 0.2f * float((column / 16 + row / 16) % 2);
                f.depth.at(i, j)[0] = 2 * row < whole_height ? 60.0f : 60.0f * float(whole_height + 1) / float(row * 2 + 1);
            }
        return f;
    }
    // Fogged, means over squares. fov: of the image if that is the display window, which it is unless `crops`.
    Picture fogged(brume_context context, bool crops, double fov) const
    {
        Json s = Json::parse(scene("\"scattering\":0.03,\"g\":0.8", kernel));
        s["camera"]["vertical_fov"] = fov;
        const Frame f = frame();
        const Picture p = run(context, s.dump(), f.color, f.depth, Options{[&](brume_format &format) {
                                  if (!crops)
                                      return;
                                  format.display_x = -x * factor;
                                  format.display_y = -y * factor;
                                  format.display_width = whole_width * factor;
                                  format.display_height = whole_height * factor;
                              }})
                              .output;
        Picture means(width, height, 3);
        for (int j = 0; j < p.height; ++j)
            for (int i = 0; i < p.width; ++i)
                for (int c = 0; c < 3; ++c)
                    means.at(i / factor, j / factor)[c] += p.at(i, j)[c] / float(factor * factor);
        return means;
    }
    // Mean difference from the whole view, of the whole's mean there, `margin` squares off this one's edges.
    double apart(brume_context context, bool crops, double fov, int margin) const
    {
        const Picture whole = View{}.fogged(context, false, 50), part = fogged(context, crops, fov);
        double mean = 0, difference = 0;
        for (int j = margin; j < height - margin; ++j)
            for (int i = margin; i < width - margin; ++i)
                for (int c = 0; c < 3; ++c) {
                    mean += whole.at(x + i, y + j)[c];
                    difference += std::abs(double(whole.at(x + i, y + j)[c]) - part.at(i, j)[c]);
                }
        return difference / mean;
    }
};

TEST_P(Calibrated, ResolutionInvariance)
{
    for (int factor : {2, 4}) {
        const double apart = View{factor}.apart(context(), false, 50, 0);
        printf("1x against %dx: mean difference %.2f %% of the mean\n", factor, 100 * apart);
        // At 4x there is a level of the pyramid between the coarse pixels.
        EXPECT_LT(apart, factor == 2 ? 0.005 : 0.025);
    }
}

// What is outside a crop or a narrower view lights nothing any more; of what is left, the pyramid's grid lies elsewhere.
TEST_P(Calibrated, CropsAndFieldsOfView)
{
    const double crop = View{1, 37, 21, 161, 93}.apart(context(), true, 50, 24);
    const double degree = 3.14159265358979323846 / 180, half = 2 * std::atan(std::tan(25 * degree) * 67 / 135) / degree;
    const double narrow = View{2, 60, 34, 120, 67}.apart(context(), false, half, 20);
    printf("against the whole: a crop %.2f %%, half the field of view %.2f %% of the mean\n", 100 * crop, 100 * narrow);
    EXPECT_LT(crop, 0.17);
    EXPECT_LT(narrow, 0.11);
}

// The same lamp before the same wall, in images of sizes next to powers of two and far from them.
TEST_P(Calibrated, AnySizeShowsAsMuchLight)
{
    for (double place : {0.5, 0.99}) {
        double least = 1e30, most = 0;
        for (auto [w, h] : {std::pair(254, 126), {255, 127}, {256, 128}, {257, 129}, {258, 130}, {320, 160}}) {
            Picture color(w, h, 4, 0);
            const double x = place * w, y = 0.5 * h, radius = 0.02 * h;
            double light = 0;
            for (int j = 0; j < h; ++j)
                for (int i = 0; i < w; ++i)
                    if (std::hypot(i + 0.5 - x, j + 0.5 - y) < radius)
                        light += color.at(i, j)[0] = 1000;
            const double share = scattered_sum(run(context(), scene("\"scattering\":0.05,\"g\":0.8", kernel), color,
                                                   Picture(w, h, 1, 20), {{}, {"scattered"}, 0})) /
                                 light;
            least = std::min(least, share);
            most = std::max(most, share);
        }
        printf("a lamp at %.2f of the width: its light in the fog differs by a factor of %.3f between sizes\n", place,
               most / least);
        EXPECT_LT(most / least, place == 0.5 ? 1.03 : 1.5) << place;
    }
}

// The scattered light of a lamp that is a ball of 1.5 degrees, in all directions at 20 m but for the lamp, at 10.
struct Glow {
    double tangent, aspect;  // of half the height; of a pixel
    Picture scattered;

    Glow(brume_context context, int width, int height, double vertical_fov, double pixel_aspect, double off_axis)
        : tangent(std::tan(vertical_fov * degree / 2)), aspect(pixel_aspect)
    {
        const Vector lamp{std::sin(off_axis * degree), 0, -std::cos(off_axis * degree)};
        Picture color(width, height, 4, 0), depth(width, height, 1, 20);
        constexpr int fine = 8;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                int within = 0;
                for (int k = 0; k < fine * fine; ++k) {
                    const double u = (2 * (x + (k % fine + 0.5) / fine) - width) * aspect * tangent / height,
                                 v = (height - 2 * (y + (k / fine + 0.5) / fine)) * tangent / height;
                    within += (lamp[0] * u - lamp[2]) / std::sqrt(u * u + v * v + 1) > std::cos(1.5 * degree);
                }
                if (within)
                    depth.at(x, y)[0] = 10;
                color.at(x, y)[0] = color.at(x, y)[1] = color.at(x, y)[2] = 1000.0f * float(within) / (fine * fine);
            }
        const Json fog{{"brume", 1},
                       {"camera", {{"vertical_fov", vertical_fov}, {"pixel_aspect", pixel_aspect}}},
                       {"medium", {{"scattering", 0.05}, {"g", 0.8}}},
                       {"effects", {{"multiscatter", Json::object()}}}};
        scattered = run(context, fog.dump(), color, depth,
                        Options{[](brume_format &format) { format.depth_kind = BRUME_DEPTH_RAY; }, {"scattered"}})
                        .scattered;
    }

    // In a direction so far right and up of the axis [degrees].
    double at(double right, double up) const
    {
        const double u = std::tan(right * degree), v = std::tan(up * degree) * std::sqrt(1 + u * u);
        const double x = 0.5 * scattered.width + 0.5 * scattered.height * u / (aspect * tangent) - 0.5,
                     y = 0.5 * scattered.height * (1 - v / tangent) - 0.5;
        const int i = int(x), j = int(y);
        const double a = x - i, b = y - j;
        auto pixel = [&](int dx, int dy) { return double(scattered.at(i + dx, j + dy)[0]); };
        return (1 - b) * ((1 - a) * pixel(0, 0) + a * pixel(1, 0)) + b * ((1 - a) * pixel(0, 1) + a * pixel(1, 1));
    }

    static constexpr double degree = 3.14159265358979323846 / 180;
};

// A limit: angles count as in the middle of the picture, and pixels as squares.
TEST_P(Calibrated, GlowsAreRoundInPixels)
{
    const double middle = Glow(context(), 181, 181, 90, 1, 0).at(0, 4);
    const Glow aside(context(), 181, 181, 90, 1, 35);
    const double above = aside.at(35, 4) / middle, inward = aside.at(31, 0) / middle;
    printf("4 degrees from a lamp 35 degrees off the axis: %.2f times as bright above it, %.2f inward\n", above, inward);
    EXPECT_NEAR(above, 1, 0.5);
    EXPECT_NEAR(inward, 1, 0.5);
    const Glow wide(context(), 90, 181, 60, 2, 0), square(context(), 181, 181, 60, 1, 0);
    const double beside = wide.at(8, 0) / square.at(8, 0), over = wide.at(0, 8) / square.at(0, 8);
    printf("8 degrees from a lamp, pixels twice as wide as high: %.2f times as bright beside it, %.2f above\n", beside,
           over);
    EXPECT_NEAR(beside, 1, 1);
    EXPECT_NEAR(over, 1, 1);
}

// A lamp gives the fog as much light before a far dark background as before one as near as itself.
TEST_P(Calibrated, WhatIsBehindALampTakesNoneOfItsLight)
{
    const int w = 240, h = 160;
    for (const char *medium : {"\"scattering\":0.06,\"g\":0.8", "\"scattering\":0.06,\"absorption\":0.01,\"g\":0.8",
                               "\"scattering\":0.02,\"g\":0"})
        for (double radius : {3, 12, 30})
            for (const char *quality : {"", ",\"lobes\":\"every\"", ",\"resolution\":\"half\""}) {
                auto light = [&](float behind) {
                    Picture color(w, h, 4, 0), depth(w, h, 1, behind);
                    for (int y = 0; y < h; ++y)
                        for (int x = 0; x < w; ++x)
                            if (std::hypot(x + 0.5 - w / 2, y + 0.5 - h / 2) < radius) {
                                color.at(x, y)[0] = 10;
                                depth.at(x, y)[0] = 3;
                            }
                    return scattered_sum(
                        run(context(), scene(medium, kernel + quality), color, depth, {{}, {"scattered"}, 0}));
                };
                const double near = light(3);
                for (float behind : {6.0f, 20.0f, 60.0f, 200.0f})
                    EXPECT_NEAR(light(behind) / near, 1, 0.01)
                        << medium << quality << ", radius " << radius << ", " << behind << " m";
            }
}

// Light reaches a near surface's pixel only through the medium in front of it.
TEST_P(Calibrated, FarLightsDoNotShineThroughNearSurfaces)
{
    const int w = 128, h = 96;
    Picture color(w, h, 4, 0), depth(w, h, 1, 40);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w / 2; ++x)
            depth.at(x, y)[0] = 0.01f;
    color.at(w / 2 + 3, h / 2)[0] = 1000;
    const Picture scattered =
        run(context(), scene("\"scattering\":0.03,\"g\":0.8", kernel), color, depth, {{}, {"scattered"}, 0}).scattered;
    EXPECT_GT(scattered.at(w / 2 + 8, h / 2)[0], 0.1);
    EXPECT_LT(scattered.at(w / 2 - 2, h / 2)[0], 1e-3 * scattered.at(w / 2 + 8, h / 2)[0]);
}

INSTANTIATE_TEST_SUITE_P(All, Calibrated, testing::ValuesIn(fog::backend_names),
                         [](auto &info) { return std::string(info.param); });

// The reference shares the spread and the arrived fraction with the kernel, but neither pyramid nor tables by level.
TEST(CalibratedReference, WhiteFurnaceAndEnergyOfOnePixel)
{
    const std::string reference = "\"kernel\":\"reference\"";
    for (const char *medium : clear_media) {
        const Picture color(37, 23, 4, 3.5f);
        const Worst worst =
            compare(run(cpu(), scene(medium, reference), color, random_depth(37, 23, 3)).output, color, 1e-3);
        EXPECT_LT(worst.error, 1e-6) << medium << " " << worst.describe();
    }
    Picture color(48, 40, 4, 0);
    color.at(23, 20)[0] = 1000;
    Json wide = Json::parse(scene("\"scattering\":0.05,\"g\":0.9", reference));
    wide["camera"]["vertical_fov"] = 160;
    const Result r = run(cpu(), wide.dump(), color, Picture(48, 40, 1, 20),
                         {[](brume_format &f) { f.depth_kind = BRUME_DEPTH_RAY; }, {"scattered"}, 0});
    EXPECT_NEAR(scattered_sum(r) / (1000 * (1 / (1 + 0.45 * std::pow(0.1, 1.2)) - std::exp(-1.0))), 1, 3e-3)
        << "a sum over pixels, against the integral over angles";
}

#ifdef BRUME_GL
TEST(GpuAgainstCpu, KernelCalibrated)
{
    double worst = 0;
    for (auto [w, h] : {std::pair(160, 90), {61, 37}, {3, 5}})
        for (const char *medium :
             {clear_media[0], clear_media[1], clear_media[2], clear_media[3], dark_media[0], dark_media[1]})
            for (const char *quality : qualities) {
                const Picture color = random_lights(w, h, 2), depth = random_depth(w, h, 5);
                const Worst found = compare(run(backend("gl"), scene(medium, kernel + quality), color, depth).output,
                                            run(cpu(), scene(medium, kernel + quality), color, depth).output, 0.05);
                worst = std::max(worst, found.error);
                EXPECT_LT(found.error, 2e-3) << w << "x" << h << " " << medium << quality << " " << found.describe();
            }
    printf("kernel calibrated, GL against CPU: worst %.2g\n", worst);
}

// Rows that end anywhere in a group of pixels side by side.
TEST(GpuAgainstCpu, KernelCalibratedInEveryWidth)
{
    for (int w = 1; w <= 34; ++w)
        for (const char *quality : {"", ",\"resolution\":\"half\""}) {
            const Picture color = random_lights(w, 5, 2), depth = random_depth(w, 5, 5);
            const std::string text = scene(clear_media[0], kernel + quality);
            const Worst found =
                compare(run(backend("gl"), text, color, depth).output, run(cpu(), text, color, depth).output, 0.05);
            EXPECT_LT(found.error, 1e-4) << w << " " << quality << " " << found.describe();
        }
}
#endif
