#include <algorithm>
#include <cmath>
#include <cstring>

#include <ImfHeader.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files.hpp"

namespace brume::tests {
namespace {

using nlohmann::json;

class DepthTaken : public testing::Test {
protected:
    DepthTaken() { write_text(scene_, R"({"brume":1,"medium":{"scattering":0,"absorption":0.1}})"); }
    Result run(std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run", scene_.string(), in_.string(), "-o",     out_.string(), "--vfov",
                                       "50",  "--backend",     "cpu",        "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    void picture_with(const Value &depth, Imf::PixelType type = Imf::FLOAT) const
    {
        TestPart part{rgb()};
        part.channels.push_back({"Z", type, depth});
        write_exr(in_, {part});
    }

    Folder folder_;
    const fs::path scene_ = folder_ / "fog.json", in_ = folder_ / "in.exr", out_ = folder_ / "out.exr",
                   z_ = folder_ / "z.EXR";
};

TEST_F(DepthTaken, AnotherSizeIsAnErrorThatGivesBoth)
{
    write_exr(in_, {{rgb()}});
    for (const Imath::V2i &size : {Imath::V2i(16, 12), Imath::V2i(64, 48), Imath::V2i(30, 24)}) {
        TestPart depth{{{"Z", Imf::FLOAT, constant(3)}}};
        depth.data = {{0, 0}, size - Imath::V2i(1)};
        write_exr(z_, {depth}, depth.data);
        const std::string both = std::to_string(size.x) + " x " + std::to_string(size.y);
        for (const Result &r :
             {run({"--depth", z_.string() + ":Z"}), brume({"info", in_.string(), "--depth", z_.string() + ":Z"}),
              brume({"plan", scene_.string(), in_.string(), "--vfov", "50", "--depth", z_.string() + ":Z"})}) {
            EXPECT_EQ(r.status, 2) << r.err;
            EXPECT_NE(r.err.find(both), std::string::npos) << r.err;
            EXPECT_NE(r.err.find("32 x 24"), std::string::npos) << r.err;
        }
        EXPECT_FALSE(fs::exists(out_));
    }
}

TEST_F(DepthTaken, AReducedPartOfTheSameFileIsAnErrorAndACropIsNot)
{
    TestPart picture{rgb()}, depth{{{"Z", Imf::FLOAT, constant(3)}}};
    picture.name = "rgb", depth.name = "depth";
    depth.data = {{0, 0}, {15, 11}};
    write_exr(in_, {picture, depth});
    EXPECT_EQ(run().status, 2);
    depth.data = {{3, 5}, {20, 17}};
    write_exr(in_, {picture, depth});
    const Result r = run();
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find("534 pixels lie outside the depth's data window"), std::string::npos) << r.err;
}

TEST_F(DepthTaken, NegativeDepthIsSaidAndHasAKind)
{
    picture_with([](int x, int) { return x == 0 ? -1e30 : -2.0 - x; });
    const Result r = run();
    EXPECT_EQ(r.status, 0);
    EXPECT_NE(r.err.find("--depth-kind negative"), std::string::npos) << r.err;
    const Result info = brume({"info", in_.string()});
    EXPECT_NE(info.out.find("--depth-kind negative"), std::string::npos) << info.out;
    const Result right = run({"--depth-kind", "negative"});
    ASSERT_EQ(right.status, 0) << right.err;
    EXPECT_EQ(right.err.find("warning"), std::string::npos) << right.err;
    const auto negative = read_plane(out_, "R");
    picture_with([](int x, int) { return x == 0 ? 1e30 : 2.0 + x; });
    ASSERT_EQ(run().status, 0);
    EXPECT_EQ(read_plane(out_, "R"), negative);
    const json i = json::parse(brume({"info", in_.string(), "--depth-kind", "negative", "--json"}).out);
    EXPECT_EQ(i["depth"]["far_pixels"], kWidth * kHeight) << "and the reverse";
    EXPECT_FALSE(i["depth"]["notes"].empty());
}

TEST_F(DepthTaken, FarAndSaturatedDepthIsSaid)
{
    picture_with([](int x, int y) { return x || y ? 1e10 : 3; });
    EXPECT_NE(run().err.find("767 of 768 pixels count as far"), std::string::npos);
    picture_with([](int x, int y) { return x < 4 ? 65504.0 : 3.0 + y; }, Imf::HALF);
    const Result r = run();
    EXPECT_NE(r.err.find("96 pixels have the depth 65504"), std::string::npos) << r.err;
    EXPECT_EQ(run({"--far", "65504"}).err.find("65504"), std::string::npos);
}

TEST_F(DepthTaken, ColourThatIsNotFiniteIsSaid)
{
    TestPart part{rgbz()};
    part.channels[0].value = [](int x, int y) { return x == 1 && y == 1 ? NAN : 1; };
    write_exr(in_, {part});
    EXPECT_NE(run().err.find("1 pixels have a colour that is not finite"), std::string::npos);
}

TEST_F(DepthTaken, WhatCannotBeReadIsNamed)
{
    write_exr(in_, {{{{"Y"}, {"RY", Imf::HALF, constant(0), 2}, {"BY", Imf::HALF, constant(0), 2}, {"Z", Imf::FLOAT}}}});
    EXPECT_NE(run().err.find("luminance and chroma"), std::string::npos) << run().err;
    auto channels = rgb();
    channels.push_back({"Z", Imf::FLOAT, constant(2), 2});
    write_exr(in_, {{channels}});
    EXPECT_NE(run().err.find("'Z' is subsampled 2 x 2"), std::string::npos) << run().err;

    picture_with(constant(3));
    std::string bytes = read_text(in_);
    const auto at = bytes.find(std::string("compression\0compression\0", 24)) + 28;
    for (const char code : {char(10), char(11)}) {
        bytes[at] = code;
        write_text(in_, bytes);
        const Result r = run();
        EXPECT_EQ(r.status, 1);
        EXPECT_NE(r.err.find("HTJ2K"), std::string::npos) << r.err;
    }

    TestPart picture{rgbz()}, other{{{"other.Y", Imf::HALF}}};
    picture.name = "rgb", other.name = "diffuse";
    write_exr(in_, {picture, other});
    bytes = read_text(in_);
    // Two chunks of 16 lines for each part: the entries of the second part's are the last two of the table.
    const std::size_t first_chunk = [&] {
        for (std::size_t i = 0;; ++i) {
            std::uint64_t offset = 0;
            std::memcpy(&offset, &bytes[i], 8);
            if (offset == i + 32)
                return i;
        }
    }();
    std::fill_n(bytes.begin() + std::ptrdiff_t(first_chunk) + 16, 16, '\0');
    write_text(in_, bytes);
    const Result r = run();
    EXPECT_EQ(r.status, 1);
    EXPECT_NE(r.err.find("'diffuse'"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("never written"), std::string::npos) << r.err;
}

/// An element over its plate, both fogged, is what the picture of both is when it is fogged.
TEST_F(DepthTaken, AnElementBringsTheLightOfTheMediumOnlyWhereItCovers)
{
    write_text(scene_, R"({"brume":1,"medium":{"scattering":0,"absorption":0.1,"emission":0.02}})");
    const auto alpha = [](int x, int) { return (x % 5) / 4.0; };
    TestPart element{{{"A", Imf::FLOAT, alpha}, {"Z", Imf::FLOAT, constant(4)}}}, plate{{{"Z", Imf::FLOAT, constant(9)}}};
    for (const char *c : {"R", "G", "B"}) {
        element.channels.push_back({c, Imf::FLOAT, [alpha](int x, int y) { return 2 * alpha(x, y); }});
        plate.channels.push_back({c, Imf::FLOAT, constant(0.5)});
    }
    write_exr(in_, {element});
    ASSERT_EQ(run({"--element", "--depth-kind", "ray"}).status, 0);
    const auto over = read_plane(out_, "R"), a = read_plane(in_, "A");
    for (std::size_t i = 0; i < over.size(); ++i) {
        const double t = std::exp(-0.4), own = 0.02 / 0.1 * (1 - t);
        ASSERT_NEAR(over[i], a[i] * (2 * t + own), 1e-4) << i;
    }
    EXPECT_EQ(read_plane(out_, "A"), a);
    ASSERT_EQ(run({"--element", "--depth-kind", "ray", "--layers", "transmittance"}).status, 0);
    EXPECT_EQ(read_plane(out_, "R"), over);
    for (const double t : read_plane(out_, "brume.transmittance.R"))
        ASSERT_NEAR(t, std::exp(-0.4), 1e-3) << "of the picture, not of the black one";
    write_exr(in_, {plate});
    EXPECT_EQ(run({"--element"}).status, 2) << "no alpha";
}

}  // namespace
}  // namespace brume::tests
