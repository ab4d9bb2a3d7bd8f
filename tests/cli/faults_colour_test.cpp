#include <cmath>
#include <cstdlib>
#include <random>

#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "files.hpp"

namespace brume::tests {
namespace {

bool has(const Imf::Header &header, const char *name)
{
    return header.find(name) != header.end();
}

class ColourSpace : public testing::Test {
protected:
    ColourSpace()
    {
        write_text(fog_, kFog);
        write_text(clear_, kClear);
        write_exr(in_, {{rgbz()}});
    }
    ~ColourSpace() override { ::unsetenv("OCIO"); }
    Result run(const fs::path &scene, std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run",    scene.string(), in_.string(), "-o",  out_.string(),
                                       "--vfov", "50",           "--backend",  "cpu", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    void use_config(const std::string &roles, const std::string &lut) const
    {
        write_text(folder_ / "c.ocio", "ocio_profile_version: 2\nroles:\n  default: lin\n" + roles +
                                           "displays:\n  sRGB:\n    - !<View> {name: Film, colorspace: disp}\n"
                                           "colorspaces:\n  - !<ColorSpace>\n    name: lin\n  - !<ColorSpace>\n"
                                           "    name: disp\n    from_reference: !<FileTransform> {src: \"" +
                                           lut + "\"}\n");
        ::setenv("OCIO", (folder_ / "c.ocio").c_str(), 1);
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", clear_ = folder_ / "clear.json", in_ = folder_ / "in.exr",
                   out_ = folder_ / "out.exr";
};

TEST_F(ColourSpace, FogWithoutColourOptionsNeedsNoView)
{
    use_config("  scene_linear: lin\n", "not_there.cube");
    EXPECT_EQ(run(fog_).status, 0) << run(fog_).err;
    const Result r = run(fog_, {"--preview", (folder_ / "p.png").string()});
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("not_there.cube"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("c.ocio"), std::string::npos) << r.err;
}

TEST_F(ColourSpace, FogWithoutColourOptionsNeedsNoConfigAndOthersSayWhy)
{
    use_config("  compositing_log: lin\n", "not_there.cube");
    EXPECT_EQ(run(fog_).status, 0);
    const Result role = run(fog_, {"--input-space", "lin"});
    EXPECT_EQ(role.status, 2);
    EXPECT_NE(role.err.find("scene_linear"), std::string::npos) << role.err;
    EXPECT_NE(role.err.find("c.ocio"), std::string::npos) << role.err;
    ::setenv("OCIO", (folder_ / "none.ocio").c_str(), 1);
    const Result without = run(fog_);
    EXPECT_EQ(without.status, 0) << without.err;
    EXPECT_NE(without.err.find("none.ocio"), std::string::npos) << without.err;
    EXPECT_EQ(run(fog_, {"--output-space", "lin"}).status, 2);
}

TEST_F(ColourSpace, ANewSpaceLeavesNoClaimsOfTheOldOne)
{
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &h) {
        h.insert("acesImageContainerFlag", Imf::IntAttribute(1));
        Imf::addAdoptedNeutral(h, {0.32168f, 0.33767f});
        Imf::addChromaticities(h, {{0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}});
        h.insert("colorInteropID", Imf::StringAttribute("lin_ap0_scene"));
        h.insert("oiio:ColorSpace", Imf::StringAttribute("ACES2065-1"));
        h.insert("note", Imf::StringAttribute("kept"));
    };
    write_exr(in_, {part});
    ASSERT_EQ(run(clear_).status, 0);
    EXPECT_TRUE(has(read_header(out_), "acesImageContainerFlag"));
    ASSERT_EQ(run(clear_, {"--input-space", "ACES2065-1", "--output-space", "Linear Rec.709"}).status, 0);
    Imf::Header h = read_header(out_);
    for (const char *name : {"acesImageContainerFlag", "adoptedNeutral", "colorInteropID", "oiio:ColorSpace"})
        EXPECT_FALSE(has(h, name)) << name;
    EXPECT_TRUE(has(h, "note"));
    ASSERT_TRUE(Imf::hasChromaticities(h));
    EXPECT_NEAR(Imf::chromaticities(h).red.x, 0.64, 1e-6);
    EXPECT_NEAR(Imf::chromaticities(h).white.y, 0.329, 1e-6);
    ASSERT_EQ(run(clear_, {"--input-space", "ACES2065-1", "--output-space", "ACEScg"}).status, 0);
    h = read_header(out_);
    EXPECT_NEAR(Imf::chromaticities(h).green.y, 0.83, 1e-6);
    ASSERT_EQ(run(clear_, {"--input-space", "ACES2065-1", "--output-space", "sRGB"}).status, 0);
    EXPECT_FALSE(Imf::hasChromaticities(read_header(out_))) << "not linear: no primaries can be told";
}

TEST_F(ColourSpace, DegenerateChromaticitiesAreNamedAndDoNotStopTheRun)
{
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &h) { Imf::addChromaticities(h, {{0, 0}, {0, 0}, {0, 0}, {0, 0}}); };
    write_exr(in_, {part});
    const Result r = run(fog_);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find("in.exr: its chromaticities are degenerate"), std::string::npos) << r.err;
}

TEST_F(ColourSpace, NothingToDoCopiesLossyPixelsBitForBit)
{
    TestPart part{rgbz()};
    part.channels[0].value = [](int x, int y) { return std::fmod(x * 12.9898 + y * 78.233, 1.0); };
    part.edit = [](Imf::Header &h) { h.compression() = Imf::DWAA_COMPRESSION; };
    write_exr(in_, {part});
    ASSERT_EQ(run(clear_).status, 0);
    for (const char *c : {"R", "G", "B", "Z"})
        EXPECT_EQ(read_plane(in_, c), read_plane(out_, c)) << c;
}

TEST_F(ColourSpace, TheDwaLevelIsKeptAndTheLargestStaysFinite)
{
    write_text(fog_, R"({"brume":1,"medium":{"scattering":0,"absorption":1e-3,"emission":20000}})");
    std::minstd_rand random(5);
    TestPart part{rgbz()};
    part.data = {{0, 0}, {255, 255}};
    for (int c = 0; c < 3; ++c)
        part.channels[std::size_t(c)].value = [&](int, int) { return random() % 3 ? 45000.0 : double(random() % 1000); };
    part.channels[3].value = constant(1);
    std::uintmax_t sizes[2];
    for (const float level : {5.0f, 200.0f}) {
        part.edit = [=](Imf::Header &h) {
            h.compression() = Imf::DWAA_COMPRESSION;
            h.insert("dwaCompressionLevel", Imf::FloatAttribute(level));
        };
        write_exr(in_, {part}, part.data);
        ASSERT_EQ(run(fog_).status, 0);
        sizes[level > 5] = fs::file_size(out_);
        EXPECT_EQ(read_header(out_).typedAttribute<Imf::FloatAttribute>("dwaCompressionLevel").value(), level);
        for (const char *c : {"R", "G", "B"})
            for (const double v : read_plane(out_, c))
                ASSERT_TRUE(std::isfinite(v)) << level;
    }
    EXPECT_GT(double(sizes[0]), 1.3 * double(sizes[1])) << "coded at the level that the header says";
}

}  // namespace
}  // namespace brume::tests
