#include <cstring>
#include <map>

#include <gtest/gtest.h>
#include <ImfIntAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <png.h>

#include "files.hpp"
#include "image/frame.hpp"
#include "image/library.hpp"
#include "png_files.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

template <class T> Attribute numbers(std::string name, std::string type, std::vector<T> values)
{
    return {std::move(name), std::move(type), bytes(values), "numbers"};
}

/// No reader looks further than its head. The rest is noise, as libpng refuses what is packed too well.
std::string profile(const std::string &says)
{
    std::string icc(400, '\0');
    std::uint32_t noise = 1;
    for (std::size_t i = 144; i < icc.size(); ++i)
        icc[i] = char((noise = noise * 1664525 + 1013904223) >> 24);
    icc.replace(2, 2, "\x01\x90");
    icc.replace(8, 1, "\4");
    icc.replace(12, 12, "mntrRGB XYZ ");
    icc.replace(24, 12, std::string("\x07\xe4\0\1\0\1\0\0\0\0\0\0", 12));
    icc.replace(36, 4, "acsp");
    icc.replace(68, 12, std::string("\0\0\xf6\xd6\0\1\0\0\0\0\xd3\x2d", 12));
    icc.replace(131, 1, "\1");
    icc.replace(132, 12, std::string("desc\0\0\0\x90\0\0\1\0", 12));
    icc.replace(144, says.size(), says);
    return icc;
}

Attribute icc_attribute(const std::string &says)
{
    return {"ICCProfile", "uint8[400]", profile(says), "a profile"};
}

class PictureMetadata : public testing::Test {
protected:
    PictureMetadata()
    {
        write_text(fog_, R"({"brume":1,"medium":{"absorption":[0.1,0.1,0.1]}})");
        for (int i = 0; i < kCount * 3; ++i) {
            rgb8_.push_back(std::uint8_t(i * 37 % 256));
            rgb16_.push_back(std::uint16_t(i % 1024 << 6 | i % 1024 >> 4));
        }
        write_depth(kWidth, kHeight);
    }
    void write_depth(int width, int height)
    {
        std::vector<std::uint16_t> depth;
        for (int i = 0; i < width * height; ++i)
            depth.push_back(std::uint16_t(1000 + i % width * 10 + i / width));
        write_png(depth_, 1, depth, width, height);
    }
    /// A file as another program would have written it.
    void make(const std::string &name, const std::string &format, Metadata metadata, int bits = 0,
              SampleType type = SampleType::kUint8)
    {
        Raster raster{kWidth, kHeight, {"R", "G", "B"}, type};
        raster.pixels = type == SampleType::kUint16 ? static_cast<const void *>(rgb16_.data()) : rgb8_.data();
        raster.metadata = std::move(metadata);
        raster.bits = bits;
        image_library().write(folder_ / name, name, format, raster);
    }
    Result run(const std::string &input, const std::string &output, std::vector<std::string> more = {})
    {
        std::vector<std::string> words{"run",
                                       fog_.string(),
                                       (folder_ / input).string(),
                                       "-o",
                                       (folder_ / output).string(),
                                       "--backend",
                                       "cpu",
                                       "--depth-kind",
                                       "ray",
                                       "--vfov",
                                       "50",
                                       "--depth",
                                       depth_.string(),
                                       "--depth-scale",
                                       "0.001",
                                       "--input-space",
                                       "sRGB",
                                       "--no-provenance"};
        words.insert(words.end(), more.begin(), more.end());
        Result r = brume(words);
        EXPECT_EQ(r.status, 0) << r.err;
        return r;
    }
    Metadata read(const std::string &name) { return ImageFile(folder_ / name).source().metadata(0); }

    void expect_same(const std::string &a, const std::string &b)
    {
        const Metadata before = read(a), after = read(b);
        EXPECT_FALSE(before.empty());
        for (const Attribute &attribute : before) {
            const Attribute *kept = tool::find(after, attribute.name);
            ASSERT_TRUE(kept) << attribute.name << " is lost from " << b;
            EXPECT_EQ(kept->bytes, attribute.bytes) << attribute.name << " " << attribute.text << " for " << kept->text;
            EXPECT_EQ(kept->type, attribute.type) << attribute.name;
        }
        EXPECT_EQ(before.size(), after.size());
    }

