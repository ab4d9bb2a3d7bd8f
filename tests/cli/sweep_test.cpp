#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class Sweep : public testing::Test {
protected:
    Sweep()
    {
        write_text(fog_, R"({"brume":1,"camera":{"vertical_fov":50},"medium":{"absorption":0.1},
                            "lights":[{"type":"directional","direction":[0,-1,0],"intensity":[1,2,4]}],
                            "effects":{"multiscatter":{}}})");
        write_exr(in_, {{rgbz()}});
    }
    Result sweep(std::vector<std::string> more) const
    {
        std::vector<std::string> words{"sweep",     fog_.string(), in_.string(),   "-o", (folder_ / "o.####.exr").string(),
                                       "--backend", "cpu",         "--depth-kind", "ray"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    static std::vector<json> lines(const std::string &text)
    {
        std::vector<json> all;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);)
            all.push_back(json::parse(line));
        return all;
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", in_ = folder_ / "in.exr";
};

// Where a layer says how much fog there is, the scene's cross-sections no longer do.
TEST_F(Sweep, LayersAreGivenByRole)
{
    TestPart part{rgbz()};
    part.channels.push_back({"tau", Imf::FLOAT, constant(0.7)});
    write_exr(in_, {part});
    const Result r = sweep({"--count", "2", "--vary", "medium.absorption=0.01:1:log", "--input", "optical_depth=tau"});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto before = read_plane(in_, "R");
    for (const json &line : lines(r.out)) {
        const auto after = read_plane(line.at("output").get<std::string>(), "R");
        for (std::size_t p = 0; p < before.size(); p += 41)
            EXPECT_NEAR(after[p], before[p] * std::exp(-0.7), 1e-3);
    }
}

TEST_F(Sweep, EachLineHasTheValuesThatMadeItsPicture)
{
    const Result r = sweep({"--count", "4", "--seed", "9", "--vary", "medium.absorption=0.01:1:log", "--transmittance",
                            (folder_ / "t.####.exr").string()});
    ASSERT_EQ(r.status, 0) << r.err;
    const auto all = lines(r.out);
    ASSERT_EQ(all.size(), 4u);
    const auto before = read_plane(in_, "R"), z = read_plane(in_, "Z");
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double absorption = all[i].at("medium.absorption");
        EXPECT_EQ(all[i].at("sample"), i + 1);
        EXPECT_EQ(all[i].at("seed"), 9);
        EXPECT_GE(absorption, 0.01);
        EXPECT_LE(absorption, 1);
        const auto after = read_plane(all[i].at("output").get<std::string>(), "R"),
                   t = read_plane(all[i].at("transmittance").get<std::string>(), "Y");
        for (std::size_t p = 0; p < z.size(); p += 41) {
            EXPECT_NEAR(t[p], std::exp(-absorption * z[p]), 1e-5);
            EXPECT_NEAR(after[p], before[p] * std::exp(-absorption * z[p]), 1e-3);
        }
    }
    const auto same = [&](std::size_t a, std::size_t b) {
        return all[a]["medium.absorption"] == all[b]["medium.absorption"];
    };
    EXPECT_FALSE(same(0, 1) || same(1, 2) || same(2, 3));
}

TEST_F(Sweep, ASampleIsTheSameInEveryRunWithTheSeed)
{
    const std::vector<std::string> vary{"--vary", "medium.absorption=0.1:1", "--vary", "lights.intensity=x0.5:2"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), vary.begin(), vary.end());
        const Result r = sweep(more);
        EXPECT_EQ(r.status, 0) << r.err;
        return lines(r.out);
    };
    const auto two = with({"--count", "2"});
    const std::string first = read_text(folder_ / "o.0002.exr");
    const auto three = with({"--count", "3"});
    EXPECT_EQ(two[1], three[1]);
    EXPECT_TRUE(first == read_text(folder_ / "o.0002.exr"));
    const auto other = with({"--count", "2", "--seed", "2"});
    EXPECT_NE(two[1]["medium.absorption"], other[1]["medium.absorption"]);
    const double share = (double(two[1]["medium.absorption"]) - 0.1) / 0.9,
                 other_share = (double(two[1]["lights.intensity"]) - 0.5) / 1.5;
    EXPECT_GT(std::abs(share - other_share), 1e-6) << "paths are drawn apart";
}

TEST_F(Sweep, TheDistanceKeepsItsRadianceWhereVisibilityIsDrawn)
{
    write_text(fog_, R"({"brume":1,"camera":{"vertical_fov":50},"medium":{"visibility":2,"emission":[0.6,0.9,1.2]}})");
    const Result r = sweep({"--count", "3", "--vary", "medium.visibility=0.2:1"});
    ASSERT_EQ(r.status, 0) << r.err;
    std::vector<double> farthest;
    for (const json &line : lines(r.out)) {
        EXPECT_NEAR(double(line.at("medium.emission")[1]), 0.9 * 2 / double(line.at("medium.visibility")), 1e-9);
        farthest.push_back(read_plane(line.at("output").get<std::string>(), "G").back());
    }
    EXPECT_NEAR(farthest[0], farthest[1], 1e-3 * farthest[0]);
    EXPECT_NEAR(farthest[0], farthest[2], 1e-3 * farthest[0]);
}

TEST_F(Sweep, WrongRequestsWriteNothing)
{
    const auto expect_refused = [&](std::vector<std::string> more, const std::string &said) {
        const Result r = sweep(more);
        EXPECT_EQ(r.status, 2) << r.err;
        EXPECT_NE(r.err.find(said), std::string::npos) << r.err << "\nlacks " << said;
        EXPECT_TRUE(r.out.empty());
        EXPECT_FALSE(fs::exists(folder_ / "o.0001.exr"));
    };
    expect_refused({"--count", "2", "--vary", "medium.absorption=1:0.1"}, "LOW <= HIGH");
    expect_refused({"--count", "2", "--vary", "medium.absorption=0:1:log"}, "LOW > 0");
    expect_refused({"--count", "2", "--vary", "medium.absorption"}, "PATH=LOW:HIGH");
    expect_refused({"--count", "2", "--vary", "fog.absorption=0:1"}, "the scene has no 'fog'");
    expect_refused({"--count", "2", "--vary", "medium.g=x0.5:1"}, "the scene has no 'medium.g'");
    expect_refused({"--count", "2", "--vary", "medium.absorbtion=0:1"}, "absorption");
    expect_refused({"--count", "2", "--vary", "medium.g=2:3"}, "sample 1");
    expect_refused({"--count", "2", "--vary", "medium.g=0:0.5", "--transmittance", (folder_ / "o.####.exr").string()},
                   "--transmittance");
}

}  // namespace
}  // namespace brume::tests
