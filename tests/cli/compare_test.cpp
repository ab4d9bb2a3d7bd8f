#include <cmath>

#include <ImfChannelList.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class Compare : public testing::Test {
protected:
    /// Grey of this value, float; one red pixel of `spot` at (5, 7).
    static TestPart grey(double value, double spot)
    {
        TestPart part{{{"R", Imf::FLOAT, [=](int x, int y) { return x == 5 && y == 7 ? spot : value; }},
                       {"G", Imf::FLOAT, constant(value)},
                       {"B", Imf::FLOAT, constant(value)}}};
        return part;
    }
    static TestPart grey(double value) { return grey(value, value); }

    Result compare(std::vector<std::string> more) const { return compare(a_, b_, std::move(more)); }
    static Result compare(const fs::path &a, const fs::path &b, std::vector<std::string> more = {})
    {
        std::vector<std::string> words{"compare", a.string(), b.string()};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    /// Golden and rendered folders with frames 1 to 3, of which the second differs.
    void make_sequences() const
    {
        fs::create_directories(folder_ / "new/sub");
        fs::create_directories(folder_ / "gold/sub");
        for (int i = 1; i <= 3; ++i) {
            const std::string name = "o.000" + std::to_string(i) + ".exr";
            write_exr(folder_ / ("gold/" + name), {grey(1)});
            write_exr(folder_ / ("new/" + name), {grey(i == 2 ? 2 : 1)});
        }
    }

    Folder folder_;
    const fs::path a_ = folder_ / "a.exr", b_ = folder_ / "b.exr";
};

TEST_F(Compare, LimitsDecideTheStatus)
{
    write_exr(a_, {grey(1, 3)});
    write_exr(b_, {grey(1)});
    EXPECT_EQ(compare({}).status, 0) << "without limits it only measures";
    const std::vector<std::pair<std::vector<std::string>, int>> cases{{{"--fail", "1.99"}, 1},
                                                                      {{"--fail", "2"}, 0},
                                                                      {{"--fail-relative", "1"}, 0},
                                                                      {{"--fail-relative", "0.9"}, 1},
                                                                      {{"--fail", "0", "--fail-percent", "0.2"}, 0},
                                                                      {{"--fail", "0", "--fail-percent", "0.1"}, 1},
                                                                      {{"--hard-fail", "1.9", "--fail-percent", "100"}, 1},
                                                                      {{"--allow", "1"}, 0},
                                                                      {{"--search-radius", "1"}, 1},
                                                                      {{"--max-relmse", "1"}, 0},
                                                                      {{"--max-relmse", "1e-9"}, 1},
                                                                      {{"--max-log2", "1"}, 0},
                                                                      {{"--max-log2", "1e-9"}, 1},
                                                                      {{"--energy", "0.9:1.1"}, 0},
                                                                      {{"--energy", "0.9:1"}, 1}};
    for (const auto &[more, status] : cases) {
        const Result r = compare(more);
        EXPECT_EQ(r.status, status) << more[0] << ' ' << more[1] << r.out << r.err;
        EXPECT_EQ(r.out.find("beyond:") != std::string::npos, status == 1) << r.out;
    }
    EXPECT_NE(compare({"--fail", "1"}).out.find("(5, 7)"), std::string::npos);
    EXPECT_NE(compare({}).out.find("mean difference  +0.000868056"), std::string::npos) << compare({}).out;
    const json m = json::parse(compare({"--json", "--fail", "1"}).out);
    EXPECT_EQ(m["outcome"], "beyond");
    EXPECT_EQ(m["failing_pixels"], 1);
    EXPECT_NEAR(m["mean_difference"].get<double>(), 2.0 / (3 * kWidth * kHeight), 1e-12);
}

