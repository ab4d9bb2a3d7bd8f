#include "exr/precheck.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiledFlag = 0x200, kDeepFlag = 0x800, kMultiPartFlag = 0x1000;
constexpr std::int64_t kLargestCoordinate = 1 << 28;

struct Window {
    std::int32_t x0, y0, x1, y1;
    std::int64_t width() const { return std::int64_t(x1) - x0 + 1; }
    std::int64_t height() const { return std::int64_t(y1) - y0 + 1; }
};

struct PartHeader {
    std::string name, type;
    std::optional<Window> data, display;
    std::optional<std::uint8_t> compression;
    std::optional<std::array<std::uint32_t, 2>> tile;
    std::optional<std::int32_t> chunk_count;
    std::uint64_t channels = 0;
    std::uint64_t bytes_per_pixel = 0;
};

std::int64_t scanlines_per_chunk(int compression)
{
    switch (compression) {
    case 0:
    case 1:
    case 2:
        return 1;  // none, rle, zips
    case 3:
    case 5:
        return 16;  // zip, pxr24
    case 4:
    case 6:
    case 7:
    case 8:
        return 32;  // piz, b44, b44a, dwaa
    default:
        return 256;  // dwab
    }
}

class Walker {
public:
    Walker(const std::filesystem::path &file, const ReadLimits &limits)
        : file_(file), limits_(limits), in_(file, std::ios::binary)
    {
        if (!in_)
            throw FrameError(fmt::format("{}: cannot be opened for reading", file.string()));
        in_.seekg(0, std::ios::end);
        size_ = std::uint64_t(in_.tellg());
        in_.seekg(0);
    }

    void walk()
    {
        const auto magic = read<std::uint32_t>("magic number");
        if (magic != kMagic)
            fail(fmt::format("starts with {:08x}, not with OpenEXR's {:08x}: not an OpenEXR file", magic, kMagic));
        const auto version = read<std::uint32_t>("version");
        if ((version & 0xff) != 2)
            fail(fmt::format("file format version {} (expected 2)", version & 0xff));
        flags_ = version;

        const bool multi_part = version & kMultiPartFlag;
        std::vector<PartHeader> parts;
        std::uint64_t chunks = 0;
        for (int index = 0;; ++index) {
            part_ = index;
            if (multi_part && index > 0 && peek_zero())
                break;
            if (index >= limits_.parts)
                fail(fmt::format("more than {} parts", limits_.parts));
            parts.push_back(read_part());
            PartHeader &part = parts.back();
            const std::uint64_t least = check(part);
            if (!part.chunk_count)
                part.chunk_count = std::int32_t(least);
            if (*part.chunk_count < 0)
                fail(fmt::format("chunkCount is {} (expected at least 0)", *part.chunk_count));
            chunks += std::max<std::uint64_t>(least, std::uint64_t(*part.chunk_count));
            if (!multi_part)
                break;
        }
        part_ = 0;
        // Each chunk has an entry of eight bytes at the head of the file, so the file's own size bounds what it may claim.
        std::uint64_t table = position();
        if (table + 8 * chunks > size_)
            fail(fmt::format("claims {} chunks of pixels, but the file has only {} bytes", chunks, size_));
        for (part_ = 0; part_ < int(parts.size()); ++part_) {
            const PartHeader &part = parts[std::size_t(part_)];
            if (multi_part)
                check_written(table, part);
            if (is_deep(part))
                check_deep_chunks(table, part, multi_part);
            else if (multi_part)
                check_flat_chunks(table, part);
            table += 8 * std::uint64_t(*part.chunk_count);
        }
    }

private:
    [[noreturn]] void fail(const std::string &what) const
    {
        const std::string part = part_ > 0 ? fmt::format(" part {}:", part_) : "";
        throw FrameError(fmt::format("{}:{} {}", file_.string(), part, what));
    }

    std::uint64_t position() { return std::uint64_t(in_.tellg()); }

    template <class T> T read(const char *what)
    {
        T value{};
        if (!in_.read(reinterpret_cast<char *>(&value), sizeof value))
            fail(fmt::format("ends inside its {} (file of {} bytes)", what, size_));
        return value;
    }

    bool peek_zero()
    {
        if (in_.peek() == std::char_traits<char>::eof())
            fail("ends inside its headers");
        if (in_.peek() != 0)
            return false;
        in_.get();
        return true;
    }

    std::string read_name(const char *what)
    {
        std::string name;
        if (!std::getline(in_, name, '\0') || in_.eof())
            fail(fmt::format("ends inside {}", what));
        if (name.size() > 255)
            fail(fmt::format("{} is {} characters long (expected at most 255)", what, name.size()));
        return name;
    }

