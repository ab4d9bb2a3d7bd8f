#include "exr/write.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <ImfChannelList.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfDeepTiledInputPart.h>
#include <ImfDeepTiledOutputPart.h>
#include <ImfInputPart.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>
#include <fmt/format.h>
#include <half.h>
#include <oneapi/tbb/parallel_for.h>

#include "exr/output_stream.hpp"
#include "exr/planes.hpp"
#include "support/error.hpp"
#include "support/pending_file.hpp"

namespace brume::tool {
namespace {

/// What stands before a channel's name in this frame's view: nothing for the default one.
std::string view_prefix(const Frame &frame)
{
    return frame.color.view.empty() || frame.color.view == frame.file.default_view() || !frame.part().view.empty()
            ? ""
            : frame.color.view + ".";
}

constexpr float kHalfMax = 65504.0f;

/// What describes the old pixels and would be false of the new ones.
constexpr const char *kStaleAttributes[] = {"preview", "oiio:SHA-1", "oiio:AverageColor", "oiio:ConstantColor",
                                            "SHA-1",   "md5",        "checksum",          kProvenance};

Plane from_floats(const ChannelInfo &channel, const float *in, std::size_t count, std::size_t stride,
                  std::atomic<std::uint64_t> &clamped)
{
    Plane plane{channel, std::make_unique_for_overwrite<char[]>(count * pixel_bytes(channel.type)),
                pixel_bytes(channel.type)};
    oneapi::tbb::parallel_for(std::size_t(0), (count + kGrain - 1) / kGrain, [&](std::size_t block) {
        const std::size_t from = block * kGrain, to = std::min(count, from + kGrain);
        if (channel.type == Imf::FLOAT) {
            auto *out = reinterpret_cast<float *>(plane.bytes.get());
            for (std::size_t i = from; i < to; ++i)
                out[i] = in[i * stride];
            return;
        }
        auto *out = reinterpret_cast<half *>(plane.bytes.get());
        std::uint64_t over = 0;
        for (std::size_t i = from; i < to; ++i) {
            const float value = in[i * stride];
            const bool too_large = std::isfinite(value) && std::abs(value) > kHalfMax;
            over += too_large;
            out[i] = half(too_large ? std::copysign(kHalfMax, value) : value);
        }
        clamped += over;
    });
    return plane;
}

/// The colour's planes hold what came in; these hold what goes out in their place, and the added layers.
std::vector<Plane> outgoing_planes(const Frame &frame, const std::vector<AddedLayer> &layers, std::uint64_t &clamped_out)
{
    std::atomic<std::uint64_t> clamped{0};
    const std::size_t count = std::size_t(frame.width) * std::size_t(frame.height);
    const auto channel = [&](const std::string &name) { return *frame.part().find(name); };
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < (frame.color.luminance ? 1u : 3u); ++i)
        planes.push_back(
            from_floats(channel(frame.color.rgb[i]), frame.pixels.data() + i, count, std::size_t(frame.channels), clamped));

    const std::string view = view_prefix(frame);
    for (const AddedLayer &layer : layers)
        for (int c = 0; c < layer.channels; ++c) {
            const std::string base = layer.channels == 1 ? "Y" : std::string(1, "RGB"[c]);
            ChannelInfo info{fmt::format("brume.{}.{}{}", layer.name, view, base), "", "", base, layer.type, {1, 1}};
            planes.push_back(from_floats(info, layer.pixels.data() + c, count, std::size_t(layer.channels), clamped));
        }
    clamped_out = clamped;
    return planes;
}

const Plane *find_plane(const std::vector<Plane> &planes, const std::string &name)
{
    const auto at = std::find_if(planes.begin(), planes.end(), [&](const Plane &p) { return p.channel.name == name; });
    return at == planes.end() ? nullptr : &*at;
}

/// Layers that an earlier run added to this view tell of another medium.
Imf::ChannelList without_own_layers(const Imf::ChannelList &channels, const std::string &view)
{
    Imf::ChannelList kept;
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        const std::string name = c.name(), own = "brume.";
        const std::size_t dot = name.find('.', own.size());
        const bool stale = name.starts_with(own) && dot != std::string::npos && name.size() == dot + 1 + view.size() + 1 &&
                           name.compare(dot + 1, view.size(), view) == 0;
        if (!stale)
            kept.insert(c.name(), c.channel());
    }
    return kept;
}