TEST_F(Compare, AMaskLeavesPixelsOut)
{
    write_exr(a_, {grey(1, 3)});
    write_exr(b_, {grey(1)});
    const std::string mask = (folder_ / "mask.exr").string();
    write_exr(mask, {grey(1, 0)});
    EXPECT_EQ(compare({"--fail", "0", "--mask", mask}).status, 1) << "0 in one channel only";
    write_exr(mask, {{{{"Y", Imf::HALF, [](int x, int y) { return x == 5 && y == 7 ? 0 : 0.5; }}}}});
    const Result r = compare({"--fail", "0", "--max-relmse", "0", "--mask", mask, "--json"});
    EXPECT_EQ(r.status, 0) << r.out << r.err;
    EXPECT_EQ(json::parse(r.out)["pixels"], kWidth * kHeight - 1);
    write_exr(mask, {grey(0)});
    EXPECT_EQ(compare({"--mask", mask}).status, 1) << "nothing is left to compare";
    TestPart small = grey(1);
    small.data = {{0, 0}, {3, 3}};
    write_exr(mask, {small});
    const Result other = compare({"--mask", mask});
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("4 x 4 at (0, 0)"), std::string::npos) << other.err;
}

TEST_F(Compare, WhatIsNotFiniteInOneOnlyFailsWithoutLimits)
{
    write_exr(a_, {grey(1, NAN)});
    write_exr(b_, {grey(1)});
    EXPECT_EQ(compare({}).status, 1);
    EXPECT_EQ(compare({"--allow", "9"}).status, 1);
    write_exr(b_, {grey(1, NAN)});
    EXPECT_EQ(compare({"--fail", "0"}).status, 0);
}

TEST_F(Compare, OtherWindowsOrChannelsAreBeyondAndBothAreNamed)
{
    TestPart part = grey(1);
    write_exr(a_, {part});
    part.data = {{4, 4}, {15, 11}};
    write_exr(b_, {part});
    Result r = compare({});
    EXPECT_EQ(r.status, 1);
    for (const char *said : {"a.exr is 32 x 24 at (0, 0)", "b.exr is 12 x 8 at (4, 4)", "12 x 8 pixels in common"})
        EXPECT_NE(r.out.find(said), std::string::npos) << said << " in " << r.out;
    part.data = {{100, 100}, {101, 101}};
    write_exr(b_, {part});
    r = compare({});
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.err.find("2 x 2 at (100, 100)"), std::string::npos) << r.err;
    part = grey(1);
    part.channels.push_back({"A", Imf::HALF, constant(1)});
    write_exr(b_, {part});
    r = compare({});
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.out.find("a.exr has R, G, B, "), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("b.exr has R, G, B, A"), std::string::npos) << r.out;
    write_exr(b_, {{{{"Y", Imf::FLOAT, constant(1)}}}});
    EXPECT_EQ(compare({}).status, 1);
}

TEST_F(Compare, WrongRequestsTouchNothing)
{
    write_exr(a_, {grey(1)});
    write_exr(b_, {grey(2)});
    const std::string before = read_text(b_), mask = (folder_ / "none.exr").string();
    const std::vector<std::vector<std::string>> wrong{{"--fail", "-1"},
                                                      {"--fail", "x"},
                                                      {"--fail", "nan"},
                                                      {"--max-relmse", "inf"},
                                                      {"--energy", "1"},
                                                      {"--energy", "2:1"},
                                                      {"--energy", "a:b"},
                                                      {"--search-radius", "-1"},
                                                      {"--allow", "-1"},
                                                      {"--jobs", "0"},
                                                      {"--frames", "1-3"},
                                                      {"--mask", mask},
                                                      {"--color", "nope"},
                                                      {"--difference", (folder_ / "d.jpg").string()},
                                                      {"--difference", b_.string()},
                                                      {"--junit", a_.string()}};
    for (auto more : wrong) {
        more.insert(more.end(), {"--update", "--html", (folder_ / "pages").string()});
        const Result r = compare(more);
        EXPECT_EQ(r.status, 2) << more[0] << ' ' << more[1] << r.out << r.err;
        EXPECT_TRUE(read_text(b_) == before) << more[0];
        EXPECT_FALSE(fs::exists(folder_ / "pages")) << more[0];
    }
    EXPECT_EQ(compare(a_, folder_ / "none.exr").status, 2);
    EXPECT_EQ(compare(folder_ / "none.exr", b_, {"--update"}).status, 2);
    EXPECT_EQ(compare(folder_.path(), b_).status, 2);
    EXPECT_EQ(compare(folder_ / "x.####.exr", folder_ / "y.####.exr").status, 2) << "no frame at all";
    EXPECT_TRUE(read_text(b_) == before);
}

