// `brume media`: each command on files, what it keeps in the journal, and what it refuses.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class MediaTool : public testing::Test {
protected:
    /// `media` and the words; the test fails where the tool does.
    std::string media(std::vector<std::string> words)
    {
        words.insert(words.begin(), "media");
        const Result result = brume(words);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out;
    }
    void refused(std::vector<std::string> words, const std::string &part)
    {
        words.insert(words.begin(), "media");
        const Result result = brume(words);
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }
    json info(const fs::path &file) { return json::parse(media({"info", file.string(), "--json"})); }
    /// Two rows of five along x, at z = -4 and -8.
    void write_rows()
    {
        std::string text = "x,y,z,scale,amplitude\n";
        for (int row = 1; row <= 2; ++row)
            for (int x = -2; x <= 2; ++x)
                text += std::to_string(x) + ",0," + std::to_string(-4 * row) + ",2,1\n";
        write_text(fog_, text);
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.csv", journal_ = folder_ / "fog.csv.journal", camera_ = folder_ / "camera.json";
    const std::string f_ = fog_.string();
    const std::vector<std::string> screen_{"--size", "64x48", "--camera", camera_.string()};

    void SetUp() override
    {
        // At depth d the picture is 1.5 d wide and d high.
        write_text(camera_, R"({"vertical_fov": 53.13010235415598,
            "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})");
    }
    std::vector<std::string> with_screen(std::vector<std::string> words) const
    {
        words.insert(words.end(), screen_.begin(), screen_.end());
        return words;
    }
};

TEST_F(MediaTool, PaintsErasesUndoesRedoes)
{
    media({"paint", f_, "--stroke", "0,0,0 6,0,0", "--radius", "0.5", "--amplitude", "0.3", "--seed", "4"});
    EXPECT_EQ(info(fog_)["gaussians"], 17);
    EXPECT_EQ(info(fog_)["undo"], 1);
    const std::string painted = read_text(fog_);
    media({"paint", f_, "--stroke=0,1,0 6,1,0", "--scale", "2", "--colour", "1,.5,0", "--spacing", "1", "--jitter", "0"});
    EXPECT_EQ(info(fog_)["gaussians"], 24);
    media({"erase", f_, "--stroke", "6,1,0", "--radius", "0.4"});
    EXPECT_EQ(info(fog_)["gaussians"], 23);
    const std::string erased = read_text(fog_);
    media({"undo", f_});
    media({"undo", f_});
    EXPECT_EQ(read_text(fog_), painted);
    EXPECT_EQ(info(fog_)["redo"], 2);
    media({"redo", f_});
    media({"redo", f_});
    EXPECT_EQ(read_text(fog_), erased);
    refused({"redo", f_}, "nothing to redo");
    for (int i = 0; i < 3; ++i)
        media({"undo", f_});
    EXPECT_EQ(info(fog_)["gaussians"], 0);
    refused({"undo", f_}, "nothing to undo");
    // The journal alone makes the file again.
    media({"redo", f_});
    media({"replay", journal_.string(), "-o", (folder_ / "again.csv").string()});
    EXPECT_EQ(read_text(folder_ / "again.csv"), painted);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 4) << "fog, journal, camera, again";
}

TEST_F(MediaTool, ScreenStrokesFallOnPlanes)
{
    // 12 px below the middle is a slope of 1/4: 8 before a camera 2 above the plane.
    media(with_screen(
        {"paint", f_, "--screen-stroke", "32,36", "--plane", "0,1,0", "--plane-point", "0,-2,0", "--jitter", "0"}));
    const json centers = info(fog_)["centers"];
    EXPECT_NEAR(centers[0][0], 0, 1e-5);
    EXPECT_NEAR(centers[1][0], -2, 1e-5);
    EXPECT_NEAR(centers[2][0], -8, 1e-5);
    refused(with_screen({"paint", f_, "--screen-stroke", "32,12", "--plane", "0,1,0", "--plane-point", "0,-2,0"}),
            "expected a pixel whose ray meets the plane");
    refused(with_screen({"paint", f_, "--screen-stroke", "32,36"}), "expected a plane");
    refused({"paint", f_, "--screen-stroke", "32,36", "--plane", "0,1,0"}, "expected --frame, or --camera with --size");
}

