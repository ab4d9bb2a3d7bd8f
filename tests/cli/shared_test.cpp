#include <algorithm>
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

}  // namespace
}  // namespace brume::tests
