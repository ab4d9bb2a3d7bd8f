#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <ImathBox.h>
#include <ImfHeader.h>
#include <ImfPixelType.h>

namespace brume::tests {

namespace fs = std::filesystem;

/// A folder of its own that goes with the test.
class Folder {
public:
    Folder();
    ~Folder();
    fs::path operator/(const std::string &name) const { return path_ / name; }
    const fs::path &path() const { return path_; }

private:
    fs::path path_;
};

using Value = std::function<double(int x, int y)>;
inline Value constant(double v)
{
    return [v](int, int) { return v; };
}

struct TestChannel {
    std::string name;
    Imf::PixelType type = Imf::HALF;
    Value value = constant(0.5);
    int sampling = 1;
};

struct TestPart {
    std::vector<TestChannel> channels;
    Imath::Box2i data{{0, 0}, {31, 23}};
    std::string name = {}, view = {};
    bool tiled = false, deep = false;
    std::function<void(Imf::Header &)> edit = [](Imf::Header &) {};
};

constexpr int kWidth = 32, kHeight = 24;
std::vector<TestChannel> rgb(const std::string &prefix = "", Imf::PixelType type = Imf::HALF);
/// RGB and a float Z from 1 to 24, row by row.
std::vector<TestChannel> rgbz();

void write_exr(const fs::path &path, const std::vector<TestPart> &parts,
               Imath::Box2i display = {{0, 0}, {kWidth - 1, kHeight - 1}});
void write_text(const fs::path &path, const std::string &text);
std::string read_text(const fs::path &path);

/// A channel as the file has it; full-size channels only.
std::vector<double> read_plane(const fs::path &path, const std::string &channel, int part = 0);
Imf::Header read_header(const fs::path &path, int part = 0);
/// Total number of samples and their sum in a deep scan-line part.
std::pair<std::uint64_t, double> read_deep(const fs::path &path, const std::string &channel, int part);

struct Result {
    int status = -1;
    std::string out, err;
};
/// Runs the tool that was built; arguments are passed as they are.
Result brume(const std::vector<std::string> &arguments, int seconds = 60);

/// Scene files: grey fog that needs a field of view; fog that needs nothing.
inline const std::string kFog =
    R"({"brume":1,"medium":{"scattering":[0.02,0.02,0.02],"absorption":[0.01,0.01,0.01],"g":0.8}})";
inline const std::string kClear = R"({"brume":1})";

}  // namespace brume::tests
