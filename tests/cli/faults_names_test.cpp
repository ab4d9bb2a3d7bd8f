#include <cmath>
#include <thread>

#include <ImfStandardAttributes.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class Names : public testing::Test {
protected:
    Names()
    {
        write_text(scene_, kFog);
        write_exr(in_, {{rgbz()}});
    }
    Result run(const fs::path &in, const std::string &out, std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run", scene_.string(), in.string(), "-o", out, "--vfov", "50", "--backend", "cpu"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json", in_ = folder_ / "in.exr";
};

TEST_F(Names, FoldersAreTakenAsTheyAre)
{
    for (const char *name : {"user@host", "shot#2", "take%d", "v##_%04d@@"}) {
        fs::create_directory(folder_ / name);
        fs::copy_file(in_, folder_ / name / "a.0001.exr");
        const std::string out = (folder_ / (std::string(name) + ".out") / "o.####.exr").string();
        const Result r =
            run(folder_ / name / "a.####.exr", out, {"--depth", (folder_ / name / "a.####.exr").string() + ":Z"});
        EXPECT_EQ(r.status, 0) << r.err;
        EXPECT_TRUE(fs::exists(folder_ / (std::string(name) + ".out") / "o.0001.exr"));
    }
    EXPECT_EQ(run(in_, (folder_ / "plate@2x.exr").string()).status, 0);
    EXPECT_TRUE(fs::exists(folder_ / "plate@2x.exr"));
    const Result r = run(folder_ / "a.%V.####.exr", (folder_ / "o.####.exr").string());
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("%V stands for a view's name"), std::string::npos) << r.err;
}

TEST_F(Names, AViewsNameIsPutWhereItBelongs)
{
    write_text(scene_, R"({"brume":1,"medium":{"scattering":0,"absorption":0.1}})");
    for (const auto &[view, z] : {std::pair{"left", 3.0}, std::pair{"right", 5.0}}) {
        fs::create_directory(folder_ / view);
        write_exr(folder_ / view / (std::string("p.") + view + ".0001.exr"), {{rgb("", Imf::FLOAT)}});
        write_exr(folder_ / (std::string("z.") + view[0] + ".0001.exr"), {{{{"Z", Imf::FLOAT, constant(z)}}}});
    }
    const std::string in = (folder_ / "%V/p.%V.####.exr").string(), depth = (folder_ / "z.%v.####.exr").string() + ":Z";
    for (const auto &[view, z] : {std::pair{"left", 3.0}, std::pair{"right", 5.0}}) {
        const Result r =
            run(in, (folder_ / "out/%V.####.exr").string(), {"--view", view, "--depth", depth, "--depth-kind", "ray"});
        ASSERT_EQ(r.status, 0) << r.err;
        EXPECT_NEAR(read_plane(folder_ / "out" / (std::string(view) + ".0001.exr"), "R")[0], 0.25 * std::exp(-0.1 * z),
                    1e-4);
        EXPECT_EQ(brume({"info", in, "--view", view, "--depth", depth}).status, 0);
        EXPECT_EQ(brume({"plan", scene_.string(), in, "--view", view, "--depth", depth, "--vfov", "50"}).status, 0);
    }
    const Result r = run(in, (folder_ / "o.####.exr").string(), {"--depth", depth});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("expected --view"), std::string::npos) << r.err;
    // Of a file with both views the name of the output says which.
    TestPart both{rgbz()};
    for (auto &c : rgb("left."))
        both.channels.push_back(c);
    both.edit = [](Imf::Header &h) { Imf::addMultiView(h, {"right", "left"}); };
    write_exr(in_, {both});
    ASSERT_EQ(run(in_, (folder_ / "both.%V.exr").string(), {"--view", "left", "--depth", "Z"}).status, 0);
    EXPECT_EQ(read_plane(folder_ / "both.left.exr", "R"), read_plane(in_, "R"));
    EXPECT_NE(read_plane(folder_ / "both.left.exr", "left.R"), read_plane(in_, "left.R"));
    write_exr(folder_ / "100%Vol.exr", {{rgbz()}});
    EXPECT_EQ(run(folder_ / "100%Vol.exr", (folder_ / "o.exr").string()).status, 0);
}