    PartHeader read_part()
    {
        PartHeader part;
        while (!peek_zero()) {
            const std::string name = read_name("an attribute's name");
            const std::string type = read_name("an attribute's type");
            const auto bytes = read<std::int32_t>("attribute sizes");
            if (bytes < 0 || position() + std::uint64_t(bytes) > size_)
                fail(fmt::format("attribute '{}' claims {} bytes, but the file has only {}", name, bytes, size_));
            const auto end = position() + std::uint64_t(bytes);
            if (interesting(name)) {
                std::vector<char> value(std::size_t(bytes), '\0');
                in_.read(value.data(), bytes);
                take(part, name, value);
            }
            in_.seekg(std::streamoff(end));
        }
        return part;
    }

    static bool interesting(const std::string &name)
    {
        return name == "dataWindow" || name == "displayWindow" || name == "channels" || name == "compression" ||
               name == "tiles" || name == "name" || name == "type" || name == "chunkCount";
    }

    template <class T> T value_of(const std::string &name, std::span<const char> bytes) const
    {
        if (bytes.size() < sizeof(T))
            fail(fmt::format("attribute '{}' has {} bytes (expected {})", name, bytes.size(), sizeof(T)));
        T value;
        std::memcpy(&value, bytes.data(), sizeof value);
        return value;
    }

    void take(PartHeader &part, const std::string &name, std::span<const char> bytes) const
    {
        if (name == "dataWindow")
            part.data = value_of<Window>(name, bytes);
        else if (name == "displayWindow")
            part.display = value_of<Window>(name, bytes);
        else if (name == "compression")
            part.compression = value_of<std::uint8_t>(name, bytes);
        else if (name == "tiles")
            part.tile = value_of<std::array<std::uint32_t, 2>>(name, bytes);
        else if (name == "name")
            part.name.assign(bytes.begin(), bytes.end());
        else if (name == "type")
            part.type.assign(bytes.begin(), bytes.end());
        else if (name == "chunkCount")
            part.chunk_count = value_of<std::int32_t>(name, bytes);
        else
            take_channels(part, bytes);
    }

    void take_channels(PartHeader &part, std::span<const char> bytes) const
    {
        constexpr std::size_t kAfterName = 16;  // type, linearity and padding, two sampling rates
        std::size_t at = 0;
        while (at < bytes.size() && bytes[at] != 0) {
            const auto end = std::find(bytes.begin() + std::ptrdiff_t(at), bytes.end(), '\0');
            const std::size_t after = std::size_t(end - bytes.begin()) + 1;
            const std::string name(bytes.begin() + std::ptrdiff_t(at), end);
            if (end == bytes.end() || after + kAfterName > bytes.size())
                fail("channel list ends inside channel '" + name + "'");
            const auto type = value_of<std::int32_t>("channels", bytes.subspan(after));
            const auto sampling = value_of<std::array<std::int32_t, 2>>("channels", bytes.subspan(after + 8));
            if (type < 0 || type > 2)
                fail(fmt::format("channel '{}' has pixel type {} (expected 0, 1 or 2)", name, type));
            if (sampling[0] < 1 || sampling[1] < 1)
                fail(fmt::format("channel '{}' has sampling {} x {} (expected at least 1)", name, sampling[0], sampling[1]));
            part.bytes_per_pixel += type == 1 ? 2 : 4;
            if (int(++part.channels) > limits_.channels)
                fail(fmt::format("more than {} channels", limits_.channels));
            at = after + kAfterName;
        }
    }

    bool is_deep(const PartHeader &part) const
    {
        return part.type.empty() ? (flags_ & kDeepFlag) != 0 : part.type.starts_with("deep");
    }
    bool is_tiled(const PartHeader &part) const
    {
        return part.type.empty() ? (flags_ & kTiledFlag) != 0 : part.type == "tiledimage" || part.type == "deeptile";
    }

    /// A renderer that was stopped leaves entries of 0 for what it has not written.
    void check_written(std::uint64_t table, const PartHeader &part)
    {
        std::int32_t missing = 0;
        for (std::int32_t i = 0; i < *part.chunk_count; ++i)
            missing += read_at<std::uint64_t>(table + 8 * std::uint64_t(i)) == 0;
        if (missing > 0)
            fail(fmt::format("{}: {} of {} chunks of pixels were never written: the file is incomplete",
                             part.name.empty() ? "part without a name" : "part '" + part.name + "'", missing,
                             *part.chunk_count));
    }

    /// The library allocates a deep chunk by the size that it claims, even to copy it undecoded.
    void check_deep_chunks(std::uint64_t table, const PartHeader &part, bool multi_part)
    {
        const std::uint64_t sizes_at = (multi_part ? 4u : 0u) + (is_tiled(part) ? 16u : 4u);
        for (std::int32_t i = 0; i < *part.chunk_count; ++i) {
            const auto offset = read_at<std::uint64_t>(table + 8 * std::uint64_t(i));
            if (offset > size_ || offset + sizes_at + 24 > size_)
                fail(fmt::format("chunk {} is at byte {} (file of {} bytes)", i, offset, size_));
            const auto counts = read_at<std::uint64_t>(offset + sizes_at),
                       samples = read_at<std::uint64_t>(offset + sizes_at + 8);
            if (counts > size_ || samples > size_ || offset + counts + samples > size_)
                fail(fmt::format("chunk {} claims {} and {} bytes, but the file has only {}", i, counts, samples, size_));
        }
    }

