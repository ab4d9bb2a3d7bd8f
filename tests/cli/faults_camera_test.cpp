#include <cmath>

#include <ImfFloatAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

/// Absorbing fog gives exp(-sigma distance) exactly, so a corner tells which field of view was used.
class CameraUsed : public testing::Test {
protected:
    CameraUsed() { write_text(scene_, kAbsorbing); }

    static inline const std::string kAbsorbing = R"({"brume":1,"medium":{"scattering":0,"absorption":0.1}})";
    static std::string with_camera(const std::string &block)
    {
        return R"({"brume":1,"camera":)" + block + R"(,"medium":{"scattering":0,"absorption":0.1}})";
    }
    static TestPart picture()
    {
        TestPart part{rgb("", Imf::FLOAT)};
        part.channels.push_back({"Z", Imf::FLOAT, constant(4)});
        return part;
    }
    /// Length of the top left pixel's ray over its depth, by what the fog absorbed.
    double stretch(std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run",         scene_.string(), in_.string(), "-o",
                                       out_.string(), "--backend",     "cpu",        "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const Result r = brume(words);
        EXPECT_EQ(r.status, 0) << r.err;
        return -std::log(read_plane(out_, "R")[0] / read_plane(in_, "R")[0]) / 0.4;
    }
    static double expected(double vertical_degrees, double aspect = 1, double center_x = 0.5, double center_y = 0.5)
    {
        const double pixel = 2 * std::tan(vertical_degrees * M_PI / 360) / kHeight;
        const double x = (0.5 - center_x * kWidth) * pixel * aspect, y = (0.5 - center_y * kHeight) * pixel;
        return std::sqrt(1 + x * x + y * y);
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json", in_ = folder_ / "in.exr", out_ = folder_ / "out.exr",
                   camera_ = folder_ / "camera.json";
};

TEST_F(CameraUsed, PixelsHaveTheHeadersAspectWhereNobodySaysAnother)
{
    TestPart part = picture();
    part.edit = [](Imf::Header &h) { h.pixelAspectRatio() = 2; };
    write_exr(in_, {part});
    EXPECT_NEAR(stretch({"--vfov", "60"}), expected(60, 2), 1e-4);
    write_text(camera_, R"({"vertical_fov":60})");
    EXPECT_NEAR(stretch({"--camera", camera_.string()}), expected(60, 2), 1e-4);
    write_text(scene_, with_camera(R"({"vertical_fov":60})"));
    EXPECT_NEAR(stretch(), expected(60, 2), 1e-4);
    write_text(scene_, with_camera(R"({"vertical_fov":60,"pixel_aspect":1.5})"));
    EXPECT_NEAR(stretch(), expected(60, 1.5), 1e-4);
    const double wide = 2 * std::atan(std::tan(M_PI / 6) * kHeight / (kWidth * 2.0)) * 180 / M_PI;
    write_text(scene_, with_camera(R"({"horizontal_fov":60})"));
    EXPECT_NEAR(stretch(), expected(wide, 2), 1e-4);
}

TEST_F(CameraUsed, ACameraFilesCentreAndAspectCountAndItsKeysAreChecked)
{
    write_exr(in_, {picture()});
    write_text(camera_, R"({"vertical_fov":60,"pixel_aspect":2,"center":[0.25,0.75]})");
    EXPECT_NEAR(stretch({"--camera", camera_.string()}), expected(60, 2, 0.25, 0.75), 1e-4);
    write_text(camera_, R"({"vertical_fov":60,"pixel_aspct":2})");
    const Result r = brume({"run", scene_.string(), in_.string(), "-o", out_.string(), "--camera", camera_.string()});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("pixel_aspct"), std::string::npos) << r.err;
}

TEST_F(CameraUsed, AnotherFieldOfViewKeepsTheScenesCentreAndAspect)
{
    write_exr(in_, {picture()});
    write_text(scene_, with_camera(R"({"vertical_fov":30,"pixel_aspect":2,"center":[0.25,0.75]})"));
    EXPECT_NEAR(stretch({"--vfov", "60"}), expected(60, 2, 0.25, 0.75), 1e-4);
}

