#include <cctype>
#include <cmath>
#include <cstring>
#include <map>

#include <gtest/gtest.h>
#include <half.h>
#include <unistd.h>

#include "files.hpp"
#include "image/frame.hpp"
#include "image/library.hpp"
#include "png_files.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

constexpr int kCount = kWidth * kHeight;

double from_srgb(double v)
{
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double to_srgb(double v)
{
    return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

class Pictures : public testing::Test {
protected:
    Pictures()
    {
        // Absorption alone, along rays: each pixel's factor is known, and no camera is asked for.
        write_text(fog_, R"({"brume":1,"medium":{"absorption":[0.1,0.1,0.1]}})");
        write_text(clear_, kClear);
        for (int i = 0; i < kCount * 3; ++i)
            rgb8_.push_back(std::uint8_t(i * 37 % 256));
        write_png(colour_, 3, rgb8_);
        for (int i = 0; i < kCount; ++i)
            depth16_.push_back(std::uint16_t(i % kWidth * 50 + 1));
        write_png(depth_, 1, depth16_);
    }
    Result run(const std::string &output, std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"run",       fog_.string(), colour_.string(), "-o",  (folder_ / output).string(),
                                       "--backend", "cpu",         "--depth-kind",   "ray", "--vfov",
                                       "50"};
        if (std::find(more.begin(), more.end(), "--depth") == more.end())
            words.insert(words.end(), {"--depth", depth_.string(), "--depth-scale", "0.01"});
        words.insert(words.end(), more.begin(), more.end());
        return brume(words);
    }
    void expect_refused(const Result &r, std::vector<std::string> said, int status = 2) const
    {
        EXPECT_EQ(r.status, status) << r.err;
        for (const std::string &word : said)
            EXPECT_NE(r.err.find(word), std::string::npos) << r.err << "\nlacks " << word;
    }
    double transmittance(int pixel) const { return std::exp(-0.1 * 0.01 * depth16_[std::size_t(pixel)]); }

    Folder folder_;
    fs::path fog_ = folder_ / "fog.json", clear_ = folder_ / "clear.json", colour_ = folder_ / "c.png",
             depth_ = folder_ / "d.png";
    std::vector<std::uint8_t> rgb8_;
    std::vector<std::uint16_t> depth16_;
};

TEST_F(Pictures, APngWithMetricDepthIsFoggedAsLight)
{
    const Result r = run("o.png");
    ASSERT_EQ(r.status, 0) << r.err;
    int channels = 0;
    const auto out = read_png<std::uint8_t>(folder_ / "o.png", channels);
    ASSERT_EQ(channels, 3);
    for (int i = 0; i < kCount * 3; ++i)
        EXPECT_NEAR(out[std::size_t(i)], 255 * to_srgb(from_srgb(rgb8_[std::size_t(i)] / 255.0) * transmittance(i / 3)),
                    1.01)
            << i;
    ASSERT_EQ(run("again.png").status, 0);
    EXPECT_EQ(read_text(folder_ / "o.png"), read_text(folder_ / "again.png"));
}

TEST_F(Pictures, NothingToDoChangesNoPixel)
{
    fog_ = clear_;
    for (int channels : {1, 3, 4}) {
        std::vector<std::uint8_t> pixels;
        std::vector<std::uint16_t> deep;
        for (int i = 0; i < kCount * channels; ++i) {
            pixels.push_back(i % channels == 3 ? 255 : std::uint8_t(i * 91 % 256));
            deep.push_back(i % channels == 3 ? 65535 : std::uint16_t(i * 7919 % 65536));
        }
        int n = 0;
        write_png(colour_, channels, pixels);
        ASSERT_EQ(run("o.png").status, 0);
        EXPECT_EQ(read_png<std::uint8_t>(folder_ / "o.png", n), pixels) << channels;
        EXPECT_EQ(n, channels);
        write_png(colour_, channels, deep);
        ASSERT_EQ(run("o.png").status, 0);
        EXPECT_EQ(read_png<std::uint16_t>(folder_ / "o.png", n), deep) << channels;
    }
}

TEST_F(Pictures, EightBitsAreDitheredSoThatTheirMeanIsRight)
{
    write_png(colour_, 3, std::vector<std::uint8_t>(3 * kCount, 100));
    write_png(depth_, 1, std::vector<std::uint16_t>(kCount, 40));
    ASSERT_EQ(run("o.png").status, 0);
    int n = 0;
    const auto out = read_png<std::uint8_t>(folder_ / "o.png", n);
    const double expected = 255 * to_srgb(from_srgb(100 / 255.0) * std::exp(-0.1 * 0.4));
    ASSERT_GT(expected - std::floor(expected), 0.1);
    std::map<int, int> counts;
    double sum = 0;
    for (const std::uint8_t v : out) {
        ++counts[v];
        sum += v;
    }
    EXPECT_EQ(counts.size(), 2u) << "what lies between two becomes either";
    EXPECT_NEAR(sum / double(out.size()), expected, 0.03);
}

TEST_F(Pictures, FloatsAndExrAreSceneLinear)
{
    for (const char *name : {"o.exr", "o.pfm", "o.npy", "o.hdr", "o.tif"}) {
        const Result r = run(name, std::string(name) == "o.tif" ? std::vector<std::string>{"--output-type", "half"}
                                                                : std::vector<std::string>{});
        ASSERT_EQ(r.status, 0) << r.err;
        const ImageFile file(folder_ / name);
        const Frame frame = read_frame(file, resolve_color(file, {}), nullptr);
        ASSERT_EQ(frame.pixels.size(), rgb8_.size());
        for (int i = 0; i < kCount * 3; ++i)
            EXPECT_NEAR(frame.pixels[std::size_t(i)], from_srgb(rgb8_[std::size_t(i)] / 255.0) * transmittance(i / 3), 5e-3)
                << name << i;
    }
}

TEST_F(Pictures, ATiffThatWasAPngIsReadAgain)
{
    fog_ = clear_;
    ASSERT_EQ(run("o.tif").status, 0);
    colour_ = folder_ / "o.tif";
    const Result r = run("o.png", {"--input-space", "sRGB"});
    ASSERT_EQ(r.status, 0) << r.err;
    int n = 0;
    EXPECT_EQ(read_png<std::uint8_t>(folder_ / "o.png", n), rgb8_);
}

TEST_F(Pictures, EveryFormatIsWrittenTwiceToTheSameBytes)
{
    std::map<std::string, std::string> before;
    for (const char *name : {"o.png", "o.jpg", "o.tif", "o.dpx", "o.hdr", "o.pfm", "o.npy", "o.exr"}) {
        ASSERT_EQ(run(name).status, 0) << name;
        before[name] = read_text(folder_ / name);
        fs::remove(folder_ / name);
    }
    ::sleep(1);  // dates have seconds
    for (const auto &[name, first] : before) {
        ASSERT_EQ(run(name).status, 0) << name;
        EXPECT_TRUE(read_text(folder_ / name) == first) << name;
        EXPECT_TRUE(first.find("brume-cli") == std::string::npos && first.find(".partial") == std::string::npos) << name;
    }
}

TEST_F(Pictures, StraightAlphaIsColourThatFogSeesMultiplied)
{
    std::vector<std::uint8_t> rgba;
    for (int i = 0; i < kCount; ++i)
        rgba.insert(rgba.end(), {200, 100, 50, std::uint8_t(i % 2 ? 128 : 255)});
    write_png(colour_, 4, rgba);
    ASSERT_EQ(run("o.png").status, 0);
    int n = 0;
    const auto out = read_png<std::uint8_t>(folder_ / "o.png", n);
    ASSERT_EQ(n, 4);
    for (int i = 0; i < kCount; ++i) {
        EXPECT_EQ(out[std::size_t(4 * i + 3)], rgba[std::size_t(4 * i + 3)]);
        EXPECT_NEAR(out[std::size_t(4 * i)], 255 * to_srgb(from_srgb(200 / 255.0) * transmittance(i)), 1.01);
    }
    ASSERT_EQ(run("o.exr").status, 0);
    EXPECT_NEAR(read_plane(folder_ / "o.exr", "R")[1], from_srgb(200 / 255.0) * 128 / 255 * transmittance(1), 1e-3)
        << "OpenEXR's colour is multiplied by alpha";
}

TEST_F(Pictures, PaletteIsColour)
{
    std::vector<std::uint8_t> indices;
    for (int i = 0; i < kCount; ++i)
        indices.push_back(std::uint8_t(i));
    write_png(colour_, 1, indices, kWidth, kHeight, PNG_COLOR_TYPE_PALETTE);
    fog_ = clear_;
    ASSERT_EQ(run("o.png").status, 0);
    int n = 0;
    const auto out = read_png<std::uint8_t>(folder_ / "o.png", n);
    ASSERT_EQ(n, 3);
    EXPECT_EQ(out[3 * 10], 10);
    EXPECT_EQ(out[3 * 10 + 1], 245);
}

TEST_F(Pictures, ColourComesFromEveryFormat)
{
    const auto make = [&](const std::string &name, const std::string &format, SampleType type, const void *pixels,
                          std::vector<std::string> channels = {"R", "G", "B"}) {
        Raster raster{kWidth, kHeight, std::move(channels), type, pixels};
        image_library().write(folder_ / name, name, format, raster);
    };
    std::vector<std::uint16_t> rgb16;
    std::vector<float> linear;
    std::vector<half> halves;
    std::vector<std::uint8_t> smooth;
    for (int i = 0; i < kCount * 3; ++i) {
        smooth.push_back(std::uint8_t(40 + i / 3 % kWidth * 5 + i % 3 * 10));
        rgb16.push_back(std::uint16_t(smooth.back() * 257));
        linear.push_back(float(from_srgb(smooth.back() / 255.0)));
        halves.push_back(half(linear.back()));
    }
    make("a.jpg", "jpeg", SampleType::kUint8, smooth.data());
    make("a8.tif", "tiff", SampleType::kUint8, smooth.data());
    make("a16.tif", "tiff", SampleType::kUint16, rgb16.data());
    make("a16.dpx", "dpx", SampleType::kUint16, rgb16.data());
    make("a8.dpx", "dpx", SampleType::kUint8, smooth.data());
    make("half.tif", "tiff", SampleType::kHalf, halves.data());
    make("float.tif", "tiff", SampleType::kFloat, linear.data());
    make("a.hdr", "hdr", SampleType::kFloat, linear.data());
    write_png(folder_ / "a.png", 3, smooth);
    for (const char *name : {"a.jpg", "a8.tif", "a16.tif", "a16.dpx", "a8.dpx", "half.tif", "float.tif", "a.hdr", "a.png"}) {
        colour_ = folder_ / name;
        const bool integers = std::isdigit(name[1]) != 0;
        const Result r =
            run("o.npy", integers ? std::vector<std::string>{"--input-space", "sRGB"} : std::vector<std::string>{});
        ASSERT_EQ(r.status, 0) << name << r.err;
        const ImageFile file(folder_ / "o.npy");
        const Frame frame = read_frame(file, resolve_color(file, {}), nullptr);
        const double tolerance = std::string(name) == "a.jpg" ? 0.03 : 0.006;
        for (int i = 0; i < kCount * 3; ++i)
            ASSERT_NEAR(frame.pixels[std::size_t(i)], double(linear[std::size_t(i)]) * transmittance(i / 3), tolerance)
                << name << i;
    }
}

TEST_F(Pictures, GreyIsOneChannelInEveryFormat)
{
    const std::vector<std::uint8_t> grey(kCount, 100);
    const Raster raster{kWidth, kHeight, {"Y"}, SampleType::kUint8, grey.data()};
    for (const auto &[name, format] : std::vector<std::pair<std::string, std::string>>{
             {"g.png", "png"}, {"g.jpg", "jpeg"}, {"g.tif", "tiff"}, {"g.dpx", "dpx"}}) {
        image_library().write(folder_ / name, name, format, raster);
        colour_ = folder_ / name;
        const Result r = run("out_" + name, {"--input-space", "sRGB"});
        ASSERT_EQ(r.status, 0) << name << r.err;
        EXPECT_EQ(ImageFile(folder_ / ("out_" + name)).part(0).channels.size(), 1u) << name;
    }
}

TEST_F(Pictures, OfSeveralPicturesInAFileItIsSaidThatOneIsRead)
{
    // A second directory of a TIFF: the first one's offset is put where the end of the list is marked.
    std::vector<std::uint8_t> pixels(3 * kCount, 100);
    const Raster raster{kWidth, kHeight, {"R", "G", "B"}, SampleType::kUint8, pixels.data()};
    image_library().write(folder_ / "m.tif", "m.tif", "tiff", raster);
    std::string tiff = read_text(folder_ / "m.tif");
    std::uint32_t first = 0;
    std::memcpy(&first, tiff.data() + 4, 4);
    std::uint16_t entries = 0;
    std::memcpy(&entries, tiff.data() + first, 2);
    const std::string directory = tiff.substr(first, 2 + 12 * std::size_t(entries)) + std::string(4, '\0');
    tiff.append(tiff.size() % 2, '\0');
    const auto second = std::uint32_t(tiff.size());
    std::memcpy(tiff.data() + first + 2 + 12 * std::size_t(entries), &second, 4);
    write_text(folder_ / "m.tif", tiff + directory);
    colour_ = folder_ / "m.tif";
    const Result r = run("o.tif", {"--input-space", "sRGB"});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find("m.tif: has several pictures: the first is read"), std::string::npos) << r.err;
    EXPECT_NE(brume({"info", (folder_ / "m.tif").string()}).out.find("has several pictures"), std::string::npos);
    EXPECT_EQ(run("again.png", {"--input-space", "sRGB"}).status, 0);
}

