#include "image/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brume::tool {
namespace {

/// Lays pixels of window `a` over window `b`: the two parts of a multi-part file may cover different ones.
std::vector<float> place(const std::vector<float> &pixels, std::size_t channels, const Window &a, const Window &b,
                         float elsewhere, std::uint64_t &outside)
{
    const std::size_t count = std::size_t(b.width()) * std::size_t(b.height());
    std::vector<float> placed(count * channels, elsewhere);
    const int x0 = std::max(a.min.x, b.min.x), x1 = std::min(a.max.x, b.max.x);
    const int y0 = std::max(a.min.y, b.min.y), y1 = std::min(a.max.y, b.max.y);
    std::uint64_t covered = 0;
    for (int y = y0; y <= y1 && x0 <= x1; ++y) {
        const auto at = [&](const Window &w) {
            return channels * (std::size_t(y - w.min.y) * std::size_t(w.width()) + std::size_t(x0 - w.min.x));
        };
        const float *source = pixels.data() + at(a);
        std::copy(source, source + channels * std::size_t(x1 - x0 + 1), placed.data() + at(b));
        covered += std::uint64_t(x1 - x0 + 1);
    }
    outside = count - covered;
    return placed;
}

/// Integers that are a share of the largest become that share.
void to_shares(SampleType type, float *values, std::size_t count, std::size_t stride)
{
    if (!is_normalized(type))
        return;
    const float largest = type == SampleType::kUint8 ? 255.0f : 65535.0f;
    for (std::size_t i = 0; i < count; ++i)
        values[i * stride] /= largest;
}

void scale_by(double scale, std::vector<float> &depth)
{
    if (scale != 1)
        for (float &z : depth)
            z = float(double(z) * scale);
}

}  // namespace

std::uint64_t frame_bytes(const ImageFile &file, const ColorChoice &color)
{
    const PartInfo &part = file.part(color.part);
    const std::uint64_t pixels = std::uint64_t(part.width()) * std::uint64_t(part.height());
    std::uint64_t bytes = 0;
    for (const ChannelInfo &c : part.channels)
        bytes += bytes_of(c.type);
    return pixels * (bytes + sizeof(float) * (color.alpha.empty() ? 4 : 5));
}

std::vector<float> read_channel(const ImageFile &file, int part_index, const std::string &channel)
{
    const PartInfo &part = file.part(part_index);
    std::vector<float> values(std::size_t(part.width()) * std::size_t(part.height()));
    file.source().read(part_index, {channel})->to_floats(channel, values.data(), 1);
    return values;
}

std::vector<float> read_depth(const ImageFile &file, const DepthChoice &depth)
{
    std::vector<float> values = read_channel(file, depth.part, depth.channel);
    scale_by(depth.scale, values);
    return values;
}

InputLayer read_input(const ImageFile &file, const InputChoice &choice, const PartInfo &onto, const StoredPixels *stored)
{
    const PartInfo &part = file.part(choice.part);
    std::unique_ptr<StoredPixels> own;
    if (!stored) {
        own = file.source().read(choice.part, choice.channels);
        stored = own.get();
    }
    InputLayer input{choice.role, onto.width(), onto.height(), int(choice.channels.size()), {}};
    input.light = choice.light.value_or(0);
    const std::size_t stride = choice.channels.size(), count = std::size_t(part.width()) * std::size_t(part.height());
    std::vector<float> pixels(count * stride);
    for (std::size_t c = 0; c < stride; ++c) {
        stored->to_floats(choice.channels[c], pixels.data() + c, stride);
        to_shares(part.find(choice.channels[c])->type, pixels.data() + c, count, stride);
    }
    if (part.data_window != onto.data_window)
        pixels = place(pixels, stride, part.data_window, onto.data_window, choice.role == "transmittance" ? 1.0f : 0.0f,
                       input.outside);
    input.pixels = std::make_shared<const std::vector<float>>(std::move(pixels));
    return input;
}

InputLayer read_shadow(const ImageFile &file, const InputChoice &choice)
{
    const PartInfo &part = file.part(choice.part);
    InputLayer input{choice.role, part.display_window.width(), part.display_window.height(), 1, {}};
    input.light = choice.light.value_or(0);
    std::uint64_t outside = 0;
    input.pixels = std::make_shared<const std::vector<float>>(place(read_channel(file, choice.part, choice.channels.front()),
                                                                    1, part.data_window, part.display_window,
                                                                    std::numeric_limits<float>::infinity(), outside));
    return input;
}

Frame read_frame(ImageFile file, const ColorChoice &color, const DepthSource *depth)
{
    Frame frame{std::move(file), color, {}, 0, 0, 3, {}, {}, 0};
    const PartInfo &part = frame.part();
    frame.width = part.width();
    frame.height = part.height();
    frame.channels = color.alpha.empty() ? 3 : 4;
    std::vector<std::string> all;
    for (const ChannelInfo &c : part.channels)
        all.push_back(c.name);
    frame.stored = frame.file.source().read(color.part, all);

    const std::size_t count = std::size_t(frame.width) * std::size_t(frame.height);
    const std::size_t stride = std::size_t(frame.channels);
    frame.pixels.resize(count * stride);
    for (std::size_t i = 0; i < stride; ++i) {
        const std::string &channel = i < 3 ? color.rgb[i] : color.alpha;
        frame.stored->to_floats(channel, frame.pixels.data() + i, stride);
        to_shares(part.find(channel)->type, frame.pixels.data() + i, count, stride);
    }

    if (!depth)
        return frame;
    const bool same_file = depth->file == nullptr;
    if (same_file && depth->choice.part == color.part) {
        frame.depth.resize(count);
        frame.stored->to_floats(depth->choice.channel, frame.depth.data(), 1);
        scale_by(depth->choice.scale, frame.depth);
        return frame;
    }
    const ImageFile &source = same_file ? frame.file : *depth->file;
    const std::vector<float> values = read_depth(source, depth->choice);
    frame.depth = place(values, 1, source.part(depth->choice.part).data_window, part.data_window,
                        std::numeric_limits<float>::infinity(), frame.outside_depth_window);
    return frame;
}

void associate_alpha(Frame &frame)
{
    for (std::size_t i = 0; frame.channels == 4 && i < frame.pixels.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            frame.pixels[i + c] *= frame.pixels[i + 3];
}

void dissociate_alpha(Frame &frame)
{
    for (std::size_t i = 0; frame.channels == 4 && i < frame.pixels.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            frame.pixels[i + c] /= frame.pixels[i + 3] > 0 ? frame.pixels[i + 3] : 1.0f;
}

}  // namespace brume::tool
