#include "exr/header_changes.hpp"

#include <map>

#include <ImfAttribute.h>
#include <ImfBoxAttribute.h>
#include <ImfChannelList.h>
#include <ImfChannelListAttribute.h>
#include <ImfCompressionAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfLineOrderAttribute.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include "exr/file.hpp"
#include "image/write.hpp"
#include "support/text.hpp"

namespace brume::tool {
namespace {

using Texts = std::map<std::string, std::string>;

/// Of any attribute, those of types that nobody knows included.
std::string bytes_of(const Imf::Attribute &attribute)
{
    Imf::StdOSStream stream;
    attribute.writeValueTo(stream, Imf::EXR_VERSION);
    return stream.str();
}

std::string name_of(Imf::Compression compression)
{
    constexpr const char *names[] = {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
    return std::size_t(compression) < std::size(names) ? names[compression] : fmt::format("{}", int(compression));
}

/// Empty for types that have no short text.
std::string text_of(const Imf::Attribute &attribute)
{
    if (const auto *text = dynamic_cast<const Imf::StringAttribute *>(&attribute))
        return fmt::format("\"{}\"", printable(text->value()));
    if (const auto *number = dynamic_cast<const Imf::IntAttribute *>(&attribute))
        return fmt::format("{}", number->value());
    if (const auto *number = dynamic_cast<const Imf::FloatAttribute *>(&attribute))
        return fmt::format("{}", number->value());
    if (const auto *number = dynamic_cast<const Imf::DoubleAttribute *>(&attribute))
        return fmt::format("{}", number->value());
    if (const auto *box = dynamic_cast<const Imf::Box2iAttribute *>(&attribute))
        return fmt::format("({}, {}) to ({}, {})", box->value().min.x, box->value().min.y, box->value().max.x,
                           box->value().max.y);
    if (const auto *compression = dynamic_cast<const Imf::CompressionAttribute *>(&attribute))
        return name_of(compression->value());
    if (const auto *order = dynamic_cast<const Imf::LineOrderAttribute *>(&attribute))
        return order->value() == Imf::INCREASING_Y   ? "increasing y"
               : order->value() == Imf::DECREASING_Y ? "decreasing y"
                                                     : "random y";
    return "";
}

Texts channels_of(const Imf::Header &header)
{
    constexpr const char *types[] = {"uint", "half", "float"};
    Texts channels;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const Imf::Channel &channel = c.channel();
        std::string text = types[channel.type];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            text += fmt::format(", sampled {} x {}", channel.xSampling, channel.ySampling);
        channels[printable(c.name())] = text;
    }
    return channels;
}

/// Lines for what only one map has, and for what both have with another text.
void compare_texts(const Texts &a, const Texts &b, const std::string &what, std::vector<std::string> &lines)
{
    for (const auto &[name, text] : a)
        if (const auto at = b.find(name); at == b.end())
            lines.push_back(fmt::format("{} '{}' added: {}", what, name, text));
        else if (at->second != text)
            lines.push_back(fmt::format("{} '{}' is {}, was {}", what, name, text, at->second));
    for (const auto &[name, text] : b)
        if (!a.contains(name))
            lines.push_back(fmt::format("{} '{}' removed: {}", what, name, text));
}

void compare_headers(const Imf::Header &a, const Imf::Header &b, const std::string &part, std::vector<std::string> &lines)
{
    compare_texts(channels_of(a), channels_of(b), part + "channel", lines);
    const auto shown = [](const Imf::Attribute &attribute) {
        const std::string text = text_of(attribute);
        return text.empty() ? fmt::format("a {}", printable(attribute.typeName())) : text;
    };
    Texts of_a, of_b;
    for (auto at = a.begin(); at != a.end(); ++at)
        of_a[at.name()] = shown(at.attribute());
    for (auto at = b.begin(); at != b.end(); ++at) {
        of_b[at.name()] = shown(at.attribute());
        const auto same = a.find(at.name());
        if (same == a.end() || std::string(at.name()) == "channels")
            continue;
        if (of_a[at.name()] == of_b[at.name()] && bytes_of(same.attribute()) != bytes_of(at.attribute()))
            lines.push_back(fmt::format("{}attribute '{}' has another value", part, printable(at.name())));
    }
    compare_texts(of_a, of_b, part + "attribute", lines);
}

std::string provenance_of(const ImageFile &file)
{
    for (const PartInfo &part : file.parts())
        if (const std::string text = provenance_in(file.source().metadata(part.index)); !text.empty())
            return fmt::format("\"{}\"", printable(text));
    return "";
}

/// Of pictures that are no OpenEXR files: they have one part.
void compare_pictures(const ImageFile &a, const ImageFile &b, std::vector<std::string> &lines)
{
    const auto channels = [](const ImageFile &file) {
        Texts texts;
        for (const ChannelInfo &channel : file.part(0).channels)
            texts[printable(channel.name)] = name_of(channel.type);
        return texts;
    };
    const auto attributes = [](const ImageFile &file) {
        Texts texts{{"PixelAspectRatio", fmt::format("{}", file.part(0).pixel_aspect)},
                    {"Orientation", fmt::format("{}", file.source().orientation)}};
        for (const Attribute &attribute : file.source().metadata(0))
            texts[printable(attribute.name)] =
                attribute.type == "string" ? fmt::format("\"{}\"", printable(attribute.text)) : attribute.text;
        return texts;
    };
    compare_texts(channels(a), channels(b), "channel", lines);
    compare_texts(attributes(a), attributes(b), "attribute", lines);
}

}  // namespace

std::vector<std::string> header_changes(const ImageFile &a, const ImageFile &b)
{
    std::vector<std::string> lines;
    const ExrSource *exr_a = exr_of(a), *exr_b = exr_of(b);
    if (!exr_a || !exr_b) {
        compare_pictures(a, b, lines);
        return lines;
    }
    const std::size_t parts_a = exr_a->parts.size(), parts_b = exr_b->parts.size();
    if (parts_a != parts_b)
        lines.push_back(fmt::format("{} parts, was {}", parts_a, parts_b));
    for (std::size_t i = 0; i < std::min(parts_a, parts_b); ++i)
        compare_headers(exr_a->header(int(i)), exr_b->header(int(i)), parts_a > 1 ? fmt::format("part {}: ", i) : "", lines);
    return lines;
}

std::string provenance_note(const ImageFile &a, const ImageFile &b)
{
    const std::string of_a = provenance_of(a), of_b = provenance_of(b);
    if (of_a == of_b)
        return "";
    const auto shown = [](const std::string &text) { return text.empty() ? std::string("does not say") : "is of " + text; };
    return fmt::format("made otherwise: {} {}, {} {}", a.path().string(), shown(of_a), b.path().string(), shown(of_b));
}

}  // namespace brume::tool