TEST_F(Names, NamesMayBeAsLongAsTheyCanBe)
{
    for (const std::size_t length : {240u, 255u}) {
        const std::string name = std::string(length - 4, 'n') + ".exr";
        fs::copy_file(in_, folder_ / name);
        fs::create_directories(folder_ / "out");
        const Result r = run(folder_ / name, (folder_ / "out" / name).string(),
                             {"--stats", (folder_ / (std::string(length - 5, 's') + ".json")).string()});
        EXPECT_EQ(r.status, 0) << r.err;
        EXPECT_TRUE(fs::exists(folder_ / "out" / name));
    }
}

TEST_F(Names, AFolderIsNoOutput)
{
    for (const std::string &out : {(folder_ / "new/").string(), folder_.path().string()}) {
        const Result r = run(in_, out);
        EXPECT_EQ(r.status, 2);
        EXPECT_NE(r.err.find("is a folder"), std::string::npos) << r.err;
    }
}

TEST_F(Names, OutputsEndAsAFormatThatIsWritten)
{
    for (const char *name : {"out.gif", "out", ".tif", ".exr", "out.exr.bak"}) {
        const Result r = run(in_, (folder_ / name).string());
        EXPECT_EQ(r.status, 2) << name;
        EXPECT_NE(r.err.find("ends in one of .exr, .png"), std::string::npos) << r.err;
    }
    EXPECT_EQ(run(in_, (folder_ / "out.EXR").string()).status, 0);
    EXPECT_EQ(run(in_, (folder_ / "o.exr").string(), {"--preview", (folder_ / "p.jpg").string()}).status, 2);
}

TEST_F(Names, LoopsOfLinksAreAWrongRequestInWords)
{
    fs::create_symlink(folder_ / "b", folder_ / "a");
    fs::create_symlink(folder_ / "a", folder_ / "b");
    for (const Result &r : {run(folder_ / "a/x.exr", (folder_ / "o.exr").string()),
                            run(folder_ / "a/x.####.exr", (folder_ / "o.####.exr").string()),
                            run(folder_ / "a/x.####.exr", (folder_ / "o.####.exr").string(), {"--frames", "1-3"}),
                            run(in_, (folder_ / "a/o.exr").string()), run(in_, (folder_ / "a").string()),
                            run(in_, (folder_ / "o.exr").string(), {"--stats", (folder_ / "a/s.json").string()}),
                            run(in_, (folder_ / "o.exr").string(), {"--depth", (folder_ / "a/z.exr").string() + ":Z"})}) {
        EXPECT_EQ(r.status, 2) << r.err;
        EXPECT_EQ(r.err.find("filesystem"), std::string::npos) << r.err;
        EXPECT_FALSE(fs::exists(folder_ / "o.exr"));
    }
}

TEST_F(Names, FoldersWithoutPermissionAreAWrongRequestInWords)
{
    const fs::path locked = folder_ / "locked", full = folder_ / "full", open = folder_ / "open";
    for (const fs::path &folder : {locked, full, open})
        fs::create_directory(folder);
    fs::copy_file(in_, locked / "a.0001.exr");
    fs::permissions(locked, fs::perms::none);
    fs::permissions(full, fs::perms::owner_read | fs::perms::owner_exec);
    const std::string out = (open / "o.exr").string(), sequence = (open / "o.####.exr").string();
    const std::vector<std::vector<std::string>> wrong{
        {(locked / "a.0001.exr").string(), out},
        {(locked / "a.####.exr").string(), sequence},
        {in_.string(), (full / "o.exr").string()},
        {in_.string(), (full / "new/o.exr").string()},
        {in_.string(), (locked / "o.exr").string()},
        {in_.string(), out, "--depth", (locked / "a.0001.exr").string() + ":Z"},
        {in_.string(), out, "--stats", (full / "s.json").string()},
        {in_.string(), out, "--preview", (full / "p.png").string()}};
    // Root may do everything unless what a thread starts loses the capabilities for that.
    bool bound = ::geteuid() != 0;
    std::thread([&] {
        bound |= ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) == 0 && ::prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH) == 0;
        for (std::vector<std::string> words : wrong) {
            const Result r = run(words[0], words[1], {words.begin() + 2, words.end()});
            if (!bound)
                break;
            EXPECT_EQ(r.status, 2) << words[0] << ' ' << words[1] << r.err;
            EXPECT_NE(r.err.find("Permission denied"), std::string::npos) << r.err;
            EXPECT_EQ(r.err.find("filesystem"), std::string::npos) << r.err;
            EXPECT_FALSE(fs::exists(out));
        }
    }).join();
    for (const fs::path &folder : {locked, full})
        fs::permissions(folder, fs::perms::owner_all);
    if (!bound)
        GTEST_SKIP() << "root here keeps its capabilities";
}

