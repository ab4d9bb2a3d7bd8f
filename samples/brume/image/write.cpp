#include "image/write.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>
#include <half.h>
#include <oneapi/tbb/parallel_for.h>

#include "exr/file.hpp"
#include "exr/new_file.hpp"
#include "exr/rewrite.hpp"
#include "image/arrays.hpp"
#include "image/formats.hpp"
#include "image/library.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

struct Channels {
    std::vector<std::string> names;
    std::vector<std::size_t> at;  ///< among the frame's
};

Channels channels_of(const Frame &frame, bool with_alpha)
{
    Channels channels;
    if (frame.color.luminance)
        channels = {{"Y"}, {0}};
    else
        channels = {{"R", "G", "B"}, {0, 1, 2}};
    if (with_alpha && frame.channels == 4) {
        channels.names.push_back("A");
        channels.at.push_back(3);
    }
    return channels;
}

/// What the frame's file says of itself, where it still holds.
Metadata carried_from(const Frame &frame, const WriteOptions &options, SampleType type)
{
    if (!options.metadata)
        return {};
    const bool alike = is_normalized(type) == is_normalized(frame.color.type_in(frame.file));
    return carried(frame.file.source().metadata(frame.color.part), alike && !options.primaries_changed);
}

WriteReport write_new(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                      SampleType type, const WriteOptions &options)
{
    NewPicture picture{frame.part().data_window, frame.part().display_window, frame.part().pixel_aspect, {}};
    const Channels channels = channels_of(frame, true);
    for (std::size_t i = 0; i < channels.names.size(); ++i)
        picture.channels.push_back(
            {channels.names[i], type, frame.pixels.data() + channels.at[i], std::size_t(frame.channels)});
    for (const AddedLayer &layer : layers)
        for (int c = 0; c < layer.channels; ++c)
            picture.channels.push_back({fmt::format("brume.{}.{}", layer.name, layer.channels == 1 ? 'Y' : "RGB"[c]),
                                        layer.type, layer.pixels.data() + c, std::size_t(layer.channels)});
    picture.chromaticities = options.chromaticities;
    picture.metadata = carried_from(frame, options, type);
    put_provenance(picture.metadata, options.provenance, "openexr");
    WriteReport report;
    report.clamped = write_new_exr(output, picture);
    if (report.clamped > 0)
        report.warnings.push_back(fmt::format("{} values clamped to 65504, the largest of a half", report.clamped));
    return report;
}

/// Uniform in [0, 1): the same for a pixel's channel in every picture, and without a pattern that can be seen.
float threshold(std::uint32_t pixel, std::uint32_t channel)
{
    std::uint32_t h = pixel * 0x9e3779b1u + channel * 0x85ebca77u + 0x27d4eb2fu;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    h ^= h >> 15;
    return float(h >> 8) * 0x1p-24f;
}

/// Integers that are a share of the largest. With `dithered`, what lies between two becomes either by its distance, so that
/// slopes stay slopes; what is an integer but for rounding stays it. Of fewer bits than T has, each is repeated below.
template <class T>
void to_integers(const Frame &frame, const Channels &channels, bool dithered, int bits, std::vector<char> &bytes,
                 std::atomic<std::uint64_t> &clipped)
{
    constexpr int kBits = std::numeric_limits<T>::digits;
    constexpr float kExact = 1 / 64.0f;
    const float most = float((1u << bits) - 1);
    const auto widened = [&](T value) {
        return bits == kBits ? value : T(value << (kBits - bits) | value >> (2 * bits - kBits));
    };
    const std::size_t n = channels.at.size(), width = std::size_t(frame.width);
    bytes.resize(width * std::size_t(frame.height) * n * sizeof(T));
    auto *out = reinterpret_cast<T *>(bytes.data());
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(frame.height), [&](std::size_t y) {
        std::uint64_t beyond = 0;
        for (std::size_t i = y * width; i < (y + 1) * width; ++i)
            for (std::size_t c = 0; c < n; ++c) {
                const float value = frame.pixels[i * std::size_t(frame.channels) + channels.at[c]] * most;
                if (!(value > -0.5f && value < most + 0.5f)) {
                    ++beyond;
                    out[i * n + c] = value > 0 ? std::numeric_limits<T>::max() : T(0);
                    continue;
                }
                const float nearest = std::round(value);
                const bool exact = !dithered || channels.names[c] == "A" || std::abs(value - nearest) < kExact;
                const float chosen = exact ? nearest : std::floor(value + threshold(std::uint32_t(i), std::uint32_t(c)));
                out[i * n + c] = widened(T(std::clamp(chosen, 0.0f, most)));
            }
        clipped += beyond;
    });
}

template <class T> void to_floats(const Frame &frame, const Channels &channels, std::vector<char> &bytes)
{
    const std::size_t n = channels.at.size(), count = std::size_t(frame.width) * std::size_t(frame.height);
    bytes.resize(count * n * sizeof(T));
    auto *out = reinterpret_cast<T *>(bytes.data());
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < n; ++c)
            out[i * n + c] = T(frame.pixels[i * std::size_t(frame.channels) + channels.at[c]]);
}

/// Of all parts, what the picture's colour is not.
std::size_t other_channels(const Frame &frame)
{
    std::size_t count = 0;
    for (const PartInfo &part : frame.file.parts())
        count += part.channels.size();
    return count - (frame.color.luminance ? 1 : 3) - !frame.color.alpha.empty();
}