    static constexpr int kCount = kWidth * kHeight;
    Folder folder_;
    const fs::path fog_ = folder_ / "fog.json", depth_ = folder_ / "d.png";
    std::vector<std::uint8_t> rgb8_;
    std::vector<std::uint16_t> rgb16_;
};

const Metadata kPhotograph{text_attribute("ImageDescription", "a street"),
                           text_attribute("Software", "Darkroom 3"),
                           text_attribute("Artist", "Ann"),
                           text_attribute("Copyright", "(c) Ann"),
                           text_attribute("DateTime", "2020:02:03 04:05:06"),
                           numbers<float>("XResolution", "float", {300}),
                           numbers<float>("YResolution", "float", {300}),
                           text_attribute("ResolutionUnit", "in")};

Metadata with(Metadata metadata, const Metadata &more)
{
    metadata.insert(metadata.end(), more.begin(), more.end());
    return metadata;
}

/// Texts, profile and pixels a metre, as libpng has them.
struct PngSays {
    std::map<std::string, std::string> texts;
    std::string profile;
    png_uint_32 x = 0, y = 0;
};

PngSays png_says(const fs::path &path)
{
    PngSays says;
    std::FILE *file = std::fopen(path.c_str(), "rb");
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    png_textp texts = nullptr;
    for (int i = png_get_text(png, info, &texts, nullptr) - 1; i >= 0; --i)
        says.texts[texts[i].key] = texts[i].text;
    png_charp name = nullptr;
    png_bytep data = nullptr;
    png_uint_32 length = 0;
    int method = 0, unit = 0;
    if (png_get_iCCP(png, info, &name, &method, &data, &length))
        says.profile.assign(reinterpret_cast<char *>(data), length);
    png_get_pHYs(png, info, &says.x, &says.y, &unit);
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return says;
}

/// The same file with another orientation.
std::string turned(std::string file, int orientation)
{
    const auto after = [&](const std::string &bytes) {
        const std::size_t at = file.find(bytes);
        EXPECT_NE(at, file.npos);
        return at + bytes.size();
    };
    if (file.starts_with("II") || file.starts_with("\xff\xd8"))  // tag 274, of one short
        file[after(std::string("\x12\x01\x03\x00\x01\x00\x00\x00", 8))] = char(orientation);
    else  // SMPTE 268M has codes of its own
        file[file[0] == 'S' ? 769 : 768] = "\0\0\1\3\2\4\5\7\6"[orientation];
    return file;
}

/// An EXIF block that has an orientation and nothing else.
std::string with_exif(const std::string &jpeg)
{
    const std::string exif("\xff\xe1\0\x22"
                           "Exif\0\0II*\0\x08\0\0\0\1\0\x12\1\3\0\1\0\0\0\1\0\0\0\0\0\0\0",
                           36);
    return jpeg.substr(0, 2) + exif + jpeg.substr(2);
}

TEST_F(PictureMetadata, OfAPngIsKept)
{
    make("a.png", "png", with(kPhotograph, {text_attribute("License", "CC0"), icc_attribute("sRGB")}));
    const Result r = run("a.png", "b.png");
    EXPECT_EQ(r.err.find("does not keep"), std::string::npos) << r.err;
    expect_same("a.png", "b.png");
    const PngSays says = png_says(folder_ / "b.png");
    EXPECT_EQ(says.texts.at("License"), "CC0");
    EXPECT_EQ(says.texts.at("Author"), "Ann");
    EXPECT_EQ(says.texts.at("Software"), "Darkroom 3");
    EXPECT_EQ(says.profile, profile("sRGB"));
    EXPECT_EQ(says.x, 11811u) << "300 a inch";
    EXPECT_EQ(says.y, 11811u);
    run("b.png", "c.png");
    EXPECT_EQ(png_says(folder_ / "c.png").x, 11811u);
}