TEST_F(Names, DevicesAndPipesAreLeftAlone)
{
    const fs::path pipe = folder_ / "pipe", pipe_exr = folder_ / "pipe.exr";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo(pipe_exr.c_str(), 0600), 0);
    const Result refused = run(in_, pipe_exr.string());
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("is a device or a pipe"), std::string::npos) << refused.err;
    EXPECT_TRUE(fs::is_fifo(pipe_exr));
    fs::create_symlink("/dev/null", folder_ / "null.exr");
    EXPECT_EQ(run(in_, (folder_ / "null.exr").string()).status, 2);

    const int end = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
    ASSERT_GE(end, 0);
    const Result r = run(in_, (folder_ / "o.exr").string(), {"--stats", pipe.string()});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(fs::is_fifo(pipe));
    std::string heard(65536, '\0');
    const ssize_t bytes = ::read(end, heard.data(), heard.size());
    ::close(end);
    ASSERT_GT(bytes, 0);
    EXPECT_EQ(json::parse(heard.substr(0, std::size_t(bytes)))["totals"]["done"], 1);
}

TEST_F(Names, PipesAreNoPicturesAndNotWaitedFor)
{
    const std::string pipe = (folder_ / "pipe.exr").string(), out = (folder_ / "o.exr").string(), in = in_.string(),
                      scene = scene_.string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
    for (const std::vector<std::string> &words :
         std::vector<std::vector<std::string>>{{"run", scene, pipe, "-o", out, "--vfov", "50"},
                                               {"run", scene, (folder_ / "pipe.png").string(), "-o", out, "--vfov", "50"},
                                               {"run", scene, in, "-o", out, "--vfov", "50", "--depth", pipe + ":Z"},
                                               {"run", scene, in, "-o", out, "--camera", pipe},
                                               {"info", pipe},
                                               {"compare", pipe, in},
                                               {"compare", in, in, "--mask", pipe},
                                               {"sheet", in, pipe, "-o", (folder_ / "s.png").string()}}) {
        const Result r = brume(words, 20);
        EXPECT_TRUE(r.status == 1 || r.status == 2) << words[0] << r.status << r.err;
        EXPECT_NE((r.out + r.err).find("is a device or a pipe (expected a picture's file)"), std::string::npos)
            << words[0] << r.out << r.err;
    }
    EXPECT_FALSE(fs::exists(out));
    EXPECT_NE(run(folder_.path(), out).err.find("is a folder"), std::string::npos);
}

TEST_F(Names, LinksStayAndTheirTargetsAreRenewed)
{
    fs::create_directories(folder_ / "store");
    write_text(folder_ / "store/old.exr", "old");
    fs::create_symlink("store/old.exr", folder_ / "link.exr");
    fs::create_symlink("store/new.exr", folder_ / "dangling.exr");
    for (const char *name : {"link.exr", "dangling.exr"}) {
        ASSERT_EQ(run(in_, (folder_ / name).string()).status, 0);
        EXPECT_TRUE(fs::is_symlink(folder_ / name));
        EXPECT_NO_THROW(read_plane(folder_ / name, "R"));
    }
    EXPECT_NO_THROW(read_plane(folder_ / "store/old.exr", "R"));
    EXPECT_NO_THROW(read_plane(folder_ / "store/new.exr", "R"));
}