TEST_F(CameraUsed, KeyedCamerasGoOn)
{
    write_exr(folder_ / "k.0003.exr", {picture()});
    write_text(scene_, with_camera(R"({"vertical_fov":{"keys":[[1,30],[5,90]]}})"));
    const Result r =
        brume({"run", scene_.string(), (folder_ / "k.0003.exr").string(), "-o", out_.string(), "--backend", "cpu"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NEAR(-std::log(read_plane(out_, "R")[0] / read_plane(folder_ / "k.0003.exr", "R")[0]) / 0.4, expected(60), 1e-4);
}

TEST_F(CameraUsed, APatternOfCamerasGoesWithTheFrames)
{
    for (int f : {1, 2}) {
        write_exr(folder_ / ("p.000" + std::to_string(f) + ".exr"), {picture()});
        write_text(folder_ / ("c.000" + std::to_string(f) + ".json"), R"({"vertical_fov":)" + std::to_string(30 * f) + "}");
    }
    const Result r =
        brume({"run", scene_.string(), (folder_ / "p.####.exr").string(), "-o", (folder_ / "o.####.exr").string(),
               "--camera", (folder_ / "c.####.json").string(), "--backend", "cpu"});
    ASSERT_EQ(r.status, 0) << r.err;
    for (int f : {1, 2})
        EXPECT_NEAR(-std::log(read_plane(folder_ / ("o.000" + std::to_string(f) + ".exr"), "R")[0] / 0.25) / 0.4,
                    expected(30 * f), 1e-4);
}

TEST_F(CameraUsed, AbsurdMetadataIsRefusedBeforeTheFirstFrameAndTakenByName)
{
    TestPart part = picture();
    part.edit = [](Imf::Header &h) { h.insert("cameraFov", Imf::FloatAttribute(176)); };
    write_exr(in_, {part});
    const Result info = brume({"info", in_.string()});
    EXPECT_EQ(info.status, 0);
    EXPECT_NE(info.out.find("expected 1 to 170"), std::string::npos) << info.out;
    for (const char *command : {"plan", "run"}) {
        std::vector<std::string> words{command, scene_.string(), in_.string(), "--backend", "cpu"};
        if (words[0] == "run")
            words.insert(words.end(), {"-o", out_.string()});
        const Result r = brume(words);
        EXPECT_EQ(r.status, 2);
        EXPECT_NE(r.err.find("expected 1 to 170"), std::string::npos) << r.err;
    }
    EXPECT_FALSE(fs::exists(out_));
    const double vertical = 2 * std::atan(std::tan(88 * M_PI / 180) * kHeight / kWidth) * 180 / M_PI;
    EXPECT_NEAR(stretch({"--camera", in_.string()}) / expected(vertical), 1, 1e-3);
}

TEST_F(CameraUsed, APoseThatNothingNeedsStopsNothing)
{
    TestPart part = picture();
    part.edit = [](Imf::Header &h) {
        Imath::M44f sheared;
        sheared[0][1] = 0.5f;
        Imf::addWorldToCamera(h, sheared);
    };
    write_exr(in_, {part});
    EXPECT_NEAR(stretch({"--vfov", "60"}), expected(60), 1e-4);
    write_text(scene_, R"({"brume":1,"medium":{"absorption":0.1,"density":[{"type":"exponential","falloff":0.1}]}})");
    const Result r = brume({"plan", scene_.string(), in_.string(), "--vfov", "60", "--backend", "cpu"});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("worldToCamera gives no pose"), std::string::npos) << "why there is none: " << r.err;
}

TEST_F(CameraUsed, InfoShowsTheCameraThatRunUses)
{
    TestPart left = picture(), right = picture();
    left.name = "rgba.left", left.view = "left";
    right.name = "rgba.right", right.view = "right";
    left.edit = [](Imf::Header &h) { h.insert("cameraFov", Imf::FloatAttribute(20)); };
    TestPart matte{{{"matte.Y"}}};
    matte.name = "matte.right", matte.view = "right";
    matte.edit = [](Imf::Header &h) { h.insert("cameraFov", Imf::FloatAttribute(90)); };
    write_exr(in_, {left, right, matte});
    const json info = json::parse(brume({"info", in_.string(), "--view", "right", "--json"}).out);
    const double vertical = 2 * std::atan(24.0 / 32) * 180 / M_PI;
    EXPECT_NEAR(info["camera"]["vertical_fov"].get<double>(), vertical, 1e-4) << "of another part of that view: " << info;
    EXPECT_NE(info["camera"]["fov_from"].get<std::string>().find("matte.right"), std::string::npos);
    const Result r =
        brume({"run", scene_.string(), in_.string(), "-o", out_.string(), "--view", "right", "--backend", "cpu"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_NEAR(-std::log(read_plane(out_, "R", 1)[0] / 0.25) / 0.4, expected(vertical), 1e-4);
    EXPECT_NE(r.err.find("'left' stays without fog"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace brume::tests
