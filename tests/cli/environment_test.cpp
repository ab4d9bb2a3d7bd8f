// Environment images: the harmonics, the projection of a lat-long image, and what the tool makes of a scene that names one.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <brume/brume.h>

#include "environment/harmonics.hpp"
#include "files.hpp"
#include "image/frame.hpp"
#include "image/library.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;
using nlohmann::json;

TEST(Harmonics, AreOrthonormal)
{
    // The trapezoid rule around and Simpson's from pole to pole; products are trigonometric polynomials of degree 10.
    constexpr int around = 24, down = 2000;
    std::vector<std::array<double, kHarmonics>> sums(kHarmonics);
    for (int j = 0; j <= down; ++j) {
        const double theta = std::numbers::pi * j / down, simpson = (j == 0 || j == down ? 1.0 : j % 2 ? 4.0 : 2.0) / 3.0;
        const double weight = simpson * std::numbers::pi / down * std::sin(theta) * 2 * std::numbers::pi / around;
        for (int i = 0; i < around; ++i) {
            const double phi = 2 * std::numbers::pi * i / around;
            const auto y = harmonics({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
            for (std::size_t a = 0; a < y.size(); ++a)
                for (std::size_t b = 0; b < y.size(); ++b)
                    sums[a][b] += weight * y[a] * y[b];
        }
    }
    double worst = 0;
    for (std::size_t a = 0; a < sums.size(); ++a)
        for (std::size_t b = 0; b < sums.size(); ++b)
            worst = std::max(worst, std::abs(sums[a][b] - (a == b)));
    EXPECT_LT(worst, 1e-9);
}

TEST(Harmonics, AreThoseOfTheHeader)
{
    const std::array<double, 3> d{0.48, 0.6, 0.64};
    const auto y = harmonics(d);
    EXPECT_NEAR(y[0], 0.28209479, 1e-8);
    EXPECT_NEAR(y[1], 0.48860251 * d[1], 1e-8);
    EXPECT_NEAR(y[2], 0.48860251 * d[2], 1e-8);
    EXPECT_NEAR(y[3], 0.48860251 * d[0], 1e-8);
    EXPECT_NEAR(y[4], 1.09254843 * d[0] * d[1], 1e-8);
    EXPECT_NEAR(y[6], 0.31539157 * (3 * d[2] * d[2] - 1), 1e-8);
    EXPECT_NEAR(y[8], 0.54627422 * (d[0] * d[0] - d[1] * d[1]), 1e-8);
}

void expect_direction(const std::array<double, 3> &got, double x, double y, double z)
{
    EXPECT_NEAR(got[0], x, 1e-12);
    EXPECT_NEAR(got[1], y, 1e-12);
    EXPECT_NEAR(got[2], z, 1e-12);
}

TEST(LatLong, DirectionsAreThoseOfTheHeader)
{
    expect_direction(latlong_direction(0.5, 0.5, BRUME_UP_Y), 0, 0, -1);
    expect_direction(latlong_direction(0.75, 0.5, BRUME_UP_Y), 1, 0, 0);
    expect_direction(latlong_direction(0.1, 0, BRUME_UP_Y), 0, 1, 0);
    expect_direction(latlong_direction(0, 0.5, BRUME_UP_Y), 0, 0, 1);
    expect_direction(latlong_direction(0.5, 0.5, BRUME_UP_Z), 0, 1, 0);
    expect_direction(latlong_direction(0.75, 0.5, BRUME_UP_Z), 1, 0, 0);
    expect_direction(latlong_direction(0.1, 0, BRUME_UP_Z), 0, 0, 1);
}

TEST(LatLong, OnePixelIsLightFromEverywhere)
{
    const float pixel[] = {1, 2, -3, 0.5f};
    const HarmonicsRgb c = project_latlong({1, 1, 0, 0, 1, 1, pixel, 4}, BRUME_UP_Y);
    EXPECT_NEAR(c[0][0], std::sqrt(4 * std::numbers::pi), 1e-9);
    EXPECT_NEAR(c[0][1], 2 * c[0][0], 1e-9);
    EXPECT_EQ(c[0][2], 0);
    for (std::size_t k = 1; k < c.size(); ++k)
        EXPECT_NEAR(c[k][0], 0, 1e-4) << k;
}

TEST(LatLong, ALitPixelIsALightInItsDirection)
{
    constexpr int width = 256, height = 128;
    for (std::uint32_t up : {BRUME_UP_Y, BRUME_UP_Z}) {
        for (const auto &[x, y] : {std::pair{200, 20}, {128, 64}, {3, 125}}) {
            // The window is the pixel and a broken neighbour to the right of it.
            const float pixels[] = {0, 40, 0, NAN, INFINITY, -INFINITY};
            const HarmonicsRgb c = project_latlong({width, height, x, y, 2, 1, pixels, 3}, up);
            constexpr int cells = 40;
            std::array<double, kHarmonics> expected{};
            double power = 0;
            for (int j = 0; j < cells; ++j) {
                for (int i = 0; i < cells; ++i) {
                    const double u = (x + (i + 0.5) / cells) / width, v = (y + (j + 0.5) / cells) / height;
                    const double weight = 40 * 2 * std::numbers::pi / (width * cells) * std::sin(std::numbers::pi * v) *
                                          std::numbers::pi / (height * cells);
                    const auto at = harmonics(latlong_direction(u, v, up));
                    power += weight;
                    for (std::size_t k = 0; k < at.size(); ++k)
                        expected[k] += weight * at[k];
                }
            }
            for (std::size_t k = 0; k < c.size(); ++k) {
                EXPECT_NEAR(c[k][1], expected[k], 5e-4 * power) << "coefficient " << k << " up " << up;
                EXPECT_EQ(c[k][0], 0);
                EXPECT_EQ(c[k][2], 0);
            }
        }
    }
}

class Environment : public testing::Test {
protected:
    Environment() { write_exr(in_, {{rgbz()}}); }

    Result plan(const std::string &environment, const std::string &lights = "[]", std::vector<std::string> more = {})
    {
        write_text(scene_, R"({"brume":1,"medium":{"absorption":0.1},"environment":)" + environment + R"(,"lights":)" +
                               lights + R"(,"effects":{"multiscatter":{}}})");
        std::vector<std::string> words{"plan", scene_.string(), in_.string(), "--backend", "cpu", "--vfov", "50", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json", in_ = folder_ / "in.exr", sky_ = folder_ / "sky.exr";
};

TEST_F(Environment, AnImageBesideTheSceneIsProjected)
{
    write_exr(sky_, {{rgb()}});
    const Result from_file = plan(R"({"file": "sky.exr", "up": "z"})");
    ASSERT_EQ(from_file.status, 0) << from_file.err;
    EXPECT_EQ(json::parse(from_file.out)["environment"], 36);
    const Result from_text = plan(R"({"sh": [[1,1,1]]})");
    ASSERT_EQ(from_text.status, 0) << from_text.err;
    EXPECT_EQ(json::parse(from_text.out)["environment"], 1);
}

TEST_F(Environment, AnImageMayBeOfAnyFormat)
{
    write_exr(sky_, {{rgb("", Imf::FLOAT)}});
    const tool::ImageFile file(sky_);
    const tool::Frame frame = tool::read_frame(file, tool::resolve_color(file, {}), nullptr);
    const tool::Raster raster{frame.width, frame.height, {"R", "G", "B"}, tool::SampleType::kFloat, frame.pixels.data()};
    for (const char *name : {"sky.hdr", "sky.tif"}) {
        tool::image_library().write(folder_ / name, name, std::string(name) == "sky.hdr" ? "hdr" : "tiff", raster);
        const Result r = plan(R"({"file": ")" + std::string(name) + R"("})");
        EXPECT_EQ(r.status, 0) << r.err;
        EXPECT_EQ(json::parse(r.out)["environment"], 36) << name;
    }
}

TEST_F(Environment, AnImageThatCannotBeReadIsAWrongRequest)
{
    const Result missing = plan(R"({"file": "sky.exr"})");
    EXPECT_EQ(missing.status, 2);
    EXPECT_NE(missing.err.find(sky_.string()), std::string::npos) << missing.err;
    write_text(sky_, "no image");
    const Result broken = plan(R"({"file": "sky.exr"})");
    EXPECT_EQ(broken.status, 2);
    EXPECT_NE(broken.err.find(sky_.string()), std::string::npos) << broken.err;
    write_exr(sky_, {{rgb(), {{-2, 0}, {29, 23}}}});
    const Result outside = plan(R"({"file": "sky.exr"})");
    EXPECT_EQ(outside.status, 2);
    EXPECT_NE(outside.err.find("display window"), std::string::npos) << outside.err;
}

TEST_F(Environment, PlansCountLightsAndGaussians)
{
    const Result r = plan(R"({"sh": [[1,1,1]]})", R"([{"type": "point", "position": [0,0,0], "intensity": 1}])");
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(json::parse(r.out)["lights"], 1);
    EXPECT_EQ(json::parse(r.out)["gaussians"], 0);
}

TEST_F(Environment, LayersOfLightsThatAreNotThereAreRefused)
{
    const std::string lamp = R"([{"type": "point", "position": [0,0,0], "intensity": 1}])";
    for (const char *layer : {"light1", "light01", "light", "light-1", "light99999999999"}) {
        const Result r = plan(R"({"sh": [[1,1,1]]})", lamp, {"--layers", layer});
        EXPECT_EQ(r.status, 2) << layer;
        EXPECT_NE(r.err.find(layer), std::string::npos) << r.err;
    }
}

}  // namespace
}  // namespace brume::tests