TEST_F(Names, OutputsMustNotFallOnWhatTheSceneReads)
{
    write_exr(folder_ / "env.exr", {{rgb()}});
    write_text(folder_ / "puffs.0001.csv", "x,y,z,scale,amplitude\n0,0,-5,1,1\n");
    write_text(scene_, R"({"brume":1,"environment":{"file":"env.exr"},"medium":{"scattering":0.1,
                          "density":[{"type":"gaussians","file":"puffs.####.csv"}]}})");
    fs::copy_file(in_, folder_ / "in.0001.exr");
    const std::string before = read_text(folder_ / "env.exr");
    Result r = run(folder_ / "in.0001.exr", (folder_ / "env.exr").string());
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("would overwrite the input"), std::string::npos) << r.err;
    EXPECT_TRUE(read_text(folder_ / "env.exr") == before);
    r = run(folder_ / "in.0001.exr", (folder_ / "o.exr").string(), {"--stats", (folder_ / "puffs.0001.csv").string()});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("would overwrite the input"), std::string::npos) << r.err;
    write_exr(folder_ / "tau.0001.exr", {{rgb("tau.")}});
    const std::string tau = read_text(folder_ / "tau.0001.exr");
    r = run(folder_ / "in.0001.exr", (folder_ / "tau.0001.exr").string(),
            {"--input", "optical_depth=" + (folder_ / "tau.####.exr").string() + ":tau"});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("would overwrite the input"), std::string::npos) << r.err;
    EXPECT_TRUE(read_text(folder_ / "tau.0001.exr") == tau);
}

TEST_F(Names, NegativeFramesAreFoundHoweverTheyAreWritten)
{
    write_text(scene_, R"({"brume":1,"medium":{"scattering":0,"absorption":{"keys":[[-2,0.1],[2,0.3]]}}})");
    for (const char *name : {"s.-0002.exr", "s.-001.exr", "s.0000.exr"})
        fs::copy_file(in_, folder_ / name);
    const std::string out = (folder_ / "o/s.####.exr").string();
    const Result r = run(folder_ / "s.####.exr", out, {"--depth-kind", "ray"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_TRUE(fs::exists(folder_ / "o/s.-0002.exr"));
    EXPECT_TRUE(fs::exists(folder_ / "o/s.-001.exr"));
    EXPECT_TRUE(fs::exists(folder_ / "o/s.0000.exr"));
    // Alone, a frame has the same number.
    ASSERT_EQ(run(folder_ / "s.-0002.exr", (folder_ / "one.exr").string(), {"--depth-kind", "ray"}).status, 0);
    EXPECT_EQ(read_plane(folder_ / "one.exr", "R"), read_plane(folder_ / "o/s.-0002.exr", "R"));
    EXPECT_EQ(run(folder_ / "s.####.exr", out, {"--depth-kind", "ray", "--frames", "-2-0"}).status, 0);
}

TEST_F(Names, GapsAndNearMissesAreSaid)
{
    for (const char *name : {"s.0001.exr", "s.0004.exr", "s.0005.exr", "s.7.exr"})
        fs::copy_file(in_, folder_ / name);
    const Result r = run(folder_ / "s.####.exr", (folder_ / "o/s.####.exr").string());
    EXPECT_EQ(r.status, 0);
    EXPECT_NE(r.err.find("no files for the frames 2 to 3"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("left out for their number of digits: s.7.exr"), std::string::npos) << r.err;
    EXPECT_NE(brume({"info", (folder_ / "s.####.exr").string()}).out.find("2 to 3"), std::string::npos);
    EXPECT_EQ(run(folder_ / "s.####.exr", (folder_ / "o/s.####.exr").string(), {"--frames", "1,4"}).err.find("no files"),
              std::string::npos);
}

TEST_F(Names, InfoTakesADepthPattern)
{
    write_exr(folder_ / "c.0007.exr", {{rgb()}});
    write_exr(folder_ / "z.0007.EXR", {{{{"Z", Imf::FLOAT, constant(3)}}}});
    const Result r = brume({"info", (folder_ / "c.####.exr").string(), "--depth", (folder_ / "z.####.EXR").string() + ":Z"});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.out.find("3 to 3"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace brume::tests
