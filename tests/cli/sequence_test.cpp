#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>

#include "files.hpp"
#include "image/frame.hpp"

extern char **environ;

namespace brume::tests {
namespace {

using namespace brume::tool;
using nlohmann::json;

class Sequence : public testing::Test {
protected:
    Sequence() { write_text(scene_, kFog); }

    void make(int first, int last, int step = 1)
    {
        for (int f = first; f <= last; f += step) {
            TestPart part{rgbz()};
            part.data = {{f % 5, f % 3}, {f % 5 + 20, f % 3 + 15}};
            write_exr(input(f), {part});
        }
    }
    fs::path input(int f) const { return folder_ / (std::string("in.") + pad(f) + ".exr"); }
    fs::path output(int f) const { return folder_ / (std::string("out/o.") + pad(f) + ".exr"); }
    Result run(std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run",
                                       scene_.string(),
                                       (folder_ / "in.%04d.exr").string(),
                                       "-o",
                                       (folder_ / "out/o.####.exr").string(),
                                       "--vfov",
                                       "50",
                                       "--backend",
                                       "cpu"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    /// Everything in the output folder must be a whole picture.
    std::size_t whole_files() const
    {
        std::size_t count = 0;
        if (!fs::exists(folder_ / "out"))
            return 0;
        for (const auto &entry : fs::directory_iterator(folder_ / "out")) {
            EXPECT_EQ(entry.path().extension(), ".exr") << entry.path();
            EXPECT_NO_THROW(read_plane(entry.path(), "R")) << entry.path();
            ++count;
        }
        return count;
    }
    static std::string pad(int f)
    {
        const std::string digits = std::to_string(f);
        return std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits;
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json";
};

TEST_F(Sequence, DoesAllThatExistsWithMovingWindows)
{
    make(1, 6);
    const Result r = run({"--stats", (folder_ / "stats.json").string(), "--layers", "transmittance,optical_depth"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(whole_files(), 6u);
    EXPECT_EQ(read_header(output(4)).dataWindow(), read_header(input(4)).dataWindow());
    EXPECT_NO_THROW(read_plane(output(4), "brume.optical_depth.R"));
    const json stats = json::parse(read_text(folder_ / "stats.json"));
    EXPECT_EQ(stats["totals"]["done"], 6);
    ASSERT_EQ(stats["frames"].size(), 6u);
    EXPECT_EQ(stats["frames"][2]["frame"], 3);
    EXPECT_EQ(stats["frames"][2]["resolved"]["depth"], "Z: root Z");
    EXPECT_FALSE(stats["frames"][2]["passes"].empty());
    EXPECT_NE(r.err.find("[6/6]"), std::string::npos) << "plain lines where there is no terminal";
}

TEST_F(Sequence, TheNumberOfJobsChangesNoBit)
{
    make(1, 4);
    ASSERT_EQ(run({"--jobs", "1"}).status, 0);
    fs::rename(folder_ / "out", folder_ / "one");
    ASSERT_EQ(run({"--jobs", "4", "--mem", "64"}).status, 0);
    for (int f = 1; f <= 4; ++f)
        EXPECT_TRUE(read_text(output(f)) == read_text(folder_ / ("one/o." + pad(f) + ".exr"))) << f;
}

TEST_F(Sequence, SkipExistingResumes)
{
    make(1, 4);
    ASSERT_EQ(run({"--frames", "1-4x2"}).status, 0);
    const auto before = fs::last_write_time(output(1));
    const Result r = run({"--skip-existing"});
    EXPECT_EQ(r.status, 0);
    EXPECT_NE(r.err.find("2 done, 0 failed, 2 skipped"), std::string::npos) << r.err;
    EXPECT_EQ(fs::last_write_time(output(1)), before);
    EXPECT_EQ(whole_files(), 4u);
    EXPECT_EQ(run({"--skip-existing"}).status, 0) << "nothing left is not an error";
}

TEST_F(Sequence, FailedFramesAreListedAndTheStatusSaysSo)
{
    make(1, 5);
    fs::resize_file(input(3), fs::file_size(input(3)) / 2);
    const Result r = run({"--keep-going", "--frames", "1-6", "--stats", (folder_ / "stats.json").string()});
    EXPECT_EQ(r.status, 1);
    EXPECT_EQ(whole_files(), 4u);
    EXPECT_NE(r.err.find("failed: " + input(3).string()), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("failed: " + input(6).string()), std::string::npos) << "asked for by number, and missing";
    const json stats = json::parse(read_text(folder_ / "stats.json"));
    EXPECT_EQ(stats["totals"]["failed"], 2);
    EXPECT_EQ(stats["frames"][2]["outcome"], "failed");
}

TEST_F(Sequence, WithoutKeepGoingTheFirstFailureStops)
{
    make(1, 30);
    fs::resize_file(input(1), 100);
    const Result r = run({"--jobs", "1"});
    EXPECT_EQ(r.status, 1);
    EXPECT_EQ(whole_files(), 0u);
    EXPECT_NE(r.err.find("29 not tried"), std::string::npos) << r.err;
}

TEST_F(Sequence, InterruptedRunsLeaveOnlyWholeFilesAndResume)
{
    make(1, 60);
    const std::string scene = scene_.string(), in = (folder_ / "in.%04d.exr").string(),
                      out = (folder_ / "out/o.####.exr").string();
    std::vector<const char *> argv{BRUME_TOOL, "run", scene.c_str(), in.c_str(), "-o",      out.c_str(),
                                   "--vfov",   "50",  "--backend",   "cpu",      "--quiet", nullptr};
    for (const int signals : {1, 2}) {
        fs::remove_all(folder_ / "out");
        pid_t child = 0;
        ASSERT_EQ(::posix_spawn(&child, BRUME_TOOL, nullptr, nullptr, const_cast<char **>(argv.data()), environ), 0);
        // Once something is there, the run is under way.
        for (int i = 0; i < 5000 && !fs::exists(output(1)); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        for (int i = 0; i < signals; ++i)
            ::kill(child, i ? SIGTERM : SIGINT);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFEXITED(status));
        const std::size_t done = whole_files();
        EXPECT_EQ(WEXITSTATUS(status), done == 60 ? 0 : 1) << "0 where it was done before the signal came";
    }
    EXPECT_EQ(run({"--skip-existing", "--quiet"}).status, 0);
    EXPECT_EQ(whole_files(), 60u);
}

TEST_F(Sequence, OutputsMustNotFallOnInputs)
{
    make(1, 2);
    const std::string original = read_text(input(1));
    const auto refused = [&](const std::string &in, const std::string &out) {
        const Result r = brume({"run", scene_.string(), in, "-o", out, "--vfov", "50"});
        EXPECT_EQ(r.status, 2) << r.err;
        EXPECT_TRUE(read_text(input(1)) == original);
    };
    refused(input(1).string(), input(1).string());
    refused(input(1).string(), (folder_ / "./out/../in.0001.exr").string());
    refused(input(1).string(), (folder_ / "in.####.exr").string());
    fs::create_symlink(input(1), folder_ / "soft.exr");
    refused(input(1).string(), (folder_ / "soft.exr").string());
    fs::create_hard_link(input(1), folder_ / "hard.exr");
    refused(input(1).string(), (folder_ / "hard.exr").string());
    refused(input(1).string(), scene_.string());
    refused((folder_ / "in.%04d.exr").string(), (folder_ / "one.exr").string());
}

TEST_F(Sequence, PreviewsShowEveryFrameOrTheFirst)
{
    make(1, 3);
    ASSERT_EQ(run({"--preview", (folder_ / "p.%02d.png").string()}).status, 0);
    for (const char *name : {"p.01.png", "p.02.png", "p.03.png"})
        EXPECT_EQ(read_text(folder_ / name).substr(1, 3), "PNG");
    ASSERT_EQ(run({"--preview", (folder_ / "first.png").string()}).status, 0);
    EXPECT_TRUE(read_text(folder_ / "first.png") == read_text(folder_ / "p.01.png"));
}

TEST_F(Sequence, SheetsHoldEachFrameAboveItsFoggedOne)
{
    // A lamp of one pixel in the dark, and a pixel that is not finite.
    const auto lamp = [](int x, int y) { return x == 10 && y == 4 ? 512.0 : x == 3 && y == 3 ? NAN : 0.0; };
    const auto grey = [](int, int) { return 0.18; };
    for (int i = 1; i <= 3; ++i) {
        const auto name = [&](const char *kind) { return folder_ / (std::string(kind) + std::to_string(i) + ".exr"); };
        write_exr(name("lamp"), {{{{"R", Imf::FLOAT, lamp}, {"G", Imf::FLOAT, lamp}, {"B", Imf::FLOAT, lamp}}}});
        write_exr(name("grey"), {{{{"R", Imf::FLOAT, grey}, {"G", Imf::FLOAT, grey}, {"B", Imf::FLOAT, grey}}}});
    }
    const auto sheet = [&](const std::string &before, const std::string &after) {
        const Result r = brume({"sheet", (folder_ / before).string(), (folder_ / after).string(), "-o",
                                (folder_ / "sheet.png").string(), "--columns", "2", "--cell-width", "16"});
        EXPECT_EQ(r.status, 0) << r.err;
        const ImageFile file(folder_ / "sheet.png");
        return read_frame(file, resolve_color(file, {}), nullptr);
    };
    const Frame numbered = sheet("lamp%d.exr", "grey%d.exr");
    // Cells of 16 x 12 with 8 pixels around them, and a line of text below.
    ASSERT_EQ(numbered.width, 2 * (16 + 8) + 8);
    ASSERT_EQ(numbered.height, 2 * (12 + 8) + 8 + 22);
    const auto at = [](const Frame &f, int x, int y) { return f.pixels[3 * std::size_t(y * f.width + x)] * 255; };
    for (const int left : {8, 32}) {
        EXPECT_NEAR(at(numbered, left + 5, 8 + 2), 255, 1) << "the lamp is the mean of four pixels";
        EXPECT_LT(at(numbered, left + 1, 8 + 1), 10) << "what is not finite counts as its neighbours";
        EXPECT_LT(at(numbered, left + 9, 8 + 9), 10);
        const float shown = at(numbered, left + 1, 28 + 1);
        EXPECT_GT(shown, 60);
        EXPECT_EQ(at(numbered, left + 14, 28 + 10), shown);
    }
    EXPECT_NEAR(at(numbered, 2, 2), 24, 1);
    float brightest = 0;
    for (int y = 48; y < numbered.height; ++y)
        for (int x = 0; x < numbered.width; ++x)
            brightest = std::max(brightest, at(numbered, x, y));
    if (fs::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")) {
        EXPECT_GT(brightest, 100) << "there is no number";
    }
    const Frame alone = sheet("lamp1.exr", "grey1.exr");
    EXPECT_EQ(alone.width, 16 + 16);
    EXPECT_EQ(alone.height, 2 * (12 + 8) + 8);
}

}  // namespace
}  // namespace brume::tests
