#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <ImfChannelList.h>
#include <ImfMatrixAttribute.h>
#include <ImfOpaqueAttribute.h>
#include <ImfPreviewImageAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "exr/file.hpp"
#include "image/frame.hpp"
#include "image/write.hpp"
#include "files.hpp"
#include "support/error.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

class Keep : public testing::Test {
protected:
    Folder folder_;
    const fs::path in = folder_ / "in.exr", out = folder_ / "out.exr";

    Frame read(const LayerRequest &request = {}) const
    {
        ImageFile file(in);
        const ColorChoice color = resolve_color(file, request);
        std::string none;
        const auto depth = find_depth(file, request, &color, &none);
        if (!depth)
            return read_frame(std::move(file), color, nullptr);
        const DepthSource source{nullptr, *depth};
        return read_frame(std::move(file), color, &source);
    }
    /// Doubles the colour and writes it.
    WriteReport doubled(const std::vector<AddedLayer> &layers = {}, const LayerRequest &request = {}) const
    {
        Frame frame = read(request);
        for (std::size_t i = 0; i < frame.pixels.size(); ++i)
            if (i % std::size_t(frame.channels) < 3)
                frame.pixels[i] *= 2;
        return write_frame(frame, layers, out);
    }
    void expect_same(const std::string &channel, int part = 0) const
    {
        const auto a = read_plane(in, channel, part), b = read_plane(out, channel, part);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) << channel << " at " << i;
    }
    void expect_doubled(const std::string &channel, int part = 0) const
    {
        const auto a = read_plane(in, channel, part), b = read_plane(out, channel, part);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_EQ(2 * a[i], b[i]) << channel << " at " << i;
    }
};

TEST_F(Keep, TypesLayersAndMetadata)
{
    TestPart part{rgbz()};
    part.channels.push_back({"A", Imf::HALF, constant(0.25)});
    part.channels.push_back({"id", Imf::UINT, [](int x, int y) { return 4e9 + x + 100 * y; }});
    part.channels.push_back({"crypto00.R", Imf::FLOAT, [](int x, int y) { return 1e-30 * (x + y + 1); }});
    part.channels.push_back({"quarter", Imf::HALF, [](int x, int y) { return x + y; }, 2});
    part.edit = [](Imf::Header &h) {
        h.compression() = Imf::PIZ_COMPRESSION;
        h.lineOrder() = Imf::DECREASING_Y;
        h.pixelAspectRatio() = 2;
        h.insert("note", Imf::StringAttribute("kept"));
        Imf::OpaqueAttribute strange("made-up-type");
        h.insert("strange", strange);
        h.setPreviewImage(Imf::PreviewImage(4, 4));
        h.insert("oiio:SHA-1", Imf::StringAttribute("0123"));
        Imf::addTimeCode(h, Imf::TimeCode(1, 2, 3, 4));
    };
    write_exr(in, {part});
    doubled();
    for (const char *c : {"R", "G", "B"})
        expect_doubled(c);
    for (const char *c : {"A", "Z", "id", "crypto00.R"})
        expect_same(c);
    const auto quarter_of = [](const fs::path &path) {
        ImageFile file(path);
        const ColorChoice color = resolve_color(file, {});
        const Frame frame = read_frame(std::move(file), color, nullptr);
        const auto &planes = dynamic_cast<const ExrPixels &>(*frame.stored).planes;
        const auto at =
            std::find_if(planes.begin(), planes.end(), [](const Plane &p) { return p.channel.name == "quarter"; });
        return std::string(at->bytes.get(), kWidth / 2 * kHeight / 2 * 2);
    };
    EXPECT_TRUE(quarter_of(in) == quarter_of(out));
    const Imf::Header h = read_header(out);
    EXPECT_EQ(h.compression(), Imf::PIZ_COMPRESSION);
    EXPECT_EQ(h.lineOrder(), Imf::DECREASING_Y);
    EXPECT_EQ(h.pixelAspectRatio(), 2);
    EXPECT_EQ(h.channels()["id"].type, Imf::UINT);
    EXPECT_EQ(h.channels()["quarter"].xSampling, 2);
    EXPECT_EQ(h.typedAttribute<Imf::StringAttribute>("note").value(), "kept");
    EXPECT_EQ(std::string(h["strange"].typeName()), "made-up-type");
    EXPECT_TRUE(Imf::hasTimeCode(h));
    EXPECT_FALSE(h.hasPreviewImage()) << "it would show the old picture";
    EXPECT_EQ(h.findTypedAttribute<Imf::StringAttribute>("oiio:SHA-1"), nullptr);
}

