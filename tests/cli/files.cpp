#include "files.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputPart.h>
#include <fcntl.h>
#include <half.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace brume::tests {
namespace {

std::size_t bytes_of(Imf::PixelType type)
{
    return type == Imf::HALF ? 2 : 4;
}

std::vector<char> encode(const TestChannel &c, const Imath::Box2i &w)
{
    std::vector<char> bytes;
    for (int y = w.min.y; y <= w.max.y; ++y)
        for (int x = w.min.x; x <= w.max.x; ++x) {
            if (x % c.sampling || y % c.sampling)
                continue;
            const double v = c.value(x, y);
            const half h = half(float(v));
            const float f = float(v);
            const auto u = std::uint32_t(c.type == Imf::UINT ? v : 0);
            const void *from = c.type == Imf::HALF    ? static_cast<const void *>(&h)
                               : c.type == Imf::FLOAT ? static_cast<const void *>(&f)
                                                      : &u;
            bytes.insert(bytes.end(), static_cast<const char *>(from), static_cast<const char *>(from) + bytes_of(c.type));
        }
    return bytes;
}

void write_deep(Imf::MultiPartOutputFile &file, int index, const TestPart &part)
{
    const int width = part.data.max.x - part.data.min.x + 1, height = part.data.max.y - part.data.min.y + 1;
    Imf::Array2D<unsigned> counts(height, width);
    std::map<std::string, Imf::Array2D<float *>> pointers;
    std::vector<std::vector<float>> storage;
    storage.reserve(std::size_t(width * height) * part.channels.size());
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char *>(&counts[0][0] - part.data.min.x - part.data.min.y * width),
                   sizeof(unsigned), sizeof(unsigned) * std::size_t(width)));
    for (const TestChannel &c : part.channels) {
        auto &array = pointers[c.name];
        array.resizeErase(height, width);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                counts[y][x] = unsigned((x + y) % 3);
                storage.emplace_back(3, float(c.value(x, y)));
                array[y][x] = storage.back().data();
            }
        buffer.insert(c.name,
                      Imf::DeepSlice(Imf::FLOAT,
                                     reinterpret_cast<char *>(&array[0][0] - part.data.min.x - part.data.min.y * width),
                                     sizeof(float *), sizeof(float *) * std::size_t(width), sizeof(float)));
    }
    Imf::DeepScanLineOutputPart output(file, index);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
}

void write_flat(Imf::MultiPartOutputFile &file, int index, const TestPart &part)
{
    std::vector<std::vector<char>> planes;
    Imf::FrameBuffer buffer;
    for (const TestChannel &c : part.channels) {
        planes.push_back(encode(c, part.data));
        buffer.insert(c.name, Imf::Slice::Make(c.type, planes.back().data(), part.data, 0, 0, c.sampling, c.sampling));
    }
    if (part.tiled) {
        Imf::TiledOutputPart output(file, index);
        output.setFrameBuffer(buffer);
        for (int level = 0; level < output.numLevels(); ++level)
            output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1, level);
    } else {
        Imf::OutputPart output(file, index);
        output.setFrameBuffer(buffer);
        output.writePixels(part.data.max.y - part.data.min.y + 1);
    }
}

}  // namespace