TEST_F(PictureMetadata, AProfileGoesWhereItsSpaceIsLeft)
{
    make("a.png", "png", {icc_attribute("sRGB"), text_attribute("License", "CC0")});
    run("a.png", "b.png", {"--output-space", "scene_linear"});
    EXPECT_EQ(png_says(folder_ / "b.png").profile, "");
    EXPECT_EQ(png_says(folder_ / "b.png").texts.at("License"), "CC0");
    const Result r = run("a.png", "b.tif", {"--output-type", "half"});
    EXPECT_FALSE(tool::find(read("b.tif"), "ICCProfile"));
    EXPECT_EQ(r.err.find("ICCProfile"), std::string::npos) << "it would be false: " << r.err;
}

TEST_F(PictureMetadata, WhatIsNoProfileStopsNothing)
{
    Attribute broken = icc_attribute("sRGB");
    broken.bytes.replace(36, 4, "none");
    make("a.jpg", "jpeg", with(kPhotograph, {broken}));
    const Result r = run("a.jpg", "b.png");
    EXPECT_EQ(r.err.find("libpng"), std::string::npos) << r.err;
    EXPECT_EQ(png_says(folder_ / "b.png").texts.at("Author"), "Ann");
}

TEST_F(PictureMetadata, OfATiffIsKept)
{
    const Metadata metadata =
        with(kPhotograph, {text_attribute("DocumentName", "street 3"), text_attribute("HostComputer", "host"),
                           text_attribute("Make", "Canon"), text_attribute("Model", "5D"), icc_attribute("sRGB")});
    make("a.tif", "tiff", metadata);
    run("a.tif", "b.tif");
    expect_same("a.tif", "b.tif");
    make("e.tif", "tiff",
         with(metadata, {numbers<float>("FNumber", "float", {2.8f}), text_attribute("Exif:LensModel", "L")}));
    run("e.tif", "f.tif");
    expect_same("e.tif", "f.tif");
    // The header points to the picture and not to what the camera said.
    const std::string tiff = read_text(folder_ / "f.tif");
    std::uint32_t at = 0;
    std::memcpy(&at, tiff.data() + 4, 4);
    EXPECT_EQ(std::uint8_t(tiff[at + 3]), 1) << "the first tag of a picture's directory is 256, its width";
    const ImageFile file(folder_ / "f.tif");
    EXPECT_EQ(file.part(0).width(), kWidth);
    EXPECT_EQ(read_frame(file, resolve_color(file, {}), nullptr).pixels.size(), rgb8_.size());
}

TEST_F(PictureMetadata, OfAJpegIsKept)
{
    make("a.jpg", "jpeg",
         with(kPhotograph, {text_attribute("Make", "Canon"), numbers<float>("FNumber", "float", {2.8f}),
                            numbers<std::int32_t>("Exif:PhotographicSensitivity", "int", {200}),
                            text_attribute("GPS:LatitudeRef", "N"), numbers<float>("GPS:Latitude", "float[3]", {48, 10, 5}),
                            text_attribute("IPTC:City", "Bonn"), icc_attribute("sRGB")}));
    const Result r = run("a.jpg", "b.jpg");
    EXPECT_EQ(r.err.find("does not keep"), std::string::npos) << r.err;
    expect_same("a.jpg", "b.jpg");
    EXPECT_NE(read_text(folder_ / "b.jpg").find("Exif"), std::string::npos);
}

