#include "exr/file.hpp"

#include <algorithm>
#include <new>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <half.h>
#include <oneapi/tbb/parallel_for.h>

#include "exr/metadata.hpp"
#include "exr/planes.hpp"
#include "support/error.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

SampleType type_of(Imf::PixelType type)
{
    return type == Imf::HALF ? SampleType::kHalf : type == Imf::UINT ? SampleType::kUint : SampleType::kFloat;
}

/// The standard puts the view just before the base name; some writers put it first. A view's name anywhere before the
/// base names the view, and channels without one belong to the default view.
ChannelInfo take_apart(const std::string &name, const Imf::Channel &channel, const std::vector<std::string> &views,
                       const std::string &part_view)
{
    ChannelInfo info{name, "", part_view, "", type_of(channel.type), {channel.xSampling, channel.ySampling}};
    auto components = split(name, '.');
    info.base = components.back();
    components.pop_back();
    if (!views.empty()) {
        const auto is_view = [&](const std::string &c) { return std::find(views.begin(), views.end(), c) != views.end(); };
        const auto at = std::find_if(components.begin(), components.end(), is_view);
        if (at != components.end()) {
            info.view = *at;
            components.erase(at);
        } else if (info.view.empty()) {
            info.view = views.front();
        }
    }
    info.layer = fmt::format("{}", fmt::join(components, "."));
    return info;
}

Window window_of(const Imath::Box2i &w)
{
    return {{w.min.x, w.min.y}, {w.max.x, w.max.y}};
}

template <class Matrix> std::vector<double> elements_of(const Matrix &m)
{
    std::vector<double> elements;
    for (int i = 0; i < 16; ++i)
        elements.push_back(double(m[i / 4][i % 4]));
    return elements;
}

std::vector<double> numbers_of(const Imf::Attribute &attribute)
{
    if (const auto *f = dynamic_cast<const Imf::FloatAttribute *>(&attribute))
        return {double(f->value())};
    if (const auto *d = dynamic_cast<const Imf::DoubleAttribute *>(&attribute))
        return {d->value()};
    if (const auto *i = dynamic_cast<const Imf::IntAttribute *>(&attribute))
        return {double(i->value())};
    if (const auto *m = dynamic_cast<const Imf::M44fAttribute *>(&attribute))
        return elements_of(m->value());
    if (const auto *m = dynamic_cast<const Imf::M44dAttribute *>(&attribute))
        return elements_of(m->value());
    return {};
}

Plane allocate_plane(const ChannelInfo &channel, const PartInfo &part)
{
    Plane plane{channel, nullptr, bytes_of(channel.type)};
    plane.bytes = std::make_unique_for_overwrite<char[]>(plane_bytes(channel, part.data_window));
    return plane;
}

}  // namespace

PartInfo part_of(const Imf::Header &h, int index)
{
    PartInfo part;
    part.index = index;
    if (h.hasName())
        part.name = h.name();
    if (h.hasView())
        part.view = h.view();
    part.data_window = window_of(h.dataWindow());
    part.display_window = window_of(h.displayWindow());
    part.pixel_aspect = double(h.pixelAspectRatio());
    const std::string type = h.hasType() ? h.type() : "";
    part.deep = Imf::isDeepData(type);
    part.tiled = Imf::isTiled(type) || (type.empty() && h.hasTileDescription());
    const std::vector<std::string> views = Imf::hasMultiView(h) ? Imf::multiView(h) : Imf::StringVector{};
    for (auto c = h.channels().begin(); c != h.channels().end(); ++c) {
        part.channels.push_back(take_apart(c.name(), c.channel(), views, part.view));
        part.channels.back().lossy = is_lossy_for(h.compression(), part.channels.back());
    }
    for (auto at = h.begin(); at != h.end(); ++at)
        part.attributes[at.name()] = numbers_of(at.attribute());
    if (Imf::hasChromaticities(h)) {
        const Imf::Chromaticities &c = Imf::chromaticities(h);
        part.chromaticities = Chromaticities{c.red, c.green, c.blue, c.white};
    }
    return part;
}

