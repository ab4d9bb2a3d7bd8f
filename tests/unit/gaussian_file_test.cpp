// Media of Gaussians as files: what is read, what is refused and in which words, and that nothing is lost.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.h"
#include "gaussians/gaussian_file.h"
#include "gaussians/gaussian_formats.h"

namespace brume {
namespace {

namespace fs = std::filesystem;

class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / ("brume-gaussians-" + std::to_string(::getpid())))
    {
        fs::create_directory(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    std::string operator/(const std::string &name) const { return (path_ / name).string(); }
    const fs::path &path() const { return path_; }

private:
    fs::path path_;
};

template <class Call> std::string failure(Call call)
{
    try {
        call();
    } catch (const Error &error) {
        EXPECT_EQ(error.status(), BRUME_ERROR_SCENE) << error.what();
        return error.what();
    }
    return "accepted";
}

std::string csv_failure(const std::string &text)
{
    return failure([&] { parse_gaussian_csv(text, "puffs.csv"); });
}

std::string ply_failure(const std::string &text)
{
    return failure([&] { parse_gaussian_ply(text, "puffs.ply"); });
}

std::vector<Gaussian> some_gaussians(size_t count)
{
    std::mt19937_64 random(7);
    auto value = [&](double from, double to) { return from + (to - from) * double(random() >> 11) * 0x1p-53; };
    std::vector<Gaussian> gaussians(count);
    for (Gaussian &gaussian : gaussians)
        gaussian = {{value(-1e3, 1e3), value(-1e-3, 1e-3), value(-1e9, 1e9)},
                    value(1e-3, 10),
                    value(0, 5),
                    {float(value(0, 1)), float(value(0, 1)), float(value(0, 1))}};
    return gaussians;
}

void expect_same(const std::vector<Gaussian> &a, const std::vector<Gaussian> &b)
{
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].center, b[i].center) << i;
        EXPECT_EQ(a[i].scale, b[i].scale) << i;
        EXPECT_EQ(a[i].amplitude, b[i].amplitude) << i;
        EXPECT_EQ(a[i].color, b[i].color) << i;
    }
}

template <class T> void append(std::string &bytes, T value)
{
    bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
}

TEST(GaussianFile, ComesBackBitForBit)
{
    const Folder folder;
    const auto gaussians = some_gaussians(1000);
    for (const char *name : {"a.csv", "a.ply", "A.PLY"}) {
        write_gaussians(folder / name, gaussians);
        expect_same(read_gaussians(folder / name), gaussians);
    }
    write_gaussians(folder / "a.csv", {});
    EXPECT_TRUE(read_gaussians(folder / "a.csv").empty());
    write_gaussians(folder / "a.ply", {});
    EXPECT_TRUE(read_gaussians(folder / "a.ply").empty());
    // Nothing is left beside the files.
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3);
}

TEST(GaussianFile, RefusesWhatIsNoFile)
{
    const Folder folder;
    EXPECT_NE(failure([&] { read_gaussians(folder / "none.csv"); }).find("none.csv: cannot be read"), std::string::npos);
    EXPECT_NE(failure([&] { read_gaussians(folder / "puffs.vdb"); }).find("\".vdb\"; expected .csv or .ply"),
              std::string::npos);
    fs::create_directory(folder / "folder.csv");
    EXPECT_NE(failure([&] { read_gaussians(folder / "folder.csv"); }).find("not a file"), std::string::npos);
    fs::create_symlink("/dev/zero", folder / "endless.ply");
    EXPECT_NE(failure([&] { read_gaussians(folder / "endless.ply"); }).find("not a file"), std::string::npos);
    std::ofstream(folder / "large.csv").close();
    fs::resize_file(folder / "large.csv", uintmax_t(1) << 40);
    EXPECT_NE(failure([&] { read_gaussians(folder / "large.csv"); }).find("1099511627776 bytes; expected"),
              std::string::npos);
    EXPECT_THROW(write_gaussians(folder / "none/puffs.csv", {}), Error);
}