WriteReport write_raster(const Frame &frame, const std::filesystem::path &output, const Format &format, SampleType type,
                         const WriteOptions &options)
{
    WriteReport report;
    const bool grey_array = is_array(format) && frame.color.luminance, has_alpha = format.has_alpha && !grey_array;
    const Channels channels = channels_of(frame, has_alpha);
    Raster raster{frame.width, frame.height, channels.names, type};
    raster.color_space = options.color_space;
    raster.straight_alpha = is_normalized(type);
    raster.pixel_aspect = frame.part().pixel_aspect;
    // Film's ten bits stay ten.
    if (std::string_view(format.name) == "dpx" && type == SampleType::kUint16 && options.type.empty())
        raster.bits = frame.file.source().bits;
    std::vector<char> bytes;
    std::atomic<std::uint64_t> clipped{0};
    switch (type) {
    case SampleType::kUint8:
        to_integers<std::uint8_t>(frame, channels, !options.untouched, 8, bytes, clipped);
        break;
    case SampleType::kUint16:
        to_integers<std::uint16_t>(frame, channels, false, raster.bits ? raster.bits : 16, bytes, clipped);
        break;
    case SampleType::kHalf:
        to_floats<half>(frame, channels, bytes);
        break;
    default:
        to_floats<float>(frame, channels, bytes);
        break;
    }
    raster.pixels = bytes.data();
    report.clamped = clipped;
    if (clipped > 0)
        report.warnings.push_back(
            fmt::format("{} values beyond 0 to 1, all that {} holds, were clipped", report.clamped, name_of(type)));
    if (frame.channels == 4 && !has_alpha)
        report.warnings.push_back(
            fmt::format("alpha is not written: {}{} has none", grey_array ? "grey " : "", format.name));
    if (const std::size_t others = other_channels(frame))
        report.warnings.push_back(fmt::format("{} other channels stay behind: {} holds the colour", others, format.name));
    if (frame.part().data_window != frame.part().display_window)
        report.warnings.push_back(fmt::format("{} has no windows: the data window's {} x {} pixels are written", format.name,
                                              frame.width, frame.height));
    const Metadata own = carried_from(frame, options, type);
    raster.metadata = own;
    put_provenance(raster.metadata, options.provenance, format.name);
    PendingFile pending(output);
    std::vector<std::string> lost;
    if (is_array(format)) {
        write_array(pending.path(), output.string(), format, raster);
        for (const Attribute &attribute : own)
            if (attribute.name != "YResolution" && attribute.name != "ResolutionUnit")
                lost.push_back(attribute.name);
    } else {
        lost = image_library().write(pending.path(), output.string(), format.name, raster);
    }
    std::erase_if(lost, [&](const std::string &name) { return !find(own, name); });
    if (!lost.empty())
        report.warnings.push_back(
            fmt::format("{} does not keep what the picture says of itself: {}", format.name, fmt::join(lost, ", ")));
    // The library has reported success with nothing on a full disk.
    if (std::error_code error; std::filesystem::file_size(pending.path(), error) == 0 || error)
        throw FrameError(fmt::format("{}: cannot be written: nothing arrived on the disk", output.string()));
    pending.commit();
    return report;
}

}  // namespace

void write_display(const Display &picture, const std::filesystem::path &output)
{
    Raster raster{picture.width, picture.height, {"R", "G", "B"}, SampleType::kUint8, picture.rgb.data()};
    raster.color_space = "sRGB";
    PendingFile pending(output);
    image_library().write(pending.path(), output.string(), "png", raster);
    pending.commit();
}

void write_layer(const Frame &frame, const AddedLayer &layer, const std::filesystem::path &output)
{
    const Format *format = format_of(output);
    Frame alone{frame.file, frame.color, nullptr, frame.width, frame.height, layer.channels, {}, {}, 0};
    alone.pixels = layer.pixels;
    alone.color.luminance = true;
    for (std::size_t i = 0; i < alone.pixels.size() && alone.color.luminance; ++i)
        alone.color.luminance = alone.pixels[i] == alone.pixels[i - i % std::size_t(layer.channels)];
    const SampleType type = format->has(SampleType::kFloat)    ? SampleType::kFloat
                            : format->has(SampleType::kUint16) ? SampleType::kUint16
                                                               : SampleType::kUint8;
    WriteOptions options;
    options.color_space = "Linear";
    options.metadata = false;
    if (is_exr(*format))
        write_new(alone, {}, output, type, options);
    else
        write_raster(alone, output, *format, type, options);
}

bool writes_straight_alpha(const Frame &frame, const std::filesystem::path &output, const std::string &type)
{
    const Format *format = format_of(output);
    return format && is_normalized(type_to_write(output.string(), frame.color.type_in(frame.file), type));
}

WriteReport write_frame(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                        const WriteOptions &options)
{
    const Format *format = format_of(output);
    if (!format || is_exr(*format)) {
        if (exr_of(frame.file))
            return rewrite_exr(frame, layers, output, options);
        const SampleType type =
            format ? type_to_write(output.string(), frame.color.type_in(frame.file), options.type) : SampleType::kHalf;
        return write_new(frame, layers, output, type, options);
    }
    const SampleType type = type_to_write(output.string(), frame.color.type_in(frame.file), options.type);
    return write_raster(frame, output, *format, type, options);
}

}  // namespace brume::tool
