#include "exr/rewrite.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include <ImfChannelList.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfDeepTiledInputPart.h>
#include <ImfDeepTiledOutputPart.h>
#include <ImfFloatAttribute.h>
#include <ImfInputPart.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>
#include <fmt/format.h>

#include "exr/output_stream.hpp"
#include "exr/planes.hpp"

namespace brume::tool {
namespace {

/// What stands before a channel's name in this frame's view: nothing for the default one.
std::string view_prefix(const Frame &frame)
{
    return frame.color.view.empty() || frame.color.view == frame.file.default_view() || !frame.part().view.empty()
               ? ""
               : frame.color.view + ".";
}

/// What was read, in files of OpenEXR's.
const std::vector<Plane> &stored_planes(const Frame &frame)
{
    return dynamic_cast<const ExrPixels &>(*frame.stored).planes;
}

/// Of a converted colour.
constexpr const char *kSpaceAttributes[] = {"chromaticities", "acesImageContainerFlag", "adoptedNeutral", "colorInteropID",
                                            "oiio:ColorSpace"};

/// What the largest value may be so that it is finite when it is read again. DWA stores both types as halves, and an error
/// of its quantisation, which grows with the level, must not carry them beyond.
float largest_of(const Imf::Header &header, const ChannelInfo &channel)
{
    const bool dwa = header.compression() == Imf::DWAA_COMPRESSION || header.compression() == Imf::DWAB_COMPRESSION;
    if (dwa && is_lossy_for(header.compression(), channel))
        return kHalfMax * std::exp(-0.02f - 0.001f * header.dwaCompressionLevel());
    return largest_finite(channel.type);
}

/// The library codes at its default unless it is told what it has read.
void keep_dwa_level(Imf::Header &header)
{
    if (const auto *level = header.findTypedAttribute<Imf::FloatAttribute>("dwaCompressionLevel"))
        header.dwaCompressionLevel() = level->value();
}

/// What describes the old pixels and would be false of the new ones.
constexpr const char *kStaleAttributes[] = {"preview", "oiio:SHA-1", "oiio:AverageColor", "oiio:ConstantColor",
                                            "SHA-1",   "md5",        "checksum"};

/// The colour's planes hold what came in; these hold what goes out in their place, and the added layers.
std::vector<Plane> outgoing_planes(const Frame &frame, const ExrSource &exr, const std::vector<AddedLayer> &layers,
                                   std::uint64_t &clamped_out)
{
    std::atomic<std::uint64_t> clamped{0};
    const std::size_t count = std::size_t(frame.width) * std::size_t(frame.height);
    Imf::Header header = exr.header(frame.color.part);
    keep_dwa_level(header);
    const auto channel = [&](const std::string &name) { return *frame.part().find(name); };
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < (frame.color.luminance ? 1u : 3u); ++i) {
        const ChannelInfo info = channel(frame.color.rgb[i]);
        planes.push_back(plane_of_floats(info, largest_of(header, info), frame.pixels.data() + i, count,
                                         std::size_t(frame.channels), clamped));
    }

    const std::string view = view_prefix(frame);
    for (const AddedLayer &layer : layers)
        for (int c = 0; c < layer.channels; ++c) {
            const std::string base = layer.channels == 1 ? "Y" : std::string(1, "RGB"[c]);
            ChannelInfo info{fmt::format("brume.{}.{}{}", layer.name, view, base), "", "", base, layer.type, kFullSize};
            planes.push_back(plane_of_floats(info, largest_of(header, info), layer.pixels.data() + c, count,
                                             std::size_t(layer.channels), clamped));
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

Imf::Header header_of_rewritten(const Frame &frame, const ExrSource &exr, const std::vector<Plane> &outgoing,
                                const WriteOptions &options, std::vector<std::string> &warnings)
{
    Imf::Header header = exr.header(frame.color.part);
    keep_dwa_level(header);
    for (const char *name : kStaleAttributes)
        header.erase(name);
    header.channels() = without_own_layers(header.channels(), view_prefix(frame));
    if (options.primaries_changed)
        for (const char *name : kSpaceAttributes)
            header.erase(name);
    for (const Plane &plane : outgoing)
        if (!header.channels().findChannel(plane.channel.name) || plane.channel.name.starts_with("brume."))
            header.channels().insert(plane.channel.name, Imf::Channel(exr_type(plane.channel.type)));
    if (frame.part().tiled && header.tileDescription().mode != Imf::ONE_LEVEL) {
        header.tileDescription().mode = Imf::ONE_LEVEL;
        warnings.push_back("mipmap levels are not kept: they would show the picture without fog");
    }
    for (const Plane &plane : stored_planes(frame))
        if (!find_plane(outgoing, plane.channel.name) && is_lossy_for(header.compression(), plane.channel)) {
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
    for (const Plane &plane : stored_planes(frame))
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

template <class Input, class Output> void copy_as(const ExrSource &from, Imf::MultiPartOutputFile &to, int part)
{
    Input input(from.imf(), part);
    Output(to, part).copyPixels(input);
}

void copy_undecoded(const ExrSource &from, Imf::MultiPartOutputFile &to, const PartInfo &part)
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

WriteReport rewrite_exr(const Frame &frame, const std::vector<AddedLayer> &layers, const std::filesystem::path &output,
                        const WriteOptions &options)
{
    const ExrSource &exr = *exr_of(frame.file);
    WriteReport report;
    const Imf::Header &old = exr.header(frame.color.part);
    const bool copied =
        options.untouched && !options.decoded && without_own_layers(old.channels(), view_prefix(frame)) == old.channels();
    std::vector<Plane> outgoing;
    if (!copied)
        outgoing = outgoing_planes(frame, exr, layers, report.clamped);
    if (report.clamped > 0)
        report.warnings.push_back(
            fmt::format("{} values clamped to what stays finite in half, as it is stored (at most 65504)", report.clamped));

    // Shared attributes must agree in all parts, so they can only be said of the new colour where it is the only one.
    const bool alone = std::none_of(frame.file.parts().begin(), frame.file.parts().end(), [&](const PartInfo &part) {
        return part.index != frame.color.part &&
               std::any_of(part.channels.begin(), part.channels.end(), [](const ChannelInfo &c) { return c.base == "G"; });
    });
    std::vector<Imf::Header> headers;
    for (const PartInfo &part : frame.file.parts()) {
        const bool rewritten = part.index == frame.color.part && !copied;
        headers.push_back(rewritten ? header_of_rewritten(frame, exr, outgoing, options, report.warnings)
                                    : exr.header(part.index));
        keep_dwa_level(headers.back());
        if (part.index == frame.color.part) {
            headers.back().erase(kProvenance);
            if (!options.provenance.empty())
                headers.back().insert(kProvenance, Imf::StringAttribute(options.provenance));
        }
        if (options.primaries_changed)
            headers.back().erase("chromaticities");
        if (options.primaries_changed && options.chromaticities && alone)
            Imf::addChromaticities(headers.back(), exr_chromaticities(*options.chromaticities));
    }

    write_whole(output, [&](OutputStream &stream) {
        Imf::MultiPartOutputFile file(stream, headers.data(), int(headers.size()));
        for (const PartInfo &part : frame.file.parts())
            if (part.index == frame.color.part && !copied)
                write_pixels(file, frame, outgoing);
            else
                copy_undecoded(exr, file, part);
    });
    return report;
}

}  // namespace brume::tool