bool is_lossy_for(Imf::Compression compression, const ChannelInfo &channel)
{
    const SampleType type = channel.type;
    const std::string &base = channel.base;
    switch (compression) {
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
        return type == SampleType::kHalf;
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
        return type != SampleType::kUint &&
               (base == "R" || base == "G" || base == "B" || base == "Y" || base == "RY" || base == "BY");
    case Imf::PXR24_COMPRESSION:
        return type == SampleType::kFloat;
    default:
        return false;
    }
}

void ExrPixels::to_floats(const std::string &channel, float *out, std::size_t stride) const
{
    const Plane &plane =
        *std::find_if(planes.begin(), planes.end(), [&](const Plane &p) { return p.channel.name == channel; });
    const std::size_t count = std::size_t(window_.width()) * std::size_t(window_.height());
    oneapi::tbb::parallel_for(std::size_t(0), (count + kGrain - 1) / kGrain, [&](std::size_t block) {
        const std::size_t from = block * kGrain, to = std::min(count, from + kGrain);
        const auto convert = [&](const auto *in) {
            for (std::size_t i = from; i < to; ++i)
                out[i * stride] = float(in[i]);
        };
        switch (plane.channel.type) {
        case SampleType::kHalf:
            convert(reinterpret_cast<const half *>(plane.bytes.get()));
            break;
        case SampleType::kFloat:
            convert(reinterpret_cast<const float *>(plane.bytes.get()));
            break;
        default:
            convert(reinterpret_cast<const std::uint32_t *>(plane.bytes.get()));
            break;
        }
    });
}

Imf::PixelType exr_type(SampleType type)
{
    return type == SampleType::kHalf ? Imf::HALF : type == SampleType::kUint ? Imf::UINT : Imf::FLOAT;
}

Imath::Box2i exr_window(const Window &w)
{
    return {{w.min.x, w.min.y}, {w.max.x, w.max.y}};
}

Imf::Chromaticities exr_chromaticities(const Chromaticities &c)
{
    return {c.red, c.green, c.blue, c.white};
}

const ExrSource *exr_of(const ImageFile &file)
{
    return dynamic_cast<const ExrSource *>(&file.source());
}

void set_exr_threads(int threads)
{
    Imf::setGlobalThreadCount(threads);
}

ExrSource::ExrSource(std::filesystem::path path, const ReadLimits &limits) : path_(std::move(path))
{
    precheck_headers(path_, limits);
    guarded("reading headers", [&] { file_ = std::make_unique<Imf::MultiPartInputFile>(path_.c_str()); });
    guarded("reading headers", [&] {
        for (int index = 0; index < file_->parts(); ++index) {
            const Imf::Header &h = file_->header(index);
            parts.push_back(part_of(h, index));
            if (default_view.empty())
                default_view =
                    Imf::hasMultiView(h) && !Imf::multiView(h).empty() ? Imf::multiView(h).front() : parts.back().view;
        }
    });
}

std::unique_ptr<StoredPixels> ExrSource::read(int index, const std::vector<std::string> &channels) const
{
    const PartInfo &part = parts[std::size_t(index)];
    auto pixels = std::make_unique<ExrPixels>(part.data_window);
    for (const std::string &channel : channels)
        pixels->planes.push_back(allocate_plane(*part.find(channel), part));
    guarded(fmt::format("reading {}", part.label()), [&] {
        Imf::InputPart input(*file_, index);
        Imf::FrameBuffer buffer;
        for (Plane &plane : pixels->planes)
            buffer.insert(plane.channel.name, slice_of(plane, part.data_window));
        input.setFrameBuffer(buffer);
        input.readPixels(part.data_window.min.y, part.data_window.max.y);
    });
    return pixels;
}

Metadata ExrSource::metadata(int part) const
{
    return metadata_of(header(part));
}

void ExrSource::rethrow(const std::string &doing, const std::exception &e) const
{
    if (dynamic_cast<const FrameError *>(&e))
        throw;
    if (dynamic_cast<const std::bad_alloc *>(&e))
        throw FrameError(fmt::format("{}: out of memory while {}", path_.string(), doing));
    // OpenEXR's messages name the file once more, over several lines.
    std::string what = e.what();
    for (const std::string named = " \"" + path_.string() + "\""; what.find(named) != std::string::npos;)
        what.erase(what.find(named), named.size());
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw FrameError(fmt::format("{}: {}: {}", path_.string(), doing, what));
}

}  // namespace brume::tool
