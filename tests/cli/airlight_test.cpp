// Scenes with lights, Gaussians and environments, from the scene file to the layers in the output.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "files.hpp"

namespace brume::tests {
namespace {

using Vector = std::array<double, 3>;

constexpr double kFov = 50, kDistance = 10;

/// Of the pixel's ray from a camera at the origin that looks down -z.
Vector direction(int x, int y)
{
    const double t = std::tan(kFov / 2 * std::numbers::pi / 180);
    const double right = (2 * (x + 0.5) / kWidth - 1) * t * kWidth / kHeight, top = (1 - 2 * (y + 0.5) / kHeight) * t;
    const double length = std::sqrt(right * right + top * top + 1);
    return {right / length, top / length, -1 / length};
}

/// Simpson's rule from 0 to kDistance.
template <class Function> double integrate(Function f)
{
    constexpr int n = 4000;
    double sum = f(0.0) + f(kDistance);
    for (int i = 1; i < n; ++i)
        sum += (i % 2 ? 4 : 2) * f(kDistance * i / n);
    return sum * kDistance / n / 3;
}

class Airlight : public testing::Test {
protected:
    Airlight()
    {
        TestPart part{rgb()};
        part.channels.push_back({"Z", Imf::FLOAT, constant(kDistance)});
        write_exr(in_, {part});
    }

    /// `scene` without its braces; the camera is at the origin and looks down -z.
    Result run(const std::string &scene, std::vector<std::string> more = {})
    {
        write_text(scene_, R"({"brume":1, "camera": {"vertical_fov": 50,
            "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}, )" +
                               scene + "}");
        std::vector<std::string> words{"run",       scene_.string(), in_.string(),   "-o", out_.string(),
                                       "--backend", "cpu",           "--depth-kind", "ray"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    std::vector<double> layer(const std::string &name, const std::string &channel = "R") const
    {
        return read_plane(out_, "brume." + name + "." + channel);
    }

    Folder folder_;
    fs::path scene_ = folder_ / "fog.json", in_ = folder_ / "in.exr", out_ = folder_ / "out.exr";
};

const std::string kMist = R"("medium": {"scattering": 0.05, "absorption": 0.02}, "effects": {"airlight": {}})";

TEST_F(Airlight, OfALampIsItsIntegral)
{
    const Result r = run(kMist + R"(, "lights": [{"type": "point", "position": [1, 2, -6], "intensity": [30, 20, 10]}])",
                         {"--layers", "airlight,transmittance"});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto airlight = layer("airlight"), blue = layer("airlight", "B"), transmittance = layer("transmittance"),
               before = read_plane(in_, "R"), after = read_plane(out_, "R");
    double worst = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const Vector w = direction(x, y);
            const double expected = integrate([&](double t) {
                const double d = std::hypot(t * w[0] - 1, t * w[1] - 2, t * w[2] + 6);
                return 0.05 / (4 * std::numbers::pi) * std::exp(-0.07 * (t + d)) * 30 / (d * d);
            });
            const auto i = std::size_t(y * kWidth + x);
            worst = std::max(worst, std::abs(airlight[i] / expected - 1));
            EXPECT_NEAR(blue[i], airlight[i] / 3, 1e-3 * airlight[i]);
            EXPECT_NEAR(transmittance[i], std::exp(-0.07 * kDistance), 1e-3);
            EXPECT_NEAR(after[i], before[i] * transmittance[i] + airlight[i], 2e-3);
        }
    }
    EXPECT_LT(worst, 2e-3) << "of which half a thousandth is the layer's type";
}

TEST_F(Airlight, OfAllLightsIsTheSumOfEach)
{
    const Result r = run(kMist + R"(, "lights": [
        {"type": "point", "position": [1, 2, -6], "intensity": 30},
        {"type": "point", "position": [0, 0, -4], "intensity": 0},
        {"type": "spot", "position": [-2, 3, -7], "direction": [0.3, -1, 0.1], "intensity": [9, 30, 9], "angle": 70},
        {"type": "directional", "direction": [1, -1, 0], "intensity": 0.3, "distance": 5}])",
                         {"--layers", "airlight,light3,light0,light1,light2,airlight_error"});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto all = layer("airlight", "G"), error = layer("airlight_error", "G"), lamp = layer("light0", "G"),
               dark = layer("light1", "G"), spot = layer("light2", "G"), sun = layer("light3", "G");
    double lit_by_spot = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(all[i], lamp[i] + spot[i] + sun[i], 2e-3 * all[i]);
        EXPECT_EQ(dark[i], 0);
        EXPECT_GT(lamp[i], 0);
        EXPECT_GT(sun[i], 0);
        EXPECT_GE(error[i], 0);
        lit_by_spot += spot[i] > 0;
    }
    EXPECT_GT(lit_by_spot, 10);
    EXPECT_LT(lit_by_spot, double(all.size()) - 10);
}

/// Mean of the airlight over the columns from `first` to `last`.
double mean(const std::vector<double> &layer, int first, int last)
{
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = first; x < last; ++x)
            sum += layer[std::size_t(y * kWidth + x)];
    return sum / (kHeight * (last - first));
}

