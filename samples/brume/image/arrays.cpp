#include "image/arrays.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <half.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Where numbers lie in the file, and what they are.
struct Layout {
    std::uint64_t offset = 0;
    std::int64_t width = 0, height = 0, channels = 1;
    std::int64_t x_stride = 0, y_stride = 0, channel_stride = 1;  ///< in numbers; y from the picture's top
    char kind = 'f';                                              ///< f, u or i, as NumPy has it
    std::size_t bytes = 4;
    bool big_endian = false;
};

[[noreturn]] void fail(const std::filesystem::path &file, const std::string &what)
{
    throw FrameError(fmt::format("{}: {}", file.string(), what));
}

template <class T> double number_at(const char *from, bool swapped)
{
    char bytes[sizeof(T)];
    std::memcpy(bytes, from, sizeof(T));
    if (swapped)
        std::reverse(bytes, bytes + sizeof(T));
    return double(std::bit_cast<T>(bytes));
}

using Read = double (*)(const char *, bool);

double half_at(const char *from, bool swapped)
{
    std::uint16_t bits;
    std::memcpy(&bits, from, 2);
    half h;
    h.setBits(swapped ? std::uint16_t(bits << 8 | bits >> 8) : bits);
    return double(float(h));
}

Read reader_of(const Layout &layout)
{
    switch (layout.kind * 16 + int(layout.bytes)) {
    case 'f' * 16 + 2:
        return half_at;
    case 'f' * 16 + 4:
        return number_at<float>;
    case 'f' * 16 + 8:
        return number_at<double>;
    case 'u' * 16 + 1:
        return number_at<std::uint8_t>;
    case 'u' * 16 + 2:
        return number_at<std::uint16_t>;
    case 'u' * 16 + 4:
        return number_at<std::uint32_t>;
    case 'i' * 16 + 2:
        return number_at<std::int16_t>;
    case 'i' * 16 + 4:
        return number_at<std::int32_t>;
    default:
        return nullptr;
    }
}

class ArrayPixels : public StoredPixels {
public:
    ArrayPixels(const Layout &layout, std::vector<char> bytes, const std::vector<ChannelInfo> &channels)
        : layout_(layout), bytes_(std::move(bytes)), channels_(channels)
    {
    }
    void to_floats(const std::string &channel, float *out, std::size_t stride) const override
    {
        const auto c = std::find_if(channels_.begin(), channels_.end(), [&](const auto &i) { return i.name == channel; });
        const Read read = reader_of(layout_);
        const char *first = bytes_.data() + (c - channels_.begin()) * layout_.channel_stride * std::int64_t(layout_.bytes);
        if (layout_.y_stride < 0)
            first -= (layout_.height - 1) * layout_.y_stride * std::int64_t(layout_.bytes);
        for (std::int64_t y = 0; y < layout_.height; ++y)
            for (std::int64_t x = 0; x < layout_.width; ++x) {
                const std::int64_t at = y * layout_.y_stride + x * layout_.x_stride;
                *out = float(read(first + at * std::int64_t(layout_.bytes), layout_.big_endian));
                out += stride;
            }
    }

private:
    Layout layout_;
    std::vector<char> bytes_;
    std::vector<ChannelInfo> channels_;
};

class ArraySource : public PictureSource {
public:
    ArraySource(std::filesystem::path file, const Layout &layout) : file_(std::move(file)), layout_(layout) {}

    std::unique_ptr<StoredPixels> read(int, const std::vector<std::string> &) const override
    {
        std::vector<char> bytes(std::size_t(layout_.width * layout_.height * layout_.channels) * layout_.bytes);
        std::ifstream in(file_, std::ios::binary);
        in.seekg(std::streamoff(layout_.offset));
        if (!in.read(bytes.data(), std::streamsize(bytes.size())))
            fail(file_, "cannot be read");
        return std::make_unique<ArrayPixels>(layout_, std::move(bytes), parts.front().channels);
    }

private:
    std::filesystem::path file_;
    Layout layout_;
};

