#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "files.hpp"
#include "image/library.hpp"
#include "png_files.hpp"

namespace brume::tests {
namespace {

using namespace brume::tool;

class PictureFaults : public testing::Test {
protected:
    PictureFaults()
    {
        write_text(clear_, kClear);
        write_png(folder_ / "c.png", 3, std::vector<std::uint8_t>(3 * kWidth * kHeight, 90));
        write_png(folder_ / "d.png", 1, std::vector<std::uint16_t>(kWidth * kHeight, 500));
    }
    Result run(const std::string &colour, const std::string &depth) const
    {
        return brume({"run", clear_.string(), (folder_ / colour).string(), "-o", (folder_ / "out.png").string(), "--backend",
                      "cpu", "--depth", (folder_ / depth).string(), "--depth-scale", "0.01", "--vfov", "50"});
    }
    void expect_failed(const std::string &colour, const std::string &depth, std::vector<std::string> said) const
    {
        const Result r = run(colour, depth);
        EXPECT_TRUE(r.status == 1 || r.status == 2) << colour << " " << depth << ": " << r.status << " " << r.err;
        for (const std::string &word : said)
            EXPECT_NE(r.err.find(word), std::string::npos) << r.err << "\nlacks " << word;
        EXPECT_FALSE(fs::exists(folder_ / "out.png"));
    }
    void cut(const std::string &from, const std::string &to, double share) const
    {
        const std::string text = read_text(folder_ / from);
        write_text(folder_ / to, text.substr(0, std::size_t(double(text.size()) * share)));
    }