Folder::Folder()
{
    std::string name = (fs::temp_directory_path() / "brume-cli-XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw std::runtime_error("no temporary folder");
    path_ = name;
}

Folder::~Folder()
{
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<TestChannel> rgb(const std::string &prefix, Imf::PixelType type)
{
    const auto wave = [](double k) { return Value([k](int x, int y) { return 0.25 + k * ((x * 7 + y * 3) % 16) / 16.0; }); };
    return {{prefix + "R", type, wave(1)}, {prefix + "G", type, wave(2)}, {prefix + "B", type, wave(4)}};
}

std::vector<TestChannel> rgbz()
{
    auto channels = rgb();
    channels.push_back({"Z", Imf::FLOAT, [](int, int y) { return y + 1.0; }});
    return channels;
}

void write_exr(const fs::path &path, const std::vector<TestPart> &parts, Imath::Box2i display)
{
    std::vector<Imf::Header> headers;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const TestPart &part = parts[i];
        Imf::Header header(display, part.data);
        header.compression() = part.deep ? Imf::ZIPS_COMPRESSION : Imf::ZIP_COMPRESSION;
        for (const TestChannel &c : part.channels)
            header.channels().insert(c.name, Imf::Channel(c.type, c.sampling, c.sampling));
        if (!part.name.empty() || parts.size() > 1)
            header.setName(part.name.empty() ? "part" + std::to_string(i) : part.name);
        if (!part.view.empty())
            header.setView(part.view);
        header.setType(part.deep ? Imf::DEEPSCANLINE : part.tiled ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
        if (part.tiled)
            header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
        part.edit(header);
        headers.push_back(header);
    }
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
    for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i].deep ? write_deep(file, int(i), parts[i]) : write_flat(file, int(i), parts[i]);
}

void write_text(const fs::path &path, const std::string &text)
{
    std::ofstream(path) << text;
}

std::string read_text(const fs::path &path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<double> read_plane(const fs::path &path, const std::string &channel, int part)
{
    Imf::MultiPartInputFile file(path.c_str());
    Imf::InputPart input(file, part);
    const Imath::Box2i w = input.header().dataWindow();
    const Imf::Channel *c = input.header().channels().findChannel(channel);
    if (!c)
        throw std::runtime_error(path.string() + ": no channel " + channel);
    const std::size_t count = std::size_t(w.max.x - w.min.x + 1) * std::size_t(w.max.y - w.min.y + 1);
    std::vector<std::uint32_t> integers(count);
    std::vector<float> floats(count);
    const bool is_uint = c->type == Imf::UINT;
    Imf::FrameBuffer buffer;
    buffer.insert(channel, is_uint ? Imf::Slice::Make(Imf::UINT, integers.data(), w)
                                   : Imf::Slice::Make(Imf::FLOAT, floats.data(), w));
    input.setFrameBuffer(buffer);
    input.readPixels(w.min.y, w.max.y);
    return is_uint ? std::vector<double>(integers.begin(), integers.end())
                   : std::vector<double>(floats.begin(), floats.end());
}

Imf::Header read_header(const fs::path &path, int part)
{
    Imf::MultiPartInputFile file(path.c_str());
    return file.header(part);
}

std::pair<std::uint64_t, double> read_deep(const fs::path &path, const std::string &channel, int part)
{
    Imf::MultiPartInputFile file(path.c_str());
    Imf::DeepScanLineInputPart input(file, part);
    const Imath::Box2i w = input.header().dataWindow();
    const int width = w.max.x - w.min.x + 1, height = w.max.y - w.min.y + 1;
    Imf::Array2D<unsigned> counts(height, width);
    Imf::Array2D<float *> pointers(height, width);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char *>(&counts[0][0] - w.min.x - w.min.y * width),
                                             sizeof(unsigned), sizeof(unsigned) * std::size_t(width)));
    buffer.insert(channel, Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char *>(&pointers[0][0] - w.min.x - w.min.y * width),
                                          sizeof(float *), sizeof(float *) * std::size_t(width), sizeof(float)));
    input.setFrameBuffer(buffer);
    input.readPixelSampleCounts(w.min.y, w.max.y);
    std::vector<std::vector<float>> storage;
    storage.reserve(std::size_t(width * height));
    std::uint64_t total = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            storage.emplace_back(counts[y][x]);
            pointers[y][x] = storage.back().data();
            total += counts[y][x];
        }
    input.readPixels(w.min.y, w.max.y);
    double sum = 0;
    for (const auto &samples : storage)
        for (const float v : samples)
            sum += v;
    return {total, sum};
}

Result brume(const std::vector<std::string> &arguments, int seconds)
{
    const Folder folder;
    const fs::path out = folder / "out", err = folder / "err";
    std::vector<std::string> words{BRUME_TOOL};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> argv;
    for (std::string &w : words)
        argv.push_back(w.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_WRONLY, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_WRONLY, 0600);
    pid_t child = 0;
    const int failed = ::posix_spawn(&child, BRUME_TOOL, &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed)
        throw std::runtime_error("the tool cannot be started");

    int status = 0;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() > deadline) {
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            return {-2, read_text(out), "hangs: " + read_text(err)};
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_text(out), read_text(err)};
}

}  // namespace brume::tests
