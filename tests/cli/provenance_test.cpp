#include <regex>

#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "files.hpp"

namespace brume::tests {
namespace {

class Provenance : public testing::Test {
protected:
    Provenance()
    {
        write_exr(in_, {{rgbz()}});
        write_text(scene_, kFog);
    }
    void run(const fs::path &out, std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run",       scene_.string(), in_.string(), "-o", out.string(),
                                       "--backend", "cpu",           "--vfov",     "50"};
        words.insert(words.end(), more.begin(), more.end());
        const Result r = brume(words);
        EXPECT_EQ(r.status, 0) << r.err;
    }
    static std::string of(const fs::path &path)
    {
        const Imf::Header header = read_header(path);
        const auto *text = header.findTypedAttribute<Imf::StringAttribute>("brume:provenance");
        return text ? text->value() : "";
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json", in_ = folder_ / "in.exr", a_ = folder_ / "a.exr", b_ = folder_ / "b.exr";
};

TEST_F(Provenance, NamesVersionBackendAndScene)
{
    run(a_);
    const std::string version = brume({"--version"}).out;
    const std::string expected = version.substr(0, version.find('\n')) + "; cpu; scene [0-9a-f]{16}";
    EXPECT_TRUE(std::regex_match(of(a_), std::regex(expected))) << of(a_);
    run(b_);
    EXPECT_TRUE(read_text(a_) == read_text(b_)) << "nothing of the time or the place is in it";
}

TEST_F(Provenance, TheSceneIsItsTextAndWhatOptionsSet)
{
    run(a_);
    const std::string first = of(a_);
    write_text(scene_, R"({ "medium": {"g":0.8, "absorption":[0.01,0.01,0.01],
        "scattering":[0.02,0.02,0.02]},   "brume":1 })");
    run(b_);
    EXPECT_EQ(of(b_), first) << "spaces and the order of keys are nothing";
    run(b_, {"--set", "multiscatter.kernel=paper"});
    EXPECT_NE(of(b_), first);
    run(b_, {"--quality", "draft"});
    EXPECT_NE(of(b_), first);
    write_text(scene_, std::regex_replace(kFog, std::regex("0.8"), "0.7"));
    run(b_);
    EXPECT_NE(of(b_), first);
}

TEST_F(Provenance, MayBeLeftOutAndOneOfAnEarlierRunGoes)
{
    run(a_, {"--no-provenance"});
    EXPECT_EQ(of(a_), "");
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &h) { h.insert("brume:provenance", Imf::StringAttribute("of another picture")); };
    write_exr(in_, {part});
    run(a_, {"--no-provenance"});
    EXPECT_EQ(of(a_), "");
    run(a_);
    EXPECT_EQ(of(a_).find("another"), std::string::npos);
}

TEST_F(Provenance, IsSaidWherePixelsAreCopiedUndecoded)
{
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &h) { h.insert("brume:provenance", Imf::StringAttribute("of another picture")); };
    write_exr(in_, {part});
    write_text(scene_, R"({"brume":1,"medium":{"scattering":0,"absorption":0}})");
    run(a_);
    EXPECT_EQ(of(a_).find("brume "), 0u) << of(a_);
    run(a_, {"--no-provenance"});
    EXPECT_EQ(of(a_), "");
}

TEST_F(Provenance, CompareNamesAStaleGolden)
{
    run(a_);
    run(b_);
    EXPECT_EQ(brume({"compare", a_.string(), b_.string()}).out.find("made otherwise"), std::string::npos);
    const std::string was = of(b_);
    write_text(scene_, std::regex_replace(kFog, std::regex("0.8"), "0.80001"));
    run(a_);
    Result r = brume({"compare", a_.string(), b_.string(), "--fail", "1"});
    EXPECT_EQ(r.status, 0) << "it is told, and no limit";
    EXPECT_NE(r.out.find("made otherwise: " + a_.string() + " is of \"" + of(a_) + "\", " + b_.string() + " is of \"" + was +
                         "\""),
              std::string::npos)
        << r.out;
    run(b_, {"--no-provenance"});
    r = brume({"compare", a_.string(), b_.string()});
    EXPECT_NE(r.out.find(b_.string() + " does not say"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace brume::tests