Layout read_pfm_header(const std::filesystem::path &file, std::istream &in)
{
    Layout layout;
    std::string magic, scale;
    if (!(in >> magic) || (magic != "PF" && magic != "Pf"))
        fail(file, fmt::format("starts with '{}' (expected PF or Pf: not a PFM file)", magic.substr(0, 8)));
    if (!(in >> layout.width >> layout.height))
        fail(file, "has no width and height after its first line");
    if (!(in >> scale) || scale.size() > 32)
        fail(file, "has no scale after its size");
    double value = 0;
    const auto [end, error] = std::from_chars(scale.data(), scale.data() + scale.size(), value);
    if (error != std::errc() || end != scale.data() + scale.size() || value == 0)
        fail(file, fmt::format("has the scale '{}' (expected a number, negative for little-endian)", scale));
    in.get();
    layout.channels = magic == "PF" ? 3 : 1;
    layout.x_stride = layout.channels;
    layout.y_stride = -layout.channels * layout.width;  // rows run from the bottom
    layout.big_endian = value > 0;
    layout.offset = std::uint64_t(in.tellg());
    return layout;
}

/// The text after 'KEY': in the dictionary that is NPY's header.
std::string npy_value(const std::filesystem::path &file, const std::string &header, const std::string &key)
{
    const auto at = header.find("'" + key + "'");
    const auto colon = at == std::string::npos ? at : header.find(':', at);
    if (colon == std::string::npos)
        fail(file, fmt::format("NPY header has no '{}'", key));
    const auto from = header.find_first_not_of(' ', colon + 1);
    if (from == std::string::npos)
        fail(file, fmt::format("NPY header has no value of '{}'", key));
    const bool tuple = header[from] == '(';
    const auto to = header.find_first_of(tuple ? ")" : ",}", from);
    return header.substr(from, to == std::string::npos ? to : to - from + tuple);
}

Layout read_npy_header(const std::filesystem::path &file, std::istream &in)
{
    char start[8] = {};
    in.read(start, 8);
    if (!in || std::memcmp(start, "\x93NUMPY", 6) != 0)
        fail(file, "does not start with \\x93NUMPY: not an NPY file");
    std::uint32_t length = 0;
    in.read(reinterpret_cast<char *>(&length), start[6] == 1 ? 2 : 4);
    if (!in || length > 65536)
        fail(file, fmt::format("NPY header of {} bytes (expected at most 65536)", length));
    std::string header(length, '\0');
    if (!in.read(header.data(), length))
        fail(file, "ends inside its NPY header");

    Layout layout;
    layout.offset = std::uint64_t(in.tellg());
    const std::string type = npy_value(file, header, "descr");
    if (type.size() != 5 || std::string_view("<>|=").find(type[1]) == std::string_view::npos ||
        !std::isdigit((unsigned char)type[3]))
        fail(file, fmt::format("numbers of type {} (expected one such as '<f4' or '<u2')", type.substr(0, 40)));
    layout.big_endian = type[1] == '>';
    layout.kind = type[2];
    layout.bytes = std::size_t(type[3] - '0');
    if (!reader_of(layout))
        fail(file, fmt::format("numbers of type {} (expected f2, f4, f8, u1, u2, u4, i2 or i4)", type));
    std::string shape = npy_value(file, header, "shape");
    std::replace_if(
        shape.begin(), shape.end(), [](char c) { return c == '(' || c == ')' || c == ',' || c == 'L'; }, ' ');
    std::istringstream numbers(shape);
    std::vector<std::int64_t> sides;
    for (std::int64_t n; numbers >> n;)
        sides.push_back(n);
    if (!numbers.eof() || sides.size() < 2 || sides.size() > 3)
        fail(file, fmt::format("an array of the shape {} (expected height, width and at most one more, the channels)",
                               npy_value(file, header, "shape").substr(0, 60)));
    layout.height = sides[0];
    layout.width = sides[1];
    layout.channels = sides.size() == 3 ? sides[2] : 1;
    if (npy_value(file, header, "fortran_order") == "True") {
        layout.y_stride = 1;
        layout.x_stride = layout.height;
        layout.channel_stride = layout.height * layout.width;
    } else {
        layout.x_stride = layout.channels;
        layout.y_stride = layout.channels * layout.width;
    }
    return layout;
}

}  // namespace