TEST_F(Compare, PatternsAndFoldersAreComparedPairByPair)
{
    make_sequences();
    const fs::path a = folder_ / "new/o.####.exr", b = folder_ / "gold/o.%04d.exr";
    Result r = compare(a, b, {"--fail", "0.5", "--jobs", "2"});
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.out.find("within  o.0001.exr"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("beyond  o.0002.exr"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("3 pairs: 2 within, 1 beyond, 0 failed; largest relMSE 0.998 in o.0002.exr"), std::string::npos)
        << r.out;
    EXPECT_EQ(compare(a, b, {"--fail", "0.5", "--frames", "1,3"}).status, 0);
    EXPECT_EQ(compare(a, b, {"--fail", "1"}).status, 0);

    r = compare(folder_ / "new", folder_ / "gold", {"--fail", "0.5", "--json", "--jobs", "1"});
    EXPECT_EQ(r.status, 1);
    const json m = json::parse(r.out);
    EXPECT_EQ(m["pairs"].size(), 3u);
    EXPECT_EQ(m["pairs"][1]["outcome"], "beyond");
    EXPECT_EQ(m["summary"]["within"], 2);
    EXPECT_EQ(r.out, compare(folder_ / "new", folder_ / "gold", {"--fail", "0.5", "--json", "--jobs", "4"}).out);
}

TEST_F(Compare, WhatOneSideLacksFails)
{
    make_sequences();
    write_exr(folder_ / "gold/sub/x.exr", {grey(1)});
    write_exr(folder_ / "new/extra.exr", {grey(1)});
    const Result r = compare(folder_ / "new", folder_ / "gold");
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.out.find("failed  sub/x.exr  " + (folder_ / "new/sub/x.exr").string() + ": no such file"), std::string::npos)
        << r.out;
    EXPECT_NE(r.out.find("failed  extra.exr"), std::string::npos) << r.out;
    EXPECT_EQ(compare(folder_ / "new/o.####.exr", folder_ / "gold/o.####.exr", {"--frames", "3-4"}).status, 1);
    write_text(folder_ / "new/o.0001.exr", "no picture");
    EXPECT_EQ(compare(folder_ / "new", folder_ / "gold").status, 1);
}

TEST_F(Compare, DifferencesFollowThePattern)
{
    make_sequences();
    const fs::path a = folder_ / "new/o.####.exr", b = folder_ / "gold/o.####.exr";
    EXPECT_EQ(compare(a, b, {"-d", (folder_ / "d.####.exr").string()}).status, 0);
    EXPECT_EQ(read_plane(folder_ / "d.0002.exr", "G")[0], 1);
    EXPECT_EQ(read_plane(folder_ / "d.0003.exr", "G")[0], 0);
    EXPECT_EQ(compare(a, b, {"-d", (folder_ / "d.exr").string()}).status, 2) << "three pairs, one file";
}

TEST_F(Compare, UpdateMakesTheReferenceACopy)
{
    make_sequences();
    write_exr(folder_ / "new/sub/x.exr", {grey(1)});
    const fs::file_time_type kept = fs::last_write_time(folder_ / "gold/o.0001.exr");
    Result r = compare(folder_ / "new", folder_ / "gold", {"--fail", "0.1", "--update"});
    EXPECT_EQ(r.status, 0) << r.out << r.err;
    EXPECT_NE(r.out.find("updated: " + (folder_ / "gold/o.0002.exr").string() + " is now a copy of"), std::string::npos)
        << r.out;
    EXPECT_NE(r.out.find("is new"), std::string::npos) << r.out;
    for (const char *name : {"o.0001.exr", "o.0002.exr", "sub/x.exr"})
        EXPECT_TRUE(read_text(folder_ / "new" / name) == read_text(folder_ / "gold" / name)) << name;
    EXPECT_EQ(fs::last_write_time(folder_ / "gold/o.0001.exr"), kept) << "equal files are left alone";
    r = compare(folder_ / "new", folder_ / "gold", {"--fail", "0", "--update"});
    EXPECT_EQ(r.out.find("updated"), std::string::npos) << r.out;

    // What was not rendered, or is damaged, replaces nothing.
    fs::remove(folder_ / "new/o.0001.exr");
    fs::resize_file(folder_ / "new/o.0002.exr", fs::file_size(folder_ / "new/o.0002.exr") - 40);
    const std::string second = read_text(folder_ / "gold/o.0002.exr");
    r = compare(folder_ / "new", folder_ / "gold", {"--update"});
    EXPECT_EQ(r.status, 1);
    EXPECT_TRUE(fs::exists(folder_ / "gold/o.0001.exr"));
    EXPECT_TRUE(read_text(folder_ / "gold/o.0002.exr") == second);

    // A first golden, in a folder that is not there yet.
    EXPECT_EQ(compare(folder_ / "new/o.0003.exr", folder_ / "fresh/o.exr", {"--update"}).status, 0);
    EXPECT_TRUE(read_text(folder_ / "fresh/o.exr") == read_text(folder_ / "new/o.0003.exr"));
}