    /// Copied undecoded, a flat chunk passes through a buffer of its decoded size, whatever size it claims. Only multi-part
    /// files have parts that are copied so.
    void check_flat_chunks(std::uint64_t table, const PartHeader &part)
    {
        const bool tiled = is_tiled(part);
        const std::uint64_t size_at = tiled ? 20 : 8;
        const std::uint64_t pixels =
            tiled ? std::uint64_t((*part.tile)[0]) * (*part.tile)[1]
                  : std::uint64_t(part.data->width()) * std::uint64_t(scanlines_per_chunk(*part.compression));
        for (std::int32_t i = 0; i < *part.chunk_count; ++i) {
            const auto offset = read_at<std::uint64_t>(table + 8 * std::uint64_t(i));
            if (offset > size_ || offset + size_at + 4 > size_)
                fail(fmt::format("chunk {} is at byte {} (file of {} bytes)", i, offset, size_));
            const auto bytes = read_at<std::int32_t>(offset + size_at);
            if (bytes < 0 || std::uint64_t(bytes) > pixels * part.bytes_per_pixel)
                fail(fmt::format("chunk {} claims {} bytes (expected at most the {} of its pixels)", i, bytes,
                                 pixels * part.bytes_per_pixel));
        }
    }

    template <class T> T read_at(std::uint64_t position)
    {
        in_.seekg(std::streamoff(position));
        return read<T>("chunks");
    }

    /// Refuses absurd geometry; returns the number of chunks that the part must have.
    std::uint64_t check(const PartHeader &part) const
    {
        if (!part.data)
            fail("no 'dataWindow'");
        if (!part.display)
            fail("no 'displayWindow'");
        check_window("dataWindow", *part.data);
        check_window("displayWindow", *part.display);
        if (part.data->width() > limits_.side || part.data->height() > limits_.side)
            fail(fmt::format("data window of {} x {} pixels (expected at most {} each way)", part.data->width(),
                             part.data->height(), limits_.side));
        if (part.channels == 0)
            fail("no channels");
        if (part.compression && (*part.compression == 10 || *part.compression == 11))
            fail(fmt::format(
                "compression {} is HTJ2K, which the OpenEXR library of this build does not read (expected one up "
                "to DWAB, 9)",
                int(*part.compression)));
        if (!part.compression || *part.compression > 9)
            fail(fmt::format("compression {} (expected 0 to 9)", part.compression ? int(*part.compression) : -1));

        const std::uint64_t pixels = std::uint64_t(part.data->width()) * std::uint64_t(part.data->height());
        const bool deep = is_deep(part);
        if (!deep && pixels > limits_.part_bytes / part.bytes_per_pixel)
            fail(fmt::format("{} x {} pixels of {} channels need {} MiB (limit {} MiB; run takes --mem)", part.data->width(),
                             part.data->height(), part.channels, pixels * part.bytes_per_pixel >> 20,
                             limits_.part_bytes >> 20));

        if (!is_tiled(part)) {
            const auto lines = deep ? 1 : scanlines_per_chunk(*part.compression);
            return std::uint64_t((part.data->height() + lines - 1) / lines);
        }
        if (!part.tile)
            fail("tiled, but no 'tiles' attribute");
        const auto [tile_x, tile_y] = *part.tile;
        if (tile_x == 0 || tile_y == 0 || tile_x > kLargestCoordinate || tile_y > kLargestCoordinate)
            fail(fmt::format("tiles of {} x {} pixels (expected 1 to {})", tile_x, tile_y, kLargestCoordinate));
        if (std::uint64_t(tile_x) * tile_y > limits_.part_bytes / part.bytes_per_pixel)
            fail(
                fmt::format("tiles of {} x {} pixels exceed the limit of {} MiB", tile_x, tile_y, limits_.part_bytes >> 20));
        return std::uint64_t((part.data->width() + tile_x - 1) / tile_x) *
               std::uint64_t((part.data->height() + tile_y - 1) / tile_y);
    }

    void check_window(const char *name, const Window &w) const
    {
        const auto absurd = [](std::int64_t v) { return v < -kLargestCoordinate || v > kLargestCoordinate; };
        if (w.x1 < w.x0 || w.y1 < w.y0 || absurd(w.x0) || absurd(w.y0) || absurd(w.x1) || absurd(w.y1))
            fail(fmt::format("{} ({}, {}) to ({}, {}) is empty or absurd (expected min <= max, each within +-2^28)", name,
                             w.x0, w.y0, w.x1, w.y1));
    }

    const std::filesystem::path &file_;
    const ReadLimits &limits_;
    std::ifstream in_;
    std::uint64_t size_ = 0;
    std::uint32_t flags_ = 0;
    int part_ = 0;
};

}  // namespace

void precheck_headers(const std::filesystem::path &file, const ReadLimits &limits)
{
    Walker(file, limits).walk();
}

}  // namespace brume::tool