Imf::Header header_of_rewritten(const Frame &frame, const std::vector<Plane> &outgoing, const WriteOptions &options,
                                std::vector<std::string> &warnings)
{
    Imf::Header header = frame.file.header(frame.color.part);
    for (const char *name : kStaleAttributes)
        header.erase(name);
    if (!options.provenance.empty())
        header.insert(kProvenance, Imf::StringAttribute(options.provenance));
    header.channels() = without_own_layers(header.channels(), view_prefix(frame));
    if (options.primaries_changed)
        header.erase("chromaticities");
    for (const Plane &plane : outgoing)
        if (!header.channels().findChannel(plane.channel.name) || plane.channel.name.starts_with("brume."))
            header.channels().insert(plane.channel.name, Imf::Channel(plane.channel.type));
    if (frame.part().tiled && header.tileDescription().mode != Imf::ONE_LEVEL) {
        header.tileDescription().mode = Imf::ONE_LEVEL;
        warnings.push_back("mipmap levels are not kept: they would show the picture without fog");
    }
    for (const Plane &plane : frame.planes)
        if (!find_plane(outgoing, plane.channel.name) && is_lossy_for(header.compression(), plane.channel.type)) {
            warnings.push_back(
                fmt::format("channels beside the colour, {} among them, are stored with a lossy compression and lose "
                            "one more generation",
                            plane.channel.name));
            break;
        }
    return header;
}

void write_pixels(Imf::MultiPartOutputFile &file, const Frame &frame, const std::vector<Plane> &outgoing)
{
    const PartInfo &part = frame.part();
    Imf::FrameBuffer buffer;
    for (const Plane &plane : frame.planes)
        if (!find_plane(outgoing, plane.channel.name))
            buffer.insert(plane.channel.name, slice_of(plane, part.data_window));
    for (const Plane &plane : outgoing)
        buffer.insert(plane.channel.name, slice_of(plane, part.data_window));
    if (part.tiled) {
        Imf::TiledOutputPart output(file, part.index);
        output.setFrameBuffer(buffer);
        output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
    } else {
        Imf::OutputPart output(file, part.index);
        output.setFrameBuffer(buffer);
        output.writePixels(part.height());
    }
}

template <class Input, class Output> void copy_as(const ExrFile &from, Imf::MultiPartOutputFile &to, int part)
{
    Input input(from.imf(), part);
    Output(to, part).copyPixels(input);
}

void copy_undecoded(const ExrFile &from, Imf::MultiPartOutputFile &to, const PartInfo &part)
{
    from.guarded(fmt::format("copying {}", part.label()), [&] {
        if (part.deep && part.tiled)
            copy_as<Imf::DeepTiledInputPart, Imf::DeepTiledOutputPart>(from, to, part.index);
        else if (part.deep)
            copy_as<Imf::DeepScanLineInputPart, Imf::DeepScanLineOutputPart>(from, to, part.index);
        else if (part.tiled)
            copy_as<Imf::TiledInputPart, Imf::TiledOutputPart>(from, to, part.index);
        else
            copy_as<Imf::InputPart, Imf::OutputPart>(from, to, part.index);
    });
}

}  // namespace

WriteReport write_frame(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                        const WriteOptions &options)
{
    WriteReport report;
    const std::vector<Plane> outgoing = outgoing_planes(frame, layers, report.clamped);
    if (report.clamped > 0)
        report.warnings.push_back(fmt::format("{} values beyond 65504 clamped to fit half", report.clamped));

    std::vector<Imf::Header> headers;
    for (const PartInfo &part : frame.file.parts()) {
        const bool rewritten = part.index == frame.color.part;
        headers.push_back(rewritten ? header_of_rewritten(frame, outgoing, options, report.warnings)
                                    : frame.file.header(part.index));
        // Shared attributes must agree in all parts.
        if (options.primaries_changed)
            headers.back().erase("chromaticities");
    }

    PendingFile pending(output);
    OutputStream stream(pending.path().string(), output.string());
    try {
        Imf::MultiPartOutputFile file(stream, headers.data(), int(headers.size()));
        for (const PartInfo &part : frame.file.parts())
            if (part.index == frame.color.part)
                write_pixels(file, frame, outgoing);
            else
                copy_undecoded(frame.file, file, part);
    } catch (const FrameError &) {
        throw;
    } catch (const std::exception &e) {
        throw FrameError(fmt::format("{}: writing: {}", output.string(), e.what()));
    }
    stream.close();
    pending.commit();
    return report;
}

}  // namespace brume::tool