TEST_F(MediaTool, EmitsOneFileOrMany)
{
    media({"emit", f_, "--time", "4", "--rate", "20", "--lifetime", "2", "--velocity", "0,0,1.5", "--acceleration",
           "0,0,-.1", "--scale", "4,1", "--amplitude", "1,0"});
    EXPECT_NEAR(info(fog_)["gaussians"].get<double>(), 40, 1);
    EXPECT_LT(info(fog_)["centers"][2][1].get<double>(), 2.81);
    const std::string pattern = (folder_ / "puffs.####.ply").string();
    media({"emit", pattern, "--frames", "5-7", "--fps", "2", "--time", "0.25", "--rate", "100", "--lifetime", "9"});
    const int counts[] = {25, 75, 125};
    for (int i = 0; i < 3; ++i) {
        const fs::path frame = folder_ / ("puffs.000" + std::to_string(5 + i) + ".ply");
        EXPECT_NEAR(info(frame)["gaussians"].get<double>(), counts[i], 1);
        EXPECT_FALSE(info(frame).contains("undo"));
    }
    refused({"emit", pattern, "--time", "1"}, "expected --frames with a pattern");
    refused({"emit", f_, "--time", "1", "--frames", "1-3"}, "expected --frames with a pattern");
    refused({"emit", f_, "--time", "1", "--rate", "-1"}, "emit.rate: -1");
    refused({"emit", f_, "--time", "1", "--scale", "1,2,3"}, "--scale '1,2,3': expected 2 numbers");
}

TEST_F(MediaTool, AirbrushStaysInFront)
{
    // RGB and a wall at depth 5; the camera is in the scene file.
    auto channels = rgbz();
    channels.back().value = constant(5);
    const fs::path frame = folder_ / "frame.exr", depth_only = folder_ / "depth.exr";
    write_exr(frame, {{channels}});
    write_exr(depth_only, {{{channels.back()}}});
    const std::vector<std::string> brush{"--position",  "0,0,-3", "--velocity", "0,0,-3", "--duration", "2",
                                         "--rate",      "60",     "--drag",     "0.2",    "--spread",   ".4",
                                         "--diffusion", "0.05",   "--radius",   "0.3"};
    for (const fs::path &seen : {frame, depth_only}) {
        std::vector<std::string> words{"airbrush", f_, "--frame", seen.string(), "--camera", camera_.string()};
        words.insert(words.end(), brush.begin(), brush.end());
        media(words);
        const json in_front = info(fog_);
        EXPECT_EQ(in_front["gaussians"], 120);
        EXPECT_GE(in_front["centers"][2][0].get<double>(), -5.0001);
        EXPECT_LT(in_front["centers"][2][0].get<double>(), -4);
        media({"undo", f_});
    }
    std::vector<std::string> words{"airbrush", f_};
    words.insert(words.end(), brush.begin(), brush.end());
    media(words);
    EXPECT_LT(info(fog_)["centers"][2][0].get<double>(), -5.5);
    refused({"airbrush", f_, "--frame", frame.string()}, "no field of view");
    refused({"airbrush", f_, "--frame", frame.string(), "--camera", camera_.string(), "--position", "0,0,-6"},
            "expected a place before");
    write_exr(depth_only, {{rgb()}});
    refused({"airbrush", f_, "--frame", depth_only.string(), "--camera", camera_.string()}, "depth");
}