TEST_F(PictureMetadata, OfADpxIsKeptWithItsTimecodeAndItsTenBits)
{
    make("a.dpx", "dpx",
         {text_attribute("Software", "Scanner 2"), text_attribute("Copyright", "(c) Ann"),
          text_attribute("DateTime", "2020:02:03 04:05:06"), text_attribute("DocumentName", "project"),
          numbers<std::uint32_t>("smpte:TimeCode", "timecode", {0x01020304, 7}),
          numbers<std::int32_t>("smpte:KeyCode", "keycode", {1, 2, 3, 4, 5, 4, 64}),
          numbers<std::uint32_t>("dpx:FramePosition", "uint", {7}), numbers<float>("dpx:FrameRate", "float", {24}),
          numbers<float>("dpx:TemporalFrameRate", "float", {25}), text_attribute("dpx:SlateInfo", "slate 3"),
          text_attribute("dpx:InputDevice", "Arri"), text_attribute("dpx:SourceDateTime", "2019:01:01 00:00:00"),
          text_attribute("dpx:Transfer", "Printing density")},
         10, SampleType::kUint16);
    const Result r = run("a.dpx", "b.dpx");
    EXPECT_EQ(r.err.find("does not keep"), std::string::npos) << r.err;
    expect_same("a.dpx", "b.dpx");
    const std::string dpx = read_text(folder_ / "b.dpx");
    EXPECT_EQ(dpx[803], 10) << "bits of a sample";
    EXPECT_EQ(dpx.substr(1920, 4), dpx[0] == 'S' ? std::string("\1\2\3\4") : std::string("\4\3\2\1")) << "timecode";
    write_text(fog_, kClear);
    run("a.dpx", "same.dpx");
    const ImageFile before(folder_ / "a.dpx"), after(folder_ / "same.dpx");
    EXPECT_EQ(read_frame(after, resolve_color(after, {}), nullptr).pixels,
              read_frame(before, resolve_color(before, {}), nullptr).pixels);
}

TEST_F(PictureMetadata, WhatAFormatHasNoPlaceForIsSaidOnce)
{
    make("a.jpg", "jpeg", with(kPhotograph, {text_attribute("Make", "Canon")}));
    const Result dpx = run("a.jpg", "o.dpx");
    EXPECT_NE(dpx.err.find("dpx does not keep what the picture says of itself: Artist, Make, XResolution"),
              std::string::npos)
        << dpx.err;
    const Result npy = run("a.jpg", "o.npy");
    EXPECT_NE(npy.err.find("npy does not keep"), std::string::npos) << npy.err;
    EXPECT_NE(npy.err.find("Copyright"), std::string::npos) << npy.err;
    make("plain.png", "png", {});
    EXPECT_EQ(run("plain.png", "o.npy").err.find("does not keep"), std::string::npos);
}

TEST_F(PictureMetadata, ANameThatAWriterTakesForItsOwnChangesNothing)
{
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &header) {
        header.insert("Compression", Imf::StringAttribute("none"));
        header.insert("tiff:half", Imf::StringAttribute("no"));
        header.insert("Orientation", Imf::IntAttribute(6));
    };
    write_exr(folder_ / "a.exr", {part});
    for (const char *text : {"", "plain"}) {
        const std::string name = std::string(text) + ".tif";
        if (*text)
            write_exr(folder_ / "a.exr", {{rgbz()}});
        const Result r = brume({"run", fog_.string(), (folder_ / "a.exr").string(), "-o", (folder_ / ("o" + name)).string(),
                                "--backend", "cpu", "--depth-kind", "ray", "--vfov", "50", "--no-provenance"});
        ASSERT_EQ(r.status, 0) << r.err;
    }
    EXPECT_TRUE(read_text(folder_ / "o.tif") == read_text(folder_ / "oplain.tif"));
}

TEST_F(PictureMetadata, GoesIntoAnExrUnderItsNamesThere)
{
    make("a.jpg", "jpeg",
         with(kPhotograph,
              {text_attribute("Make", "Canon"), numbers<float>("FNumber", "float", {2.8f}), icc_attribute("sRGB")}));
    run("a.jpg", "o.exr");
    const Imf::Header header = read_header(folder_ / "o.exr");
    EXPECT_EQ(Imf::owner(header), "(c) Ann");
    EXPECT_EQ(Imf::comments(header), "a street");
    EXPECT_EQ(Imf::capDate(header), "2020:02:03 04:05:06");
    EXPECT_EQ(Imf::xDensity(header), 300);
    EXPECT_NEAR(Imf::aperture(header), 2.8, 1e-4);
    EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("Make").value(), "Canon");
    EXPECT_EQ(header.find("ICCProfile"), header.end());
    make("a.dpx", "dpx", {numbers<std::uint32_t>("smpte:TimeCode", "timecode", {0x01020304, 0})});
    run("a.dpx", "t.exr");
    EXPECT_EQ(Imf::timeCode(read_header(folder_ / "t.exr")).hours(), 1);
    EXPECT_EQ(Imf::timeCode(read_header(folder_ / "t.exr")).frame(), 4);
}