TEST(GaussianCsv, ReadsWhatPeopleWrite)
{
    const auto gaussians = parse_gaussian_csv("\xef\xbb\xbf# a cache\r\n"
                                              " \"y\" , x,z,id,radius , density,r,g,b\r\n"
                                              "\r\n"
                                              "2, +1 ,3e0,whatever,0.5,.25,0,0.5,1 # a puff\r\n"
                                              "5,4,6,,2,1,1,1,1",
                                              "puffs.csv");
    ASSERT_EQ(gaussians.size(), 2u);
    EXPECT_EQ(gaussians[0].center, (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ(gaussians[0].scale, 2);
    EXPECT_EQ(gaussians[0].amplitude, 0.25);
    EXPECT_EQ(gaussians[0].color, (std::array<float, 3>{0, 0.5f, 1}));
    EXPECT_EQ(gaussians[1].center, (std::array<double, 3>{4, 5, 6}));
    EXPECT_EQ(gaussians[1].scale, 0.5);
    const auto plain = parse_gaussian_csv("x,y,z,scale,amplitude\n1,2,3,4,5\n", "puffs.csv");
    ASSERT_EQ(plain.size(), 1u);
    EXPECT_EQ(plain[0].scale, 4);
    EXPECT_EQ(plain[0].color, (std::array<float, 3>{1, 1, 1}));
}

TEST(GaussianCsv, SaysWhatIsWrongAndWhere)
{
    const std::string header = "x,y,z,scale,amplitude\n";
    EXPECT_EQ(csv_failure(""), "puffs.csv: empty; expected a line that names the columns");
    EXPECT_EQ(
        csv_failure("x,y,z,scale\n"),
        "puffs.csv:1: columns \"x\", \"y\", \"z\", \"scale\"; expected x, y, z, amplitude, and one of scale and radius");
    EXPECT_NE(csv_failure("x,y,z,scale,radius,amplitude\n").find("one of scale and radius"), std::string::npos);
    EXPECT_NE(csv_failure("x,y,z,scale,amplitude,r,g\n").find("expected r, g and b, or none"), std::string::npos);
    EXPECT_EQ(csv_failure("x,y,z,scale,x,amplitude\n"), "puffs.csv:1: column \"x\" is there twice");
    EXPECT_EQ(csv_failure("x;y;z;scale;amplitude\n").substr(0, 45), "puffs.csv:1: columns \"x;y;z;scale;amplitude\";");
    EXPECT_EQ(csv_failure(header + "1,2,3,4\n"), "puffs.csv:2: 4 values; expected 5, one for each column");
    EXPECT_EQ(csv_failure(header + "\n1,2,3,4,5,6\n"), "puffs.csv:3: 6 values; expected 5, one for each column");
    EXPECT_EQ(csv_failure(header + "1,2,3,4,5\n1,two,3,4,5\n"), "puffs.csv:3: y: \"two\"; expected a number");
    EXPECT_EQ(csv_failure(header + "1,2,3,,5\n"), "puffs.csv:2: scale: \"\"; expected a number");
    EXPECT_EQ(csv_failure(header + "1,2,3,0,5\n"), "puffs.csv:2: scale: 0; expected a number from 1e-30 to 1e+30");
    EXPECT_EQ(csv_failure(header + "1,2,3,4,-5\n"), "puffs.csv:2: amplitude: -5; expected a number from 0 to 1e+30");
    EXPECT_NE(csv_failure(header + "nan,2,3,4,5\n").find("puffs.csv:2: x: nan; expected"), std::string::npos);
    EXPECT_NE(csv_failure(header + "1,2,inf,4,5\n").find("puffs.csv:2: z: inf; expected"), std::string::npos);
    EXPECT_NE(csv_failure("x,y,z,scale,amplitude,r,g,b\n1,2,3,4,5,255,0,0\n").find("puffs.csv:2: r: 255; expected"),
              std::string::npos);
    std::string many = header;
    for (size_t i = 0; i <= BRUME_MAX_GAUSSIANS; ++i)
        many += "1,2,3,4,5\n";
    EXPECT_NE(csv_failure(many).find("expected 1000000 Gaussians at most"), std::string::npos);
}

TEST(GaussianPly, ReadsOtherProgramsFiles)
{
    const auto text = parse_gaussian_ply("ply\r\nformat ascii 1.0\r\ncomment by hand\r\n"
                                         "element face 2\r\nproperty list uchar int vertex_indices\r\n"
                                         "element vertex 2\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
                                         "property list uchar float extra\r\nproperty float radius\r\n"
                                         "property float density\r\nproperty uchar red\r\nproperty uchar green\r\n"
                                         "property uchar blue\r\nend_header\r\n"
                                         "3 0 1 2\r\n0\r\n"
                                         "1 2 3 2 .5 .5 0.5 7 255 0 51\r\n4 5 6 0 2 1 0 0 0\r\n",
                                         "puffs.ply");
    ASSERT_EQ(text.size(), 2u);
    EXPECT_EQ(text[0].center, (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ(text[0].scale, 2);
    EXPECT_EQ(text[0].amplitude, 7);
    EXPECT_EQ(text[0].color, (std::array<float, 3>{1, 0, 0.2f}));
    EXPECT_EQ(text[1].scale, 0.5);

    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
                        "element vertex 1\nproperty float z\nproperty double y\nproperty short x\nproperty float nx\n"
                        "property list ushort uchar extra\nproperty float scale\nproperty float amplitude\nend_header\n";
    append<uint8_t>(bytes, 3);
    for (int i = 0; i < 3; ++i)
        append<int32_t>(bytes, i);
    append<float>(bytes, 3);
    append<double>(bytes, 2);
    append<int16_t>(bytes, -1);
    append<float>(bytes, 99);
    append<uint16_t>(bytes, 2);
    append<uint16_t>(bytes, 0);
    append<float>(bytes, 4);
    append<float>(bytes, 5);
    const auto binary = parse_gaussian_ply(bytes, "puffs.ply");
    ASSERT_EQ(binary.size(), 1u);
    EXPECT_EQ(binary[0].center, (std::array<double, 3>{-1, 2, 3}));
    EXPECT_EQ(binary[0].scale, 4);
    EXPECT_EQ(binary[0].amplitude, 5);
    EXPECT_EQ(ply_failure(bytes.substr(0, bytes.size() - 1)), "puffs.ply: the file ends within its elements");
}

TEST(GaussianPly, SaysWhatIsWrongAndWhere)
{
    const std::string properties = "property float x\nproperty float y\nproperty float z\nproperty float scale\n"
                                   "property float amplitude\n";
    const std::string ascii = "ply\nformat ascii 1.0\n";
    const std::string binary = "ply\nformat binary_little_endian 1.0\n";
    EXPECT_NE(ply_failure("x,y,z,scale,amplitude\n").find("puffs.ply:1: not a PLY file"), std::string::npos);
    EXPECT_NE(ply_failure("").find("puffs.ply:0: a header without"), std::string::npos);
    EXPECT_NE(ply_failure("ply\nformat binary_big_endian 1.0\nend_header\n").find("puffs.ply:2: \"format binary_big_endian"),
              std::string::npos);
    EXPECT_EQ(ply_failure(ascii + "end_header\n"), "puffs.ply: no element \"vertex\"");
    EXPECT_NE(ply_failure(ascii + "element vertex -1\n").find("puffs.ply:3: \"element vertex -1\"; expected a count"),
              std::string::npos);
    EXPECT_NE(ply_failure(ascii + "property float x\n").find("puffs.ply:3:"), std::string::npos);
    EXPECT_NE(ply_failure(ascii + "element vertex 1\nproperty quad x\n").find("puffs.ply:4: \"property quad x\""),
              std::string::npos);
    EXPECT_NE(ply_failure(ascii + "element vertex 1\n" + properties).find("without \"end_header\""), std::string::npos);
    EXPECT_NE(ply_failure(ascii + "element vertex 1\nproperty float x\nend_header\n1\n").find("expected x, y, z, amplitude"),
              std::string::npos);
    const std::string one = ascii + "element vertex 2\n" + properties + "end_header\n1 2 3 4 5\n";
    EXPECT_EQ(ply_failure(one), "puffs.ply:11: the file ends within its elements");
    EXPECT_EQ(ply_failure(one + "1 2 3 four 5\n"), "puffs.ply:11: \"four\"; expected a number");
    EXPECT_EQ(ply_failure(one + "1 2 3 -4 5\n"), "puffs.ply:11: scale: -4; expected a number from 1e-30 to 1e+30");

    // Counts that no file could hold: refused, not allocated and not counted down.
    EXPECT_NE(ply_failure(binary + "element vertex 18446744073709551615\n" + properties + "end_header\n")
                  .find("18446744073709551615 vertices; expected 1000000 at most"),
              std::string::npos);
    EXPECT_NE(ply_failure(binary + "element vertex 1000000\n" + properties + "end_header\n").find("ends within"),
              std::string::npos);
    EXPECT_NE(ply_failure(binary + "element empty 18446744073709551615\nelement vertex 1\n" + properties + "end_header\n")
                  .find("ends within"),
              std::string::npos);
    EXPECT_NE(ply_failure(ascii + "element face 1\nproperty list uint char i\nelement vertex 1\n" + properties +
                          "end_header\n4294967295 1\n")
                  .find("puffs.ply:12: a list of 4294967295 values"),
              std::string::npos);
    std::string nan = binary + "element vertex 1\n" + properties + "end_header\n";
    for (float value : {1.0f, 2.0f, 3.0f, 4.0f, std::nanf("")})
        append(nan, value);
    EXPECT_EQ(ply_failure(nan), "puffs.ply: vertex 0: amplitude: nan; expected a number from 0 to 1e+30");
}

// Damaged files end in a message or in Gaussians that are in range.
TEST(GaussianFile, SurvivesDamage)
{
    const auto gaussians = some_gaussians(4);
    std::mt19937_64 random(3);
    size_t accepted = 0, refused = 0;
    for (const bool ply : {false, true}) {
        const std::string whole = ply ? gaussian_ply(gaussians) : gaussian_csv(gaussians);
        for (int i = 0; i < 4000; ++i) {
            std::string content = whole;
            for (int hits = 1 + int(random() % 3); hits > 0; --hits)
                content[random() % content.size()] = char(random());
            if (random() % 4 == 0)
                content.resize(random() % content.size());
            try {
                const auto read = ply ? parse_gaussian_ply(content, "damaged") : parse_gaussian_csv(content, "damaged");
                for (const Gaussian &gaussian : read) {
                    ASSERT_GT(gaussian.scale, 0);
                    ASSERT_GE(gaussian.amplitude, 0);
                }
                ++accepted;
            } catch (const Error &error) {
                ASSERT_STREQ(std::string(error.what()).substr(0, 7).c_str(), "damaged");
                ++refused;
            }
        }
    }
    EXPECT_GT(accepted, 100u);
    EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace brume