TEST_F(Pictures, LayersThatStayBehindAreSaid)
{
    write_exr(folder_ / "in.exr", {{rgbz()}});
    write_text(clear_, kClear);
    for (const char *output : {"o.png", "o.tif", "o.npy", "o.exr"}) {
        const Result r = brume({"run", clear_.string(), (folder_ / "in.exr").string(), "-o", (folder_ / output).string(),
                                "--output-space", "sRGB"});
        ASSERT_EQ(r.status, 0) << r.err;
        EXPECT_EQ(r.err.find("1 other channels stay behind") != std::string::npos, output != std::string("o.exr"))
            << output << ": " << r.err;
    }
}

TEST_F(Pictures, DepthComesFromPfmAndNpyInAnyOrder)
{
    ASSERT_EQ(run("o.png").status, 0);
    const std::string expected = read_text(folder_ / "o.png");
    std::vector<float> metres, from_below, by_columns;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            metres.push_back(0.01f * depth16_[std::size_t(y * kWidth + x)]);
    for (int y = kHeight - 1; y >= 0; --y)
        from_below.insert(from_below.end(), metres.begin() + y * kWidth, metres.begin() + (y + 1) * kWidth);
    for (int x = 0; x < kWidth; ++x)
        for (int y = 0; y < kHeight; ++y)
            by_columns.push_back(metres[std::size_t(y * kWidth + x)]);
    const auto expect_as_png = [&](const std::string &name, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"--depth", (folder_ / name).string()});
        const Result r = run("p.png", more);
        ASSERT_EQ(r.status, 0) << name << r.err;
        EXPECT_TRUE(read_text(folder_ / "p.png") == expected) << name;
    };
    write_text(folder_ / "little.pfm", "Pf\n32 24\n-1.0\n" + bytes(from_below));
    write_text(folder_ / "big.pfm", "Pf\n32 24\n1.0\n" + bytes(from_below, true));
    expect_as_png("little.pfm");
    expect_as_png("big.pfm");
    write_npy(folder_ / "c.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (24, 32), }", bytes(metres));
    write_npy(folder_ / "b.npy", "{'descr': '>f4', 'fortran_order': False, 'shape': (24, 32, 1), }", bytes(metres, true));
    write_npy(folder_ / "f.npy", "{'descr': '<f4', 'fortran_order': True, 'shape': (24, 32), }", bytes(by_columns));
    write_npy(folder_ / "u.npy", "{'descr': '<u2', 'fortran_order': False, 'shape': (24, 32), }", bytes(depth16_));
    expect_as_png("c.npy");
    expect_as_png("b.npy");
    expect_as_png("f.npy");
    expect_as_png("u.npy", {"--depth-scale", "0.01"});
    image_library().write(folder_ / "u.tif", "u.tif", "tiff",
                          {kWidth, kHeight, {"Y"}, SampleType::kUint16, depth16_.data()});
    expect_as_png("u.tif", {"--depth-scale", "0.01"});
    image_library().write(folder_ / "f.tif", "f.tif", "tiff", {kWidth, kHeight, {"Y"}, SampleType::kFloat, metres.data()});
    expect_as_png("f.tif");
    write_exr(folder_ / "z.exr", {{{{"Y", Imf::FLOAT, [&](int x, int y) { return metres[std::size_t(y * kWidth + x)]; }}}}});
    expect_as_png("z.exr");
    expect_as_png("z.exr:Y");
}

