#include <cstring>
#include <map>

#include <ImfFloatAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOpaqueAttribute.h>
#include <ImfPreviewImage.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "files.hpp"

// What samples/brume/exr is for. OpenImageIO 2.4.7 loses each of these as it reads a file and writes it again: attributes of
// types that it does not know, preview, line order and the level of DWA; cameraTransform comes back as worldToCamera;
// capDate is added, so that two runs differ; deep beside flat parts, tiled beside scan lines, and mipmaps in a file of
// several parts cannot be written; subsampled channels cannot be opened; integers that name things go through floats; a text
// called Compression changes the compression; and close() reports success with nothing on the disk.

namespace brume::tests {
namespace {

using Attributes = std::map<std::string, std::string>;  ///< name; type and value as they stand in the file

/// By the bytes, which no library has interpreted.
std::vector<Attributes> headers_of(const std::string &file)
{
    std::vector<Attributes> parts(1);
    std::size_t at = 8;
    const auto word = [&] {
        const std::string text(file.c_str() + at);
        at += text.size() + 1;
        return text;
    };
    while (at < file.size()) {
        const std::string name = word();
        if (name.empty()) {
            if (file[at] == '\0')
                return parts;
            parts.emplace_back();
            continue;
        }
        std::string value = word() + '\0';
        std::uint32_t size = 0;
        std::memcpy(&size, file.data() + at, 4);
        parts.back()[name] = value + file.substr(at + 4, size);
        at += 4 + size;
    }
    return parts;
}

class Torture : public testing::Test {
protected:
    Torture()
    {
        write_text(fog_, R"({"brume":1,"medium":{"absorption":[0.1,0.05,0.02]}})");
        TestPart picture{rgbz()}, mipmap{{{"ids", Imf::UINT, [](int x, int y) { return 4e9 + x + 100 * y; }}}},
            deep{{{"Z", Imf::FLOAT, [](int x, int) { return x; }}}}, tiles{{{"matte", Imf::HALF, constant(0.3)}}};
        picture.channels.push_back({"id", Imf::UINT, [](int x, int y) { return 4294967295.0 - x - 100 * y; }});
        picture.channels.push_back({"quarter", Imf::HALF, [](int x, int y) { return x + y; }, 2});
        picture.name = "rgb", mipmap.name = "ids", deep.name = "deep", tiles.name = "tiles";
        mipmap.tiled = deep.deep = tiles.tiled = true;
        picture.edit = [](Imf::Header &h) {
            strange(h);
            h.compression() = Imf::DWAA_COMPRESSION;
            h.lineOrder() = Imf::DECREASING_Y;
            h.insert("dwaCompressionLevel", Imf::FloatAttribute(90));
        };
        mipmap.edit = [](Imf::Header &h) {
            strange(h);
            h.setTileDescription(Imf::TileDescription(8, 8, Imf::MIPMAP_LEVELS));
        };
        deep.edit = tiles.edit = strange;
        write_exr(in_, {picture, mipmap, deep, tiles});
    }
    static void strange(Imf::Header &h)
    {
        Imf::OpaqueAttribute unknown("made-up-type");
        Imf::StdISStream value;
        value.str("\1\2\3\4\5");
        unknown.readValueFrom(value, 5, Imf::EXR_VERSION);
        h.insert("strange", unknown);
        h.insert("Compression", Imf::StringAttribute("none"));
        h.insert("cameraTransform", Imf::M44fAttribute(Imath::M44f(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1)));
        h.setPreviewImage(Imf::PreviewImage(4, 4));
    }
    void run(const fs::path &out) const
    {
        const Result r = brume({"run", fog_.string(), in_.string(), "-o", out.string(), "--backend", "cpu", "--depth-kind",
                                "ray", "--vfov", "50"});
        ASSERT_EQ(r.status, 0) << r.err;
    }

    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", in_ = folder_ / "in.exr", out_ = folder_ / "out.exr";
};

TEST_F(Torture, HeadersAreTheSameBytes)
{
    run(out_);
    const auto before = headers_of(read_text(in_));
    auto after = headers_of(read_text(out_));
    ASSERT_EQ(before.size(), 4u);
    ASSERT_EQ(after.size(), 4u);
    for (std::size_t part = 0; part < before.size(); ++part) {
        Attributes expected = before[part];
        for (const char *name : {"strange", "Compression", "cameraTransform", "preview", "lineOrder", "chunkCount", "type"})
            EXPECT_TRUE(expected.contains(name)) << name << part;
        if (part == 0) {
            expected.erase("preview");  // it shows the picture without fog
            EXPECT_EQ(after[part].erase("brume:provenance"), 1u);
        }
        EXPECT_EQ(after[part], expected) << part;
    }
}

TEST_F(Torture, IntegersSubsampledAndDeepDataAreTheSame)
{
    run(out_);
    for (const auto &[channel, part] : std::vector<std::pair<std::string, int>>{{"id", 0}, {"ids", 1}, {"matte", 3}})
        EXPECT_EQ(read_plane(in_, channel, part), read_plane(out_, channel, part)) << channel;
    EXPECT_EQ(read_plane(out_, "id")[5], 4294967290.0);
    EXPECT_EQ(read_deep(in_, "Z", 2), read_deep(out_, "Z", 2));
    EXPECT_NE(read_plane(in_, "R"), read_plane(out_, "R"));
}

TEST_F(Torture, TwoRunsWriteTheSameBytes)
{
    run(out_);
    ::sleep(1);  // dates have seconds
    run(folder_ / "again.exr");
    EXPECT_TRUE(read_text(out_) == read_text(folder_ / "again.exr"));
}

}  // namespace
}  // namespace brume::tests