bool is_array(const Format &format)
{
    const std::string_view name = format.name;
    return name == "pfm" || name == "npy";
}

std::unique_ptr<PictureSource> open_array(const std::filesystem::path &file, const Format &format, const ReadLimits &limits)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail(file, "cannot be opened for reading");
    const bool npy = std::string_view(format.name) == "npy";
    const Layout layout = npy ? read_npy_header(file, in) : read_pfm_header(file, in);
    if (layout.width < 1 || layout.height < 1 || layout.width > limits.side || layout.height > limits.side)
        fail(file, fmt::format("{} x {} pixels (expected 1 to {} each way)", layout.width, layout.height, limits.side));
    if (layout.channels != 1 && layout.channels != 3 && layout.channels != 4)
        fail(file, fmt::format("{} channels (expected 1, 3 or 4)", layout.channels));
    const std::uint64_t bytes = std::uint64_t(layout.width * layout.height * layout.channels) * layout.bytes;
    if (bytes > limits.part_bytes)
        fail(file, fmt::format("{} x {} pixels need {} MiB (limit {} MiB; run takes --mem)", layout.width, layout.height,
                               bytes >> 20, limits.part_bytes >> 20));
    in.seekg(0, std::ios::end);
    if (const auto size = std::uint64_t(in.tellg()); size < layout.offset + bytes)
        fail(file, fmt::format("{} x {} pixels of {} channels need {} bytes after the header, but there are {}",
                               layout.width, layout.height, layout.channels, bytes, size - layout.offset));

    auto source = std::make_unique<ArraySource>(file, layout);
    PartInfo part;
    part.data_window = part.display_window = {{0, 0}, {int(layout.width) - 1, int(layout.height) - 1}};
    const std::string names = layout.channels == 1 ? "Y" : std::string("RGBA").substr(0, std::size_t(layout.channels));
    for (const char name : names) {
        ChannelInfo channel{std::string(1, name), "", "", std::string(1, name)};
        channel.type = layout.kind == 'f'  ? layout.bytes == 2 ? SampleType::kHalf : SampleType::kFloat
                       : layout.bytes == 1 ? SampleType::kUint8
                       : layout.bytes == 2 ? SampleType::kUint16
                                           : SampleType::kUint;
        part.channels.push_back(channel);
    }
    source->parts = {part};
    if (layout.kind != 'f')
        source->color_space = std::nullopt;
    return source;
}

void write_array(const std::filesystem::path &file, const std::string &final_name, const Format &format,
                 const Raster &raster)
{
    std::ofstream out(file, std::ios::binary);
    const auto *pixels = static_cast<const char *>(raster.pixels);
    const std::size_t channels = raster.channels.size(), row = sizeof(float) * channels * std::size_t(raster.width);
    if (std::string_view(format.name) == "pfm") {
        out << fmt::format("{}\n{} {}\n-1.0\n", channels == 3 ? "PF" : "Pf", raster.width, raster.height);
        for (int y = raster.height - 1; y >= 0; --y)
            out.write(pixels + row * std::size_t(y), std::streamsize(row));
    } else {
        std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}{}), }}", raster.height,
                                         raster.width, channels == 1 ? "" : fmt::format(", {}", channels));
        // NumPy wants the numbers at a multiple of 64 bytes.
        header.append(63 - (10 + header.size()) % 64, ' ');
        header += '\n';
        const auto length = std::uint16_t(header.size());
        out << "\x93NUMPY" << '\1' << '\0';
        out.write(reinterpret_cast<const char *>(&length), 2);
        out << header;
        out.write(pixels, std::streamsize(row * std::size_t(raster.height)));
    }
    out.close();
    if (!out)
        throw FrameError(fmt::format("{}: cannot be written", final_name));
}

}  // namespace brume::tool