TEST_F(Pictures, WhatWouldLoseItsRangeOrMeaningIsRefused)
{
    write_exr(folder_ / "in.exr", {{rgbz()}});
    colour_ = folder_ / "in.exr";
    expect_refused(run("o.png", {"--depth", "Z"}), {"o.png", "uint8 holds 0 to 1", "in.exr", "--output-space"});
    EXPECT_FALSE(fs::exists(folder_ / "o.png"));
    const Result clipped = run("o.png", {"--depth", "Z", "--output-space", "sRGB"});
    EXPECT_EQ(clipped.status, 0) << clipped.err;
    EXPECT_NE(clipped.err.find("values beyond 0 to 1"), std::string::npos) << clipped.err;
    expect_refused(run("o.png", {"--depth", "Z", "--output-space", "sRGB", "--layers", "transmittance"}), {"--layers"});
    expect_refused(run("o.jpg", {"--depth", "Z", "--output-type", "uint16"}), {"--output-type uint16", "expected uint8"});
    colour_ = folder_ / "c.png";
    expect_refused(run("o.png", {"--depth", depth_.string()}), {"d.png", "uint16", "--depth-scale"});
    Raster tiff{kWidth, kHeight, {"R", "G", "B"}, SampleType::kUint8, rgb8_.data()};
    image_library().write(folder_ / "c.tif", "c.tif", "tiff", tiff);
    colour_ = folder_ / "c.tif";
    expect_refused(run("o.png"), {"c.tif", "the file does not say", "--input-space"});
    EXPECT_EQ(run("o.png", {"--input-space", "sRGB"}).status, 0);
}

}  // namespace
}  // namespace brume::tests