    Folder folder_;
    const fs::path clear_ = folder_ / "clear.json";
};

TEST_F(PictureFaults, ThePicturesThatAreMadeHereWork)
{
    const Result r = run("c.png", "d.png");
    EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(PictureFaults, CutFiles)
{
    std::vector<std::uint8_t> noise;
    for (std::uint32_t i = 0, h = 1; i < 3 * kWidth * kHeight; ++i)
        noise.push_back(std::uint8_t((h = h * 1664525 + 1013904223) >> 24));
    write_png(folder_ / "n.png", 3, noise);
    const Raster raster{kWidth, kHeight, {"R", "G", "B"}, SampleType::kUint8, noise.data()};
    image_library().write(folder_ / "n.jpg", "n.jpg", "jpeg", raster);
    image_library().write(folder_ / "n.tif", "n.tif", "tiff", raster);
    for (const char *ending : {".png", ".jpg", ".tif"})
        for (const double share : {0.0, 0.01, 0.5, 0.9}) {
            const std::string name = std::string("cut") + ending;
            cut(std::string("n") + ending, name, share);
            expect_failed(name, "d.png", {name});
        }
    std::string damaged = read_text(folder_ / "n.png");
    damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 0x55);
    write_text(folder_ / "damaged.png", damaged);
    expect_failed("damaged.png", "d.png", {"damaged.png"});
}

TEST_F(PictureFaults, ClaimsThatTheFileCannotHold)
{
    // A PNG header that claims 16384 x 16384 pixels before the data of a small one, with its checksum made right.
    std::string png = read_text(folder_ / "c.png");
    const auto put = [&](std::size_t at, std::uint32_t v) {
        for (int i = 0; i < 4; ++i)
            png[at + std::size_t(i)] = char(v >> (24 - 8 * i));
    };
    put(16, 16384);
    put(20, 16384);
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = 12; i < 29; ++i) {
        crc ^= (unsigned char)png[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    put(29, ~crc);
    write_text(folder_ / "claim.png", png);
    expect_failed("claim.png", "d.png", {"claim.png", "16384 x 16384", "bytes"});
    write_text(folder_ / "claim.pfm", "Pf\n60000 60000\n-1.0\n1234");
    expect_failed("c.png", "claim.pfm", {"claim.pfm", "60000 x 60000"});
    write_npy(folder_ / "claim.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (4000000000, 4000000000), }", "");
    expect_failed("c.png", "claim.npy", {"claim.npy", "4000000000 x 4000000000"});
}

TEST_F(PictureFaults, DepthThatIsNoneOfThePicture)
{
    write_png(folder_ / "small.png", 1, std::vector<std::uint16_t>(16 * 12, 500), 16, 12);
    expect_failed("c.png", "small.png", {"small.png", "16 x 12", "32 x 24"});
    expect_failed("c.png", "c.png", {"c.png", "no depth"});
    expect_failed("c.png", "none.png", {"none.png", "no such file"});
    const std::vector<float> nan(kWidth * kHeight, NAN);
    write_npy(folder_ / "nan.npy", "{'descr': '<f4', 'fortran_order': False, 'shape': (24, 32), }", bytes(nan));
    const Result r = run("c.png", "nan.npy");
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.err.find("768 pixels have NaN depth and count as far"), std::string::npos) << r.err;
}

TEST_F(PictureFaults, ArraysOfOtherKinds)
{
    const auto npy = [&](const std::string &header, std::vector<std::string> said) {
        write_npy(folder_ / "bad.npy", header, std::string(32 * 24 * 16, 'x'));
        said.push_back("bad.npy");
        expect_failed("c.png", "bad.npy", said);
    };
    npy("{'descr': '<c8', 'fortran_order': False, 'shape': (24, 32), }", {"<c8", "expected f2"});
    npy("{'descr': '|O', 'fortran_order': False, 'shape': (24, 32), }", {"|O"});
    npy("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (24, 32), }", {"numbers of type"});
    npy("{'descr': '<f4', 'fortran_order': False, 'shape': (768,), }", {"(768,)", "expected height, width"});
    npy("{'descr': '<f4', 'fortran_order': False, 'shape': (24, 32, 2), }", {"2 channels"});
    npy("{'descr': '<f4', 'fortran_order': False, 'shape': (-24, 32), }", {"-24"});
    npy("{'descr': '<f4', 'fortran_order': False}", {"'shape'"});
    for (const char *text : {"", "P6\n32 24\n255\n", "Pf\n", "Pf\n32\n", "Pf\n32 24\n0\n", "Pf\n32 24\nnan\n",
                             "Pf\n-32 24\n-1\n", "Pf\n32 24\n-1.0\nshort"}) {
        write_text(folder_ / "bad.pfm", text);
        expect_failed("c.png", "bad.pfm", {"bad.pfm"});
    }
    write_text(folder_ / "bad.npy", "\x93NUMPY");
    expect_failed("c.png", "bad.npy", {"bad.npy"});
}

TEST_F(PictureFaults, NamesDecideAndContentsDoNot)
{
    write_text(folder_ / "video.png", read_text(folder_ / "clear.json"));
    expect_failed("video.png", "d.png", {"video.png", "png"});
    write_text(folder_ / "c.gif", "GIF89a");
    expect_failed("c.gif", "d.png", {"c.gif"});
}

TEST_F(PictureFaults, CmykAndOrientationsThatAreNoneAreRefused)
{
    const std::vector<std::uint8_t> pixels(4 * kWidth * kHeight, 100);
    const Raster raster{kWidth, kHeight, {"R", "G", "B", "A"}, SampleType::kUint8, pixels.data()};
    image_library().write(folder_ / "k.tif", "k.tif", "tiff", raster);
    std::string tiff = read_text(folder_ / "k.tif");
    // Entries are tag, type, count, value: 262 is the photometric interpretation, 5 is CMYK; 274 the orientation.
    const auto patch = [&](std::string text, std::uint16_t tag, std::uint16_t value) {
        const std::string entry{char(tag & 255), char(tag >> 8), 3, 0, 1, 0, 0, 0};
        const auto at = text.find(entry);
        EXPECT_NE(at, std::string::npos);
        text[at + 8] = char(value);
        return text;
    };
    write_text(folder_ / "cmyk.tif", patch(tiff, 262, 5));
    expect_failed("cmyk.tif", "d.png", {"cmyk.tif", "CMYK (expected RGB or grey)"});
    const Raster rgb{kWidth, kHeight, {"R", "G", "B"}, SampleType::kUint8, pixels.data()};
    image_library().write(folder_ / "turned.jpg", "turned.jpg", "jpeg", rgb);
    const std::string jpeg = read_text(folder_ / "turned.jpg");
    const std::string exif("\xff\xe1\0\x22"
                           "Exif\0\0II*\0\x08\0\0\0\1\0\x12\1\3\0\1\0\0\0\x09\0\0\0\0\0\0\0",
                           36);
    write_text(folder_ / "turned.jpg", jpeg.substr(0, 2) + exif + jpeg.substr(2));
    expect_failed("turned.jpg", "d.png", {"turned.jpg", "orientation 9 (expected 1 to 8)"});
}

TEST_F(PictureFaults, ADiskThatTakesNoMoreIsAnErrorAndLeavesNothing)
{
    std::vector<std::uint8_t> noise;
    for (std::uint32_t i = 0, h = 1; i < 3 * 128 * 96; ++i)
        noise.push_back(std::uint8_t((h = h * 1664525 + 1013904223) >> 24));
    write_png(folder_ / "n.png", 3, noise, 128, 96);
    write_png(folder_ / "z.png", 1, std::vector<std::uint16_t>(128 * 96, 500), 128, 96);
    fs::create_directory(folder_ / "out");
    for (const char *ending : {"png", "jpg", "tif", "dpx", "hdr", "pfm", "npy", "exr"}) {
        // A file may have 8 blocks, of 512 or 1024 bytes; what is ignored here is ignored there.
        const std::string command = "trap '' XFSZ; ulimit -f 8; exec '" BRUME_TOOL "' run '" + clear_.string() + "' '" +
                                    (folder_ / "n.png").string() + "' -o '" + (folder_ / "out" / "o.").string() + ending +
                                    "' --backend cpu --depth '" + (folder_ / "z.png").string() +
                                    "' --depth-scale 0.01 --vfov 50 2>/dev/null";
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << ending << " " << status;
        EXPECT_TRUE(fs::is_empty(folder_ / "out")) << ending;
    }
}

}  // namespace
}  // namespace brume::tests