TEST_F(PictureMetadata, NamesThatMeanSomethingElseInAnExrDoNoHarm)
{
    make("a.png", "png",
         {text_attribute("compression", "rle"), text_attribute("channels", "x"), text_attribute("owner", "me"),
          text_attribute("timeCode", "noon"), text_attribute("type", "deepscanline"), text_attribute("dataWindow", "0 0"),
          text_attribute("Compression", "huge")});
    run("a.png", "o.exr");
    const Imf::Header header = read_header(folder_ / "o.exr");
    EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
    EXPECT_FALSE(header.hasType() && header.type() == "deepscanline");
    EXPECT_EQ(Imf::owner(header), "me");
    EXPECT_EQ(header.find("timeCode"), header.end());
}

TEST_F(PictureMetadata, OfAnExrGoesIntoWhatHasAPlaceForIt)
{
    TestPart part{rgbz()};
    part.edit = [](Imf::Header &header) {
        Imf::addOwner(header, "Ann");
        Imf::addComments(header, "a render");
        Imf::addXDensity(header, 72);
        Imf::addTimeCode(header, Imf::TimeCode(1, 2, 3, 4));
        Imf::addFramesPerSecond(header, Imf::Rational(24, 1));
        header.insert("renderer", Imf::StringAttribute("R 9"));
    };
    write_exr(folder_ / "a.exr", {part});
    const auto convert = [&](const char *output) {
        const Result r = brume({"run", fog_.string(), (folder_ / "a.exr").string(), "-o", (folder_ / output).string(),
                                "--backend", "cpu", "--depth-kind", "ray", "--vfov", "50", "--output-space", "sRGB"});
        EXPECT_EQ(r.status, 0) << r.err;
        return r.err;
    };
    const std::string png = convert("o.png");
    const PngSays says = png_says(folder_ / "o.png");
    EXPECT_EQ(says.texts.at("Copyright"), "Ann");
    EXPECT_EQ(says.texts.at("Description"), "a render");
    EXPECT_EQ(says.texts.at("renderer"), "R 9");
    EXPECT_EQ(says.x, 2835u);
    EXPECT_NE(png.find("does not keep what the picture says of itself: "), std::string::npos) << png;
    EXPECT_NE(png.find("smpte:TimeCode"), std::string::npos) << png;
    EXPECT_EQ(png.find("chromaticities"), std::string::npos) << png;
    convert("o.dpx");
    EXPECT_EQ(tool::find(read("o.dpx"), "smpte:TimeCode")->text, "01:02:03:04");
}

TEST_F(PictureMetadata, TurnedPicturesAreReadUprightAndSayNoOrientationAfterwards)
{
    for (const std::string name : {"a.jpg", "a.tif", "a.dpx"}) {
        const std::string format = name == "a.jpg" ? "jpeg" : name == "a.tif" ? "tiff" : "dpx";
        make(name, format, {});
        if (format == "jpeg")
            write_text(folder_ / name, with_exif(read_text(folder_ / name)));
        const ImageFile stored(folder_ / name);
        const auto plain = read_frame(stored, resolve_color(stored, {}), nullptr).pixels;
        for (const int orientation : {2, 3, 4, 5, 6, 7, 8}) {
            write_text(folder_ / name, turned(read_text(folder_ / name), orientation));
            const ImageFile file(folder_ / name);
            ASSERT_EQ(file.source().orientation, orientation) << name;
            const Frame frame = read_frame(file, resolve_color(file, {}), nullptr);
            ASSERT_EQ(frame.width, orientation >= 5 ? kHeight : kWidth) << name << orientation;
            const int right = kWidth - 1, bottom = kCount - kWidth;
            const int corners[] = {0, 0, right, bottom + right, bottom, 0, bottom, bottom + right, right};
            const int nexts[] = {0, 1, -1, -1, 1, kWidth, -kWidth, -kWidth, kWidth};
            for (int i = 0; i < 3; ++i)
                EXPECT_EQ(frame.pixels[std::size_t(3 * i)],
                          plain[std::size_t(3 * (corners[orientation] + i * nexts[orientation]))])
                    << name << orientation << " at " << i;
            write_depth(frame.width, frame.height);
            const Result r = run(name, "b.tif");
            EXPECT_NE(r.err.find("upright by its orientation"), std::string::npos) << r.err;
            const ImageFile out(folder_ / "b.tif");
            EXPECT_EQ(out.source().orientation, 1);
            EXPECT_EQ(out.part(0).width(), frame.width);
            const auto fogged = read_frame(out, resolve_color(out, {}), nullptr).pixels;
            for (std::size_t i = 0; i < fogged.size(); ++i)
                ASSERT_NEAR(fogged[i], frame.pixels[i], 0.1) << i;
        }
    }
}