TEST_F(MediaTool, SelectsMovesCopiesDeletes)
{
    write_rows();
    // A pixel is 1/12 at depth 4 and 1/6 at depth 8: the right half, of what is in the picture.
    EXPECT_EQ(media(with_screen({"select", f_, "--rect", "33,0,64,48"})), "selected 4 of 10 Gaussians\n");
    EXPECT_FALSE(fs::exists(journal_));
    const fs::path part = folder_ / "part.ply";
    media(with_screen({"select", f_, "--rect", "33,0,64,48", "-o", part.string()}));
    EXPECT_EQ(info(part)["gaussians"], 4);
    EXPECT_EQ(info(part)["centers"][0][0], 1);

    const std::string before = read_text(fog_);
    media(with_screen({"move", f_, "--rect", "33,0,64,48", "--by", "0,-1.5,0"}));
    EXPECT_EQ(info(fog_)["centers"][1][0], -1.5);
    EXPECT_EQ(media({"copy", f_, "--all", "--by", "-10,0,0"}), "pasted 10 of 20 Gaussians\n");
    EXPECT_EQ(info(fog_)["centers"][0][0], -12);
    EXPECT_EQ(media(with_screen({"delete", f_, "--rect", "0,0,64,25"})), "deleted 6 of 20 Gaussians\n");
    EXPECT_EQ(info(fog_)["gaussians"], 14);
    // A step back for each command.
    for (int i = 0; i < 3; ++i)
        media({"undo", f_});
    media({"convert", f_, (folder_ / "back.csv").string()});
    write_rows();
    media({"convert", f_, (folder_ / "rows.csv").string()});
    EXPECT_EQ(read_text(folder_ / "back.csv"), read_text(folder_ / "rows.csv"));

    refused({"move", f_, "--by", "0,0,1"}, "expected --rect or --all");
    refused({"move", f_, "--all"}, "--by is required");
    refused({"move", f_, "--all", "--by", "0,0"}, "--by '0,0': expected 3 numbers");
    refused({"delete", f_, "--rect", "0,0,1,1"}, "expected --frame, or --camera with --size");
    refused({"delete", f_, "--rect", "0,0,1,1", "--size", "64"}, "--size '64': expected WIDTHxHEIGHT");
    refused({"delete", f_, "--rect", "0,0,1,1", "--size", "64x48"}, "no field of view");
}

TEST_F(MediaTool, AddsConvertsAndTells)
{
    write_text(fog_, "x,y,z,radius,density,r,g,b\n1,2,3,2,.5,1,1,0\n");
    const fs::path ply = folder_ / "fog.ply";
    media({"convert", f_, ply.string()});
    const json told = info(ply);
    EXPECT_EQ(told["gaussians"], 1);
    EXPECT_EQ(told["radius"][0], 2);
    EXPECT_NEAR(told["mass"].get<double>(), 0.5 * 8 * std::pow(3.14159265358979, 1.5), 1e-9);
    media({"add", ply.string(), f_});
    EXPECT_EQ(info(ply)["gaussians"], 2);
    EXPECT_NE(media({"info", ply.string()}).find("2 Gaussians"), std::string::npos);
    refused({"info", (folder_ / "none.csv").string()}, "none.csv: cannot be read");
    refused({"info", camera_.string()}, "\".json\"; expected .csv or .ply");
    write_text(fog_, "x,y,z,radius,density\n1,2,3,0,1\n");
    refused({"info", f_}, "fog.csv:2: radius: 0; expected");
}

TEST_F(MediaTool, NoticesFilesThatWereChanged)
{
    media({"paint", f_, "--stroke", "0,0,0 6,0,0"});
    const std::string journal = read_text(journal_);
    write_rows();
    const std::string changed = read_text(fog_);
    refused({"paint", f_, "--stroke", "0,0,0 6,0,0"}, "is not what");
    refused({"undo", f_}, "is not what");
    EXPECT_EQ(read_text(fog_), changed);
    EXPECT_EQ(read_text(journal_), journal);
    fs::remove(fog_);
    refused({"paint", f_, "--stroke", "0,0,0 6,0,0"}, "is not what");
    media({"replay", journal_.string(), "-o", f_});
    media({"paint", f_, "--stroke", "0,0,0 6,0,0"});
    // A journal that is no journal.
    write_text(journal_, "{}\n");
    refused({"undo", f_}, "fog.csv.journal:1:1: has no \"brume_journal\"");
    fs::remove(journal_);
    media({"paint", f_, "--stroke", "0,0,0 6,0,0"});
    EXPECT_EQ(info(fog_)["undo"], 2) << "what was there, and the stroke";
    // Nothing is written where nothing can be.
    refused({"paint", (folder_ / "none/fog.csv").string(), "--stroke", "0,0,0", "--scale", "0"}, "paint.scale: 0");
    EXPECT_EQ(brume({"media", "paint", (folder_ / "none/fog.csv").string(), "--stroke", "0,0,0"}).status, 1);
}

}  // namespace
}  // namespace brume::tests