TEST_F(Compare, HeadersSayWhatElseChanged)
{
    TestPart a = grey(1), b = grey(1);
    a.edit = [](Imf::Header &h) {
        h.compression() = Imf::PIZ_COMPRESSION;
        h.insert("owner", Imf::StringAttribute("me"));
        h.insert("shot", Imf::StringAttribute("12"));
    };
    b.edit = [](Imf::Header &h) {
        h.insert("owner", Imf::StringAttribute("you"));
        h.insert("take", Imf::StringAttribute("3"));
    };
    b.channels.push_back({"Z", Imf::FLOAT, constant(1)});
    a.channels.push_back({"id", Imf::UINT, constant(1)});
    a.channels[0].type = Imf::HALF;
    write_exr(a_, {a}, {{0, 0}, {63, 47}});
    write_exr(b_, {b});
    EXPECT_EQ(compare({"--fail", "0"}).out.find("header:"), std::string::npos);
    const Result r = compare({"--fail", "0", "--header"});
    EXPECT_EQ(r.status, 0) << "no limit is on headers: " << r.out;
    for (const char *line : {"attribute 'compression' is piz, was zip", "attribute 'owner' is \"me\", was \"you\"",
                             "attribute 'shot' added: \"12\"", "attribute 'take' removed: \"3\"",
                             "attribute 'displayWindow' is (0, 0) to (63, 47), was (0, 0) to (31, 23)",
                             "channel 'Z' removed: float", "channel 'id' added: uint", "channel 'R' is half, was float"})
        EXPECT_NE(r.out.find(line), std::string::npos) << line << " in " << r.out;
    EXPECT_EQ(r.out.find("attribute 'channels'"), std::string::npos) << r.out;
    EXPECT_EQ(compare(a_, a_, {"--header"}).out.find("header:"), std::string::npos);
}

TEST_F(Compare, JunitListsEveryPair)
{
    make_sequences();
    write_exr(folder_ / "gold/a<&\"b.exr", {grey(1)});
    const fs::path xml = folder_ / "report.xml";
    EXPECT_EQ(compare(folder_ / "new", folder_ / "gold", {"--fail", "0.5", "--junit", xml.string()}).status, 1);
    const std::string text = read_text(xml);
    EXPECT_EQ(text.find("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"4\" failures=\"1\" errors=\"1\">"),
              0u)
        << text;
    EXPECT_NE(text.find("<testcase classname=\"brume.compare\" name=\"o.0001.exr\"/>"), std::string::npos) << text;
    EXPECT_NE(text.find("<failure message=\"768 of 768 pixels fail, the first at (0, 0)"), std::string::npos) << text;
    EXPECT_NE(text.find("name=\"a&lt;&amp;&quot;b.exr\""), std::string::npos) << text;
    EXPECT_NE(text.find("<error message="), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("  </testsuite>\n</testsuites>\n")) << text;
}

TEST_F(Compare, FlipIsAFigureAndNoGate)
{
    write_exr(a_, {grey(1, 3)});
    write_exr(b_, {grey(1)});
    EXPECT_EQ(compare({}).out.find("FLIP"), std::string::npos);
    const Result r = compare({"--flip", "--json"});
    EXPECT_EQ(r.status, 0);
    EXPECT_GT(json::parse(r.out)["hdr_flip"].get<double>(), 0);
    EXPECT_NE(compare(a_, a_, {"--flip"}).out.find("HDR-FLIP         0\n"), std::string::npos);
}

}  // namespace
}  // namespace brume::tests