TEST_F(PictureMetadata, DensitiesAreThePixelsAspectAndTurnWithThePicture)
{
    for (const char *name : {"a.png", "a.jpg", "a.tif"}) {
        Raster raster{kWidth, kHeight, {"R", "G", "B"}, SampleType::kUint8, rgb8_.data()};
        raster.pixel_aspect = 2;
        raster.metadata = {numbers<float>("XResolution", "float", {100}), numbers<float>("YResolution", "float", {200}),
                           text_attribute("ResolutionUnit", "in")};
        const std::string format = std::string(name).substr(2);
        image_library().write(folder_ / name, name, format == "jpg" ? "jpeg" : format == "tif" ? "tiff" : "png", raster);
        EXPECT_NEAR(ImageFile(folder_ / name).part(0).pixel_aspect, 2, 1e-3) << name;
        for (const char *output : {"b.png", "b.jpg", "b.tif", "b.exr"}) {
            run(name, output);
            EXPECT_NEAR(ImageFile(folder_ / output).part(0).pixel_aspect, 2, 1e-3) << name << " to " << output;
        }
    }
    write_text(folder_ / "t.tif", turned(read_text(folder_ / "a.tif"), 6));
    EXPECT_NEAR(ImageFile(folder_ / "t.tif").part(0).pixel_aspect, 0.5, 1e-3);
}

TEST_F(PictureMetadata, ProvenanceIsSaidWhereThereIsAPlaceAndReplacesAnOlderOne)
{
    make("a.png", "png", kPhotograph);
    for (const char *name : {"o.png", "o.tif", "o.jpg", "o.dpx"}) {
        const auto fog = [&](const std::string &input, const std::string &output, const std::string &set) {
            const Result r = brume({"run", fog_.string(), (folder_ / input).string(), "-o", (folder_ / output).string(),
                                    "--backend", "cpu", "--depth-kind", "ray", "--vfov", "50", "--depth", depth_.string(),
                                    "--depth-scale", "0.001", "--input-space", "sRGB", "--set", set});
            ASSERT_EQ(r.status, 0) << r.err;
        };
        fog("a.png", name, "multiscatter.kernel=paper");
        const std::string first = provenance_in(read(name));
        EXPECT_EQ(first.find("brume "), 0u) << name;
        const std::string again = std::string("again") + (name + 1);
        fog(name, again, "multiscatter.kernel=calibrated");
        EXPECT_NE(provenance_in(read(again)), first);
        const std::string software = tool::find(read(again), "Software")->bytes;
        EXPECT_EQ(software.find("Darkroom 3"), 0u) << software;
        EXPECT_EQ(software.find("brume", software.find("brume") + 1), std::string::npos) << software;
        const Result r = brume({"compare", (folder_ / again).string(), (folder_ / name).string(), "--header"});
        EXPECT_NE(r.out.find("made otherwise"), std::string::npos) << r.out << r.err;
    }
}

TEST_F(PictureMetadata, CompareSaysWhatDiffersBesideThePixels)
{
    make("a.png", "png", kPhotograph);
    Metadata other = kPhotograph;
    other[2] = text_attribute("Artist", "Bob");
    other.push_back(text_attribute("License", "CC0"));
    make("b.png", "png", other);
    const Result r = brume({"compare", (folder_ / "b.png").string(), (folder_ / "a.png").string(), "--header"});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.out.find("attribute 'Artist' is \"Bob\", was \"Ann\""), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("attribute 'License' added: \"CC0\""), std::string::npos) << r.out;
}

}  // namespace
}  // namespace brume::tests