TEST_F(Airlight, OfAnEnvironmentImageComesFromWhereTheImageShinesIt)
{
    const auto sky = [&](const Value &red) {
        write_exr(folder_ / "sky.exr", {{{{"R", Imf::FLOAT, red}, {"G", Imf::FLOAT, constant(1)}, {"B", Imf::FLOAT}}}});
    };
    // A patch at a fraction of the width, half way down.
    const auto patch = [&](double u) {
        sky([=](int x, int y) { return std::abs(x + 0.5 - u * kWidth) <= 2 && (y == 11 || y == 12) ? 10.0 : 0.0; });
    };
    const auto airlight = [&](const std::string &up, const std::string &channel = "R") {
        const Result r = run(R"("medium": {"scattering": 0.05, "g": 0.8}, "effects": {"airlight": {}}, "environment":
                                {"file": "sky.exr", "up": ")" +
                                 up + "\"}",
                             {"--layers", "airlight"});
        EXPECT_EQ(r.status, 0) << r.err;
        return layer("airlight", channel);
    };
    // The fog scatters forwards, so it is brightest where the camera looks at the light.
    patch(0.5);
    const double ahead = mean(airlight("y"), 12, 20);
    patch(0.05);
    const double behind = mean(airlight("y"), 12, 20);
    EXPECT_GT(ahead, 3 * behind);
    patch(0.6);
    const auto right = airlight("y");
    EXPECT_GT(mean(right, 16, 32), 1.1 * mean(right, 0, 16));
    patch(0.4);
    const auto left = airlight("y");
    EXPECT_GT(mean(left, 0, 16), 1.1 * mean(left, 16, 32));
    // Below with y up; with z up the camera looks at it.
    sky([](int, int y) { return y > 20 ? 10.0 : 0.0; });
    const double below = mean(airlight("y"), 12, 20);
    EXPECT_GT(mean(airlight("z"), 12, 20), 3 * below);

    const auto from_image = airlight("y", "G");
    const Result r = run(R"("medium": {"scattering": 0.05, "g": 0.8}, "effects": {"airlight": {}}, "environment":
                            {"sh": [[0, 3.5449077, 0]]})",
                         {"--layers", "airlight"});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto from_text = layer("airlight", "G");
    for (std::size_t i = 0; i < from_text.size(); ++i)
        EXPECT_NEAR(from_image[i], from_text[i], 2e-3 * from_text[i]);
}

void write_puff(const fs::path &path, double amplitude)
{
    write_text(path, "x,y,z,scale,amplitude\n0,0,-5,0.8," + std::to_string(amplitude) + "\n");
}

TEST_F(Airlight, GaussiansAreReadByFrame)
{
    fs::copy_file(in_, folder_ / "in.0001.exr");
    fs::copy_file(in_, folder_ / "in.0002.exr");
    in_ = folder_ / "in.####.exr";
    out_ = folder_ / "out.####.exr";
    write_puff(folder_ / "puff.0001.csv", 0.5);
    write_puff(folder_ / "puff.0002.csv", 1.5);
    const std::string scene = R"("medium": {"absorption": 0.4, "density": [{"type": "gaussians", "file": "puff.%04d.csv",
                                 "amplitude": 2}]})";
    const Result r = run(scene, {"--layers", "transmittance"});
    ASSERT_EQ(r.status, 0) << r.err;
    const Vector w = direction(kWidth / 2, kHeight / 2);
    for (const auto &[frame, amplitude] : {std::pair{"out.0001.exr", 1.0}, {"out.0002.exr", 3.0}}) {
        const double depth = integrate([&](double t) {
            return 0.4 * amplitude * std::exp(-0.64 * (t * t * (w[0] * w[0] + w[1] * w[1]) + std::pow(t * w[2] + 5, 2)));
        });
        const auto transmittance = read_plane(folder_ / frame, "brume.transmittance.R");
        EXPECT_NEAR(transmittance[kHeight / 2 * kWidth + kWidth / 2], std::exp(-depth), 1e-3) << frame;
        EXPECT_GT(transmittance[0], transmittance[kHeight / 2 * kWidth + kWidth / 2]);
    }

    fs::remove(folder_ / "puff.0002.csv");
    const Result missing = run(scene, {"--keep-going"});
    EXPECT_EQ(missing.status, 1);
    EXPECT_NE(missing.err.find("Gaussians of frame 2: " + (folder_ / "puff.0002.csv").string()), std::string::npos)
        << missing.err;
    EXPECT_TRUE(fs::exists(folder_ / "out.0001.exr"));
}

TEST_F(Airlight, MissingPosesAreNamed)
{
    write_text(scene_, R"({"brume":1, "medium": {"scattering": 0.05},
                           "lights": [{"type": "point", "position": [1, 2, -6], "intensity": 30}]})");
    const Result r = brume({"run", scene_.string(), in_.string(), "-o", out_.string(), "--backend", "cpu", "--vfov", "50"});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("no camera pose"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("lights"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace brume::tests
