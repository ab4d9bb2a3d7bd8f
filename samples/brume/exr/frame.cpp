#include "exr/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <fmt/format.h>
#include <half.h>
#include <oneapi/tbb/parallel_for.h>

#include "exr/planes.hpp"

namespace brume::tool {
namespace {

void read_planes(const ExrFile &file, const PartInfo &part, std::vector<Plane> &planes)
{
    file.guarded(fmt::format("reading {}", part.label()), [&] {
        Imf::InputPart input(file.imf(), part.index);
        Imf::FrameBuffer buffer;
        for (Plane &plane : planes)
            buffer.insert(plane.channel.name, slice_of(plane, part.data_window));
        input.setFrameBuffer(buffer);
        input.readPixels(part.data_window.min.y, part.data_window.max.y);
    });
}

Plane allocate_plane(const ChannelInfo &channel, const PartInfo &part)
{
    Plane plane{channel, nullptr, pixel_bytes(channel.type)};
    plane.bytes = std::make_unique_for_overwrite<char[]>(plane_bytes(channel, part.data_window));
    return plane;
}

const Plane &plane_named(const std::vector<Plane> &planes, const std::string &name)
{
    return *std::find_if(planes.begin(), planes.end(), [&](const Plane &p) { return p.channel.name == name; });
}

/// `stride` floats apart; only for channels at full resolution.
void to_floats(const Plane &plane, std::size_t count, float *out, std::size_t stride)
{
    oneapi::tbb::parallel_for(std::size_t(0), (count + kGrain - 1) / kGrain, [&](std::size_t block) {
        const std::size_t from = block * kGrain, to = std::min(count, from + kGrain);
        const auto convert = [&](const auto *in) {
            for (std::size_t i = from; i < to; ++i)
                out[i * stride] = float(in[i]);
        };
        switch (plane.channel.type) {
        case Imf::HALF:
            convert(reinterpret_cast<const half *>(plane.bytes.get()));
            break;
        case Imf::FLOAT:
            convert(reinterpret_cast<const float *>(plane.bytes.get()));
            break;
        default:
            convert(reinterpret_cast<const std::uint32_t *>(plane.bytes.get()));
            break;
        }
    });
}

/// Lays pixels over the colour's data window: the two parts of a multi-part file may cover different ones.
std::vector<float> place(const std::vector<float> &pixels, std::size_t channels, const PartInfo &from, const PartInfo &onto,
                         float elsewhere, std::uint64_t &outside)
{
    const std::size_t count = std::size_t(onto.width()) * std::size_t(onto.height());
    std::vector<float> placed(count * channels, elsewhere);
    const Imath::Box2i &a = from.data_window;
    const Imath::Box2i &b = onto.data_window;
    const int x0 = std::max(a.min.x, b.min.x), x1 = std::min(a.max.x, b.max.x);
    const int y0 = std::max(a.min.y, b.min.y), y1 = std::min(a.max.y, b.max.y);
    std::uint64_t covered = 0;
    for (int y = y0; y <= y1 && x0 <= x1; ++y) {
        const auto at = [&](const Imath::Box2i &w, const PartInfo &part) {
            return channels * (std::size_t(y - w.min.y) * std::size_t(part.width()) + std::size_t(x0 - w.min.x));
        };
        const float *source = pixels.data() + at(a, from);
        std::copy(source, source + channels * std::size_t(x1 - x0 + 1), placed.data() + at(b, onto));
        covered += std::uint64_t(x1 - x0 + 1);
    }
    outside = count - covered;
    return placed;
}

}  // namespace

bool is_lossy_for(Imf::Compression compression, const ChannelInfo &channel)
{
    const Imf::PixelType type = channel.type;
    const std::string &base = channel.base;
    switch (compression) {
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
        return type == Imf::HALF;
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
        return type != Imf::UINT &&
               (base == "R" || base == "G" || base == "B" || base == "Y" || base == "RY" || base == "BY");
    case Imf::PXR24_COMPRESSION:
        return type == Imf::FLOAT;
    default:
        return false;
    }
}

std::uint64_t frame_bytes(const ExrFile &file, const ColorChoice &color)
{
    const PartInfo &part = file.parts()[color.part];
    std::uint64_t bytes = 0;
    for (const ChannelInfo &c : part.channels)
        bytes += plane_bytes(c, part.data_window);
    const std::uint64_t pixels = std::uint64_t(part.width()) * std::uint64_t(part.height());
    return bytes + pixels * sizeof(float) * (color.alpha.empty() ? 4 : 5);
}

std::vector<float> read_channel(const ExrFile &file, int part_index, const std::string &channel)
{
    const PartInfo &part = file.parts()[part_index];
    std::vector<Plane> planes;
    planes.push_back(allocate_plane(*part.find(channel), part));
    read_planes(file, part, planes);
    std::vector<float> values(std::size_t(part.width()) * std::size_t(part.height()));
    to_floats(planes.front(), values.size(), values.data(), 1);
    return values;
}

InputLayer read_input(const ExrFile &file, const InputChoice &choice, const PartInfo &onto, const std::vector<Plane> *planes)
{
    const PartInfo &part = file.parts()[choice.part];
    std::vector<Plane> own;
    if (!planes) {
        for (const std::string &channel : choice.channels)
            own.push_back(allocate_plane(*part.find(channel), part));
        read_planes(file, part, own);
        planes = &own;
    }
    InputLayer input{choice.role, int(choice.channels.size()), {}};
    input.light = choice.light.value_or(0);
    const std::size_t stride = choice.channels.size(), count = std::size_t(part.width()) * std::size_t(part.height());
    input.pixels.resize(count * stride);
    for (std::size_t c = 0; c < stride; ++c)
        to_floats(plane_named(*planes, choice.channels[c]), count, input.pixels.data() + c, stride);
    if (part.data_window != onto.data_window)
        input.pixels = place(input.pixels, stride, part, onto, choice.role == "transmittance" ? 1.0f : 0.0f, input.outside);
    return input;
}

Frame read_frame(ExrFile file, const ColorChoice &color, const DepthSource *depth)
{
    Frame frame{std::move(file), color, {}, 0, 0, 3, {}, {}, 0};
    const PartInfo &part = frame.part();
    frame.width = part.width();
    frame.height = part.height();
    frame.channels = color.alpha.empty() ? 3 : 4;
    for (const ChannelInfo &c : part.channels)
        frame.planes.push_back(allocate_plane(c, part));
    read_planes(frame.file, part, frame.planes);

    const std::size_t count = std::size_t(frame.width) * std::size_t(frame.height);
    const std::size_t stride = std::size_t(frame.channels);
    frame.pixels.resize(count * stride);
    for (std::size_t i = 0; i < 3; ++i)
        to_floats(plane_named(frame.planes, color.rgb[i]), count, frame.pixels.data() + i, stride);
    if (!color.alpha.empty())
        to_floats(plane_named(frame.planes, color.alpha), count, frame.pixels.data() + 3, stride);

    if (!depth)
        return frame;
    const bool same_file = depth->file == nullptr;
    if (same_file && depth->choice.part == color.part) {
        frame.depth.resize(count);
        to_floats(plane_named(frame.planes, depth->choice.channel), count, frame.depth.data(), 1);
        return frame;
    }
    const ExrFile &source = same_file ? frame.file : *depth->file;
    const auto values = read_channel(source, depth->choice.part, depth->choice.channel);
    frame.depth = place(values, 1, source.parts()[depth->choice.part], part, std::numeric_limits<float>::infinity(),
                        frame.outside_depth_window);
    return frame;
}

}  // namespace brume::tool
