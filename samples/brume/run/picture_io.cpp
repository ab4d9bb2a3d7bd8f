#include "run/picture_io.hpp"

#include <cmath>

#include <fmt/format.h>

#include "run/sequence.hpp"

namespace brume::tool {
namespace {

/// A grey picture travels as RGB; what comes back is its luminance.
void merge_luminance(Frame &frame, const LuminanceWeights &w)
{
    for (std::size_t i = 0; i < frame.pixels.size(); i += std::size_t(frame.channels)) {
        float *p = &frame.pixels[i];
        if (p[0] != p[1] || p[0] != p[2])
            p[0] = float(w[0] * p[0] + w[1] * p[1] + w[2] * p[2]);
    }
}

std::uint64_t count_not_finite(const Frame &frame)
{
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < frame.pixels.size(); i += std::size_t(frame.channels)) {
        const float *p = &frame.pixels[i];
        count += !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]);
    }
    return count;
}

}  // namespace

Frame PictureIo::read(const Fogger &fogger, LuminanceWeights &weights, FrameStats &stats) const
{
    const PictureOptions &picture = request_.picture;
    std::vector<std::string> &warnings = stats.warnings;
    OpenFrame open = open_frame(stats.files, picture, request_.limits);
    check_space(open.file, request_.asked, spaces_);
    const ImageFile *depth_file = open.depth_file ? &*open.depth_file : nullptr;
    const DepthSource depth{depth_file, open.depth};
    stats.color = fmt::format("{}: {}", open.color.label(), open.color.reason);
    stats.depth =
        fmt::format("{}{}: {}", depth_file ? depth_file->path().string() + ":" : "", open.depth.channel, open.depth.reason);
    const ChannelInfo depth_channel = *(depth_file ? *depth_file : open.file).part(open.depth.part).find(open.depth.channel);
    if (depth_channel.lossy)
        warnings.push_back(
            fmt::format("depth '{}' is stored with a lossy compression: edges may show it", open.depth.channel));
    if (depth_channel.type == SampleType::kUint8)
        warnings.push_back(fmt::format("depth '{}' has 8 bits: its steps show as bands", open.depth.channel));
    const std::vector<std::string> &notes = open.file.source().notes;
    warnings.insert(warnings.end(), notes.begin(), notes.end());
    for (const std::string &view : other_views(open.file, open.color))
        warnings.push_back(fmt::format("the picture's view '{}' stays without fog (--view {} fogs that one)", view, view));
    weights = colors_.luminance_weights(open.file.part(open.color.part), &warnings);
    const std::vector<OpenInput> inputs = fogger.open_inputs(open.file, open.color, stats.files.frame, request_.limits);
    Frame frame = read_frame(std::move(open.file), open.color, &depth);
    for (const OpenInput &input : inputs) {
        const bool with_color = !input.file && input.choice.part == frame.color.part;
        frame.inputs.push_back(
            fogger.read_pixels(input, frame.file, frame.part(), with_color ? frame.stored.get() : nullptr));
        stats.inputs.emplace_back(name_of(input), description(input));
        if (frame.inputs.back().outside > 0)
            warnings.push_back(fmt::format("{} pixels are outside the data window of the input {} and count as {}",
                                           frame.inputs.back().outside, input.choice.role,
                                           input.choice.role == "transmittance" ? 1 : 0));
    }
    stats.pixels = std::uint64_t(frame.width) * std::uint64_t(frame.height);
    stats.not_finite_pixels = count_not_finite(frame);
    stats.outside_depth_window = frame.outside_depth_window;
    const DepthKind kind = picture.depth_kind();
    stats.depth_count = count_depth(frame.depth, kind, picture.far);
    kind.convert(frame.depth);
    for (std::string &warning : depth_warnings(stats.depth_count, kind, picture.far, depth_channel.type))
        warnings.push_back(std::move(warning));
    if (frame.outside_depth_window > 0)
        warnings.push_back(
            fmt::format("{} pixels lie outside the depth's data window and count as far", frame.outside_depth_window));
    if (stats.not_finite_pixels > 0)
        warnings.push_back(
            fmt::format("{} pixels have a colour that is not finite (NaN or infinite)", stats.not_finite_pixels));
    colors_.to_working(frame.pixels.data(), stats.pixels, frame.channels);
    if (frame.file.source().straight_alpha)
        associate_alpha(frame);
    return frame;
}

void PictureIo::write(Frame &frame, const std::vector<AddedLayer> &layers, const LuminanceWeights &weights,
                      const std::string &provenance, FrameStats &stats) const
{
    if (frame.color.luminance)
        merge_luminance(frame, weights);
    WriteOptions how;
    how.type = request_.output_type;
    how.provenance = provenance;
    if (writes_straight_alpha(frame, stats.files.output, how.type))
        dissociate_alpha(frame);
    colors_.from_working(frame.pixels.data(), stats.pixels, frame.channels);
    how.primaries_changed = colors_.changes_space();
    how.chromaticities = colors_.new_chromaticities();
    how.color_space = colors_.said_of_output();
    how.untouched = stats.fog.nothing_to_do && layers.empty() && !colors_.changes_space();
    how.decoded = colors_.converts();
    const WriteReport report = write_frame(frame, layers, stats.files.output, how);
    stats.clamped_values = report.clamped;
    stats.warnings.insert(stats.warnings.end(), report.warnings.begin(), report.warnings.end());
}

}  // namespace brume::tool