TEST_F(Keep, WindowsOfEveryKind)
{
    const Imath::Box2i display({0, 0}, {kWidth - 1, kHeight - 1});
    for (const Imath::Box2i &data :
         {Imath::Box2i({-7, -5}, {40, 30}), Imath::Box2i({10, 4}, {20, 9}), Imath::Box2i({500, 500}, {520, 510}),
          Imath::Box2i({3, 3}, {3, 3}), Imath::Box2i({-100000, 7}, {-99990, 9})}) {
        TestPart part{rgbz()};
        part.data = data;
        write_exr(in, {part}, display);
        doubled();
        EXPECT_EQ(read_header(out).dataWindow(), data);
        EXPECT_EQ(read_header(out).displayWindow(), display);
        for (const char *c : {"R", "G", "B"})
            expect_doubled(c);
        expect_same("Z");
    }
}

TEST_F(Keep, PartsWithoutColourAreCopiedUndecoded)
{
    TestPart picture{rgbz()}, flat{{{"matte.R", Imf::HALF, [](int x, int y) { return x * y; }}}},
        deep{{{"Z", Imf::FLOAT, [](int x, int) { return x; }}}},
        tiled{{{"other", Imf::UINT, [](int x, int y) { return x + y; }}}};
    picture.name = "rgb", flat.name = "matte", deep.name = "deep", tiled.name = "tiles";
    flat.data = {{-3, 2}, {9, 9}};
    flat.edit = [](Imf::Header &h) { h.compression() = Imf::DWAA_COMPRESSION; };
    deep.deep = true;
    tiled.tiled = true;
    write_exr(in, {flat, deep, picture, tiled});
    const WriteReport report = doubled();
    EXPECT_TRUE(report.warnings.empty()) << "a lossy part that is copied undecoded loses nothing";
    expect_doubled("R", 2);
    expect_same("Z", 2);
    expect_same("matte.R", 0);
    expect_same("other", 3);
    EXPECT_EQ(read_deep(in, "Z", 1), read_deep(out, "Z", 1));
    EXPECT_EQ(read_header(out, 3).type(), "tiledimage");
}

TEST_F(Keep, TiledColourStaysTiled)
{
    TestPart part{rgbz()};
    part.tiled = true;
    write_exr(in, {part});
    doubled();
    EXPECT_TRUE(read_header(out).hasTileDescription());
    expect_doubled("G");
    expect_same("Z");
}

TEST_F(Keep, NonFiniteStaysAndTooLargeIsClampedAndCounted)
{
    const double inf = std::numeric_limits<double>::infinity();
    TestPart part{rgbz()};
    part.channels[0].value = [=](int x, int y) {
        return y ? 1 : x == 0 ? NAN : x == 1 ? inf : x == 2 ? -inf : x == 3 ? 60000 : x == 4 ? -60000 : 1;
    };
    write_exr(in, {part});
    const WriteReport report = doubled();
    const auto red = read_plane(out, "R");
    EXPECT_TRUE(std::isnan(red[0]));
    EXPECT_EQ(red[1], inf);
    EXPECT_EQ(red[2], -inf);
    EXPECT_EQ(red[3], 65504);
    EXPECT_EQ(red[4], -65504);
    EXPECT_EQ(report.clamped, 2u);
    EXPECT_EQ(report.warnings.size(), 1u);
}

TEST_F(Keep, LossyNeighboursAreWarnedOf)
{
    TestPart part{rgbz()};
    part.channels.push_back({"A", Imf::HALF});
    part.channels.push_back({"id", Imf::FLOAT});
    part.edit = [](Imf::Header &h) { h.compression() = Imf::DWAA_COMPRESSION; };
    write_exr(in, {part});
    EXPECT_TRUE(doubled().warnings.empty()) << "DWA codes these without loss";
    part.channels.push_back({"specular.R", Imf::HALF});
    write_exr(in, {part});
    EXPECT_EQ(doubled().warnings.size(), 1u);
}

