#include <algorithm>
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

const fs::path kShared = BRUME_SHARED_DIR;

class Shared : public testing::Test {
protected:
    void SetUp() override
    {
        if (kShared.empty() || !fs::exists(kShared / "images"))
            GTEST_SKIP() << "no shared images here";
        write_text(folder_ / "fog.json", kFog);
    }
    Result run(const fs::path &input, const std::vector<std::string> &more = {}) const
    {
        std::vector<std::string> words{"run",          (folder_ / "fog.json").string(),
                                       input.string(), "-o",
                                       out().string(), "--vfov",
                                       "40",           "--backend",
                                       "cpu",          "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words, 30);
    }
    fs::path out() const { return folder_ / "out.exr"; }
    static json info(const std::string &image)
    {
        return json::parse(brume({"info", (kShared / "images" / image).string(), "--json"}).out);
    }

    Folder folder_;
};

TEST_F(Shared, LayersOfRealFilesAreFound)
{
    const std::vector<std::array<std::string, 3>> expected{
        {"beachball/singlepart.0001.exr", "R,G,B,A (view right)", "Z"},
        {"beachball/multipart.0001.exr", "R,G,B,A (view right)", "Z"},
        {"naming/channelTestSinglePart.exr", "R,G,B,A", "Z"},
        {"naming/channelTestNukeSinglePart.exr", "R,G,B,A", "depth.Z"},
        {"naming/channelTestMultiViewNukeSinglePart.exr", "R,G,B,A (view right)", "depth.Z"},
        {"naming/channelTestMultiViewPartPerLayer.exr", "R,G,B,A (view left)", "Z"},
        {"naming/channelTestMultiViewSinglePart.exr", "R,G,B,A (view left)", "Z"},
        {"naming/multipartDefaultChannels.exr", "R,G,B", "Z"},
        {"naming/mixed_none.exr", "R,G,B", "Z"}};
    for (const auto &[file, color, depth] : expected) {
        const json i = info(file);
        EXPECT_EQ(i["color"]["channels"], color) << file;
        EXPECT_EQ(i["depth"]["channel"], depth) << file;
    }
    EXPECT_EQ(info("beachball/multipart.0001.exr")["depth"]["part"], "part 5 (depth_right)");
    EXPECT_NEAR(info("naming/channelTestMultiViewNukeSinglePart.exr")["depth"]["farthest"].get<double>(), 0.1, 1e-3)
        << ".5 is the wrong layer";
}

TEST_F(Shared, RealPicturesComeThrough)
{
    for (const auto &entry : fs::recursive_directory_iterator(kShared / "images")) {
        const fs::path &file = entry.path();
        if (file.extension() != ".exr" || file.string().find("/malformed/") != std::string::npos)
            continue;
        const json i = json::parse(brume({"info", file.string(), "--json"}).out);
        const bool has_depth = i["depth"].contains("channel");
        const Result r = run(file);
        EXPECT_EQ(r.status, has_depth ? 0 : 2) << file << ' ' << r.err;
        if (!has_depth) {
            EXPECT_NE(r.err.find("no depth"), std::string::npos) << r.err;
        }
        fs::remove(out());
    }
    EXPECT_EQ(run(kShared / "images/no_depth/cornellBox_CryptoWildcard.0001.exr", {"--depth", "R"}).status, 0)
        << "cryptomatte kept beside it";
    EXPECT_EQ(run(kShared / "images/environment/OrientationLatLong.exr", {"--depth", "R"}).status, 0)
        << "tiled, with mipmaps";
    EXPECT_EQ(run(kShared / "images/sensor_depth/real_000000080-opaque-depth-img.exr", {"--depth", "R"}).status, 0)
        << "NaN depth";
}

TEST_F(Shared, DamagedFilesNeitherCrashNorHang)
{
    std::vector<fs::path> files;
    for (const auto &entry : fs::recursive_directory_iterator(kShared / "images/malformed"))
        if (entry.is_regular_file() && entry.path().extension() != ".rst")
            files.push_back(entry.path());
    ASSERT_GT(files.size(), 100u);
    for (const fs::path &file : files) {
        const Result r = run(file);
        EXPECT_TRUE(r.status >= 0 && r.status <= 2) << file << " ends with " << r.status << ' ' << r.err;
        if (r.status == 0) {
            EXPECT_TRUE(fs::exists(out())) << file;
            fs::remove(out());
        } else {
            EXPECT_NE(r.err.find(file.filename().string()), std::string::npos) << "the message names the file: " << r.err;
            EXPECT_FALSE(fs::exists(out())) << file;
        }
    }
    std::size_t left = 0;
    for ([[maybe_unused]] const auto &entry : fs::directory_iterator(folder_.path()))
        ++left;
    EXPECT_EQ(left, 1u) << "only the scene file";
}

/// Small inputs with the properties of files that went wrong.
class SharedCases : public testing::Test {
protected:
    void SetUp() override
    {
        if (kShared.empty() || !fs::exists(kShared / "cases"))
            GTEST_SKIP() << "no shared cases here";
        write_text(scene_, R"({"brume":1,"medium":{"scattering":0,"absorption":0.1}})");
    }
    void TearDown() override { ::unsetenv("OCIO"); }
    static std::string file(const std::string &name) { return (kShared / "cases" / name).string(); }
    Result run(const std::string &name, const std::vector<std::string> &more = {}) const
    {
        std::vector<std::string> words{"run", scene_.string(), file(name), "-o", out_.string(), "--backend", "cpu"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    static json info(const std::string &name, const std::vector<std::string> &more = {})
    {
        std::vector<std::string> words{"info", file(name), "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return json::parse(brume(words).out);
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json", out_ = folder_ / "out.exr";
};

TEST_F(SharedCases, CamerasOfOtherRenderers)
{
    EXPECT_NEAR(info("mantra.exr")["camera"]["vertical_fov"].get<double>(), 26.23, 0.01);
    EXPECT_EQ(run("mantra.exr").status, 0);
    EXPECT_EQ(run("mantra.exr", {"--vfov", "40"}).status, 0);
    for (const char *name : {"pbrt_identity.exr", "pbrt_translated.exr"}) {
        EXPECT_NEAR(info(name)["camera"]["vertical_fov"].get<double>(), 45, 0.01);
        EXPECT_EQ(run(name).status, 0) << name;
    }
    EXPECT_NEAR(info("stereo_cameras.exr", {"--view", "left"})["camera"]["vertical_fov"].get<double>(), 40, 0.01);
    EXPECT_NEAR(info("stereo_cameras.exr", {"--view", "right"})["camera"]["vertical_fov"].get<double>(), 90, 0.01);
}

TEST_F(SharedCases, AnamorphicPixelsCountWithTheScenesCameraAsWithTheOption)
{
    ASSERT_EQ(run("anamorphic.exr", {"--vfov", "50"}).status, 0);
    const auto by_option = read_plane(out_, "R");
    write_text(scene_, R"({"brume":1,"camera":{"vertical_fov":50},"medium":{"scattering":0,"absorption":0.1}})");
    ASSERT_EQ(run("anamorphic.exr").status, 0);
    EXPECT_EQ(read_plane(out_, "R"), by_option);
}

TEST_F(SharedCases, DepthOfHalfTheSizeIsRefused)
{
    const Result r = run("beauty.0001.exr", {"--vfov", "50", "--depth", file("half_depth.####.exr") + ":Z"});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("16 x 8"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("32 x 16"), std::string::npos) << r.err;
}

TEST_F(SharedCases, BrokenConfigsStopOnlyWhatNeedsThem)
{
    for (const char *config : {"nosl.ocio", "nolut.ocio"}) {
        ::setenv("OCIO", file(config).c_str(), 1);
        EXPECT_EQ(run("anamorphic.exr", {"--vfov", "50"}).status, 0) << config;
        const Result r = run("anamorphic.exr", {"--vfov", "50", "--preview", (folder_ / "p.png").string()});
        EXPECT_EQ(r.status, 2) << config;
        EXPECT_NE(r.err.find(config), std::string::npos) << r.err;
    }
}

TEST_F(SharedCases, ClaimsOfTheOldSpaceGo)
{
    ASSERT_EQ(run("aces_claims.exr", {"--vfov", "50", "--input-space", "ACES2065-1", "--output-space", "ACEScg"}).status, 0);
    for (const char *name : {"acesImageContainerFlag", "adoptedNeutral", "colorInteropID", "oiio:ColorSpace"})
        EXPECT_EQ(read_text(out_).find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace brume::tests