TEST_F(Keep, DepthIsLaidOverTheColoursWindow)
{
    TestPart picture{rgb()}, depth{{{"Z", Imf::FLOAT, [](int x, int y) { return 1000 * y + x; }}}};
    picture.name = "rgb", depth.name = "depth";
    picture.data = {{4, 4}, {11, 9}};
    depth.data = {{6, 2}, {30, 7}};
    write_exr(in, {picture, depth});
    const Frame frame = read();
    EXPECT_EQ(frame.outside_depth_window, 8u * 6 - 6u * 4);
    EXPECT_EQ(frame.depth[2], 4006);
    EXPECT_EQ(frame.depth[3 * 8 + 7], 7011);
    EXPECT_TRUE(std::isinf(frame.depth[0]));
    EXPECT_TRUE(std::isinf(frame.depth[4 * 8 + 3]));
}

TEST_F(Keep, AddedLayersTakeTheirPlaceAndReplaceOlderOnes)
{
    write_exr(in, {{rgbz()}});
    const std::size_t count = std::size_t(kWidth) * kHeight;
    const std::vector<AddedLayer> layers{{"transmittance", 3, SampleType::kHalf, std::vector<float>(3 * count, 0.5f)},
                                         {"blur_radius", 1, SampleType::kFloat, std::vector<float>(count, 1e30f)}};
    doubled(layers);
    EXPECT_EQ(read_plane(out, "brume.transmittance.G")[5], 0.5);
    EXPECT_EQ(float(read_plane(out, "brume.blur_radius.Y")[5]), 1e30f);
    fs::rename(out, in);
    const std::vector<AddedLayer> again{{"transmittance", 3, SampleType::kFloat, std::vector<float>(3 * count, 0.25f)}};
    doubled(again);
    EXPECT_EQ(read_plane(out, "brume.transmittance.G")[5], 0.25);
    EXPECT_EQ(read_header(out).channels()["brume.transmittance.R"].type, Imf::FLOAT);
    EXPECT_EQ(read_header(out).channels().findChannel("brume.blur_radius.Y"), nullptr) << "it told of the first medium";
}

TEST_F(Keep, LuminanceIsOneChannel)
{
    write_exr(in, {{{{"Y", Imf::FLOAT, [](int x, int) { return x; }}, {"Z", Imf::FLOAT}}}});
    doubled();
    expect_doubled("Y");
}

TEST_F(Keep, NothingIsLeftWhereTheFileCannotBeWritten)
{
    write_exr(in, {{rgbz()}});
    const Frame frame = read();
    EXPECT_THROW(write_frame(frame, {}, folder_ / "no/such/out.exr"), FrameError);
    // The pixels of a part that must be copied are damaged: the copy fails half way.
    TestPart second{rgb("x.")};
    second.name = "x";
    TestPart first{rgbz()};
    first.name = "rgb";
    write_exr(in, {first, second});
    fs::resize_file(in, fs::file_size(in) - 40);
    EXPECT_THROW(doubled({}, {"", "rgb", "", ""}), FrameError);
    for (const auto &entry : fs::directory_iterator(folder_.path()))
        EXPECT_EQ(entry.path(), in) << "left behind";
}

TEST_F(Keep, MutatedFilesWorkOrThrow)
{
    TestPart picture{rgbz()}, deep{{{"Z", Imf::FLOAT, constant(3)}}}, tiled{{{"other", Imf::UINT, constant(7)}}};
    picture.name = "rgb", deep.name = "deep", tiled.name = "tiles";
    deep.deep = tiled.tiled = true;
    write_exr(in, {picture, deep, tiled});
    const std::string whole = read_text(in);
    std::minstd_rand random(7);
    for (int round = 0; round < 600; ++round) {
        std::string bytes = whole;
        // Headers come first; most changes should fall there.
        const std::size_t range = round % 3 ? 1500 : bytes.size();
        for (int i = 0; i <= round % 4; ++i)
            bytes[random() % std::min(range, bytes.size())] = char(random());
        write_text(in, bytes);
        try {
            doubled();
        } catch (const FrameError &) {
        } catch (const RequestError &) {
        }
    }
}

}  // namespace
}  // namespace brume::tests
