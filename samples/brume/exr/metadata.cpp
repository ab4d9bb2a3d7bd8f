#include "exr/metadata.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfKeyCodeAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <fmt/format.h>

namespace brume::tool {
namespace {

constexpr std::array<const char *, 2> kNames[] = {
    {"owner", "Copyright"},         {"comments", "ImageDescription"}, {"capDate", "DateTime"},
    {"expTime", "ExposureTime"},    {"aperture", "FNumber"},          {"framesPerSecond", "FramesPerSecond"},
    {"timeCode", "smpte:TimeCode"}, {"keyCode", "smpte:KeyCode"},     {"software", "Software"},
    {"artist", "Artist"},           {"xDensity", "XResolution"}};

/// Of the pixels, their layout and their space, or of how OpenEXR finds them.
bool is_layout(const std::string &name)
{
    constexpr const char *names[] = {"channels",
                                     "compression",
                                     "dataWindow",
                                     "displayWindow",
                                     "lineOrder",
                                     "pixelAspectRatio",
                                     "screenWindowCenter",
                                     "screenWindowWidth",
                                     "tiles",
                                     "type",
                                     "name",
                                     "version",
                                     "chunkCount",
                                     "view",
                                     "multiView",
                                     "preview",
                                     "chromaticities",
                                     "whiteLuminance",
                                     "adoptedNeutral",
                                     "renderingTransform",
                                     "lookModTransform",
                                     "envmap",
                                     "wrapmodes",
                                     "dwaCompressionLevel",
                                     "maxSamplesPerPixel",
                                     "deepImageState",
                                     "acesImageContainerFlag",
                                     "colorInteropID",
                                     "oiio:ColorSpace",
                                     "Orientation",
                                     "utcOffset"};
    return std::any_of(std::begin(names), std::end(names), [&](const char *n) { return name == n; });
}

std::string common_name(const std::string &name)
{
    for (const auto &[here, elsewhere] : kNames)
        if (name == here)
            return elsewhere;
    return name;
}

std::string name_here(const std::string &name)
{
    for (const auto &[here, elsewhere] : kNames)
        if (name == elsewhere)
            return here;
    return name;
}

template <class... Numbers> std::string packed(Numbers... numbers)
{
    std::string bytes;
    (bytes.append(reinterpret_cast<const char *>(&numbers), sizeof numbers), ...);
    return bytes;
}

template <class T, std::size_t N> bool unpack(const Attribute &attribute, const char *type, std::array<T, N> &numbers)
{
    if (attribute.type != type || attribute.bytes.size() != sizeof numbers)
        return false;
    std::memcpy(numbers.data(), attribute.bytes.data(), sizeof numbers);
    return true;
}

Attribute attribute_of(const std::string &name, const Imf::Attribute &attribute)
{
    if (const auto *a = dynamic_cast<const Imf::StringAttribute *>(&attribute))
        return text_attribute(name, a->value());
    if (const auto *a = dynamic_cast<const Imf::IntAttribute *>(&attribute))
        return {name, "int", packed(std::int32_t(a->value())), fmt::format("{}", a->value())};
    if (const auto *a = dynamic_cast<const Imf::FloatAttribute *>(&attribute))
        return {name, "float", packed(a->value()), fmt::format("{}", a->value())};
    if (const auto *a = dynamic_cast<const Imf::RationalAttribute *>(&attribute))
        return {name, "rational", packed(std::int32_t(a->value().n), std::int32_t(a->value().d)),
                fmt::format("{}/{}", a->value().n, a->value().d)};
    if (const auto *a = dynamic_cast<const Imf::TimeCodeAttribute *>(&attribute)) {
        const Imf::TimeCode &t = a->value();
        return {name, "timecode", packed(std::uint32_t(t.timeAndFlags()), std::uint32_t(t.userData())),
                fmt::format("{:02}:{:02}:{:02}:{:02}", t.hours(), t.minutes(), t.seconds(), t.frame())};
    }
    if (const auto *a = dynamic_cast<const Imf::KeyCodeAttribute *>(&attribute)) {
        const Imf::KeyCode &k = a->value();
        return {name, "keycode",
                packed(std::int32_t(k.filmMfcCode()), std::int32_t(k.filmType()), std::int32_t(k.prefix()),
                       std::int32_t(k.count()), std::int32_t(k.perfOffset()), std::int32_t(k.perfsPerFrame()),
                       std::int32_t(k.perfsPerCount())),
                fmt::format("film {} {} {} {} {}", k.filmMfcCode(), k.filmType(), k.prefix(), k.count(), k.perfOffset())};
    }
    return {name, attribute.typeName(), "", attribute.typeName()};
}

void put(Imf::Header &header, const std::string &name, const Attribute &attribute)
{
    std::array<float, 1> number{};
    std::array<std::int32_t, 1> integer{};
    std::array<std::uint16_t, 1> small{};
    std::array<std::int32_t, 2> ratio{};
    std::array<std::uint32_t, 2> time{};
    std::array<std::int32_t, 7> key{};
    if (attribute.type == "string")
        header.insert(name, Imf::StringAttribute(attribute.bytes));
    else if (unpack(attribute, "float", number))
        header.insert(name, Imf::FloatAttribute(number[0]));
    else if (unpack(attribute, "int", integer) || unpack(attribute, "uint", integer))
        header.insert(name, Imf::IntAttribute(integer[0]));
    else if (unpack(attribute, "uint16", small))
        header.insert(name, Imf::IntAttribute(small[0]));
    else if (unpack(attribute, "rational", ratio))
        header.insert(name, Imf::RationalAttribute(Imf::Rational(ratio[0], unsigned(ratio[1]))));
    else if (unpack(attribute, "timecode", time))
        header.insert(name, Imf::TimeCodeAttribute({time[0], time[1]}));
    else if (unpack(attribute, "keycode", key))
        header.insert(name, Imf::KeyCodeAttribute({key[0], key[1], key[2], key[3], key[4], key[5], key[6]}));
    else if (!attribute.text.empty())
        header.insert(name, Imf::StringAttribute(attribute.text));
}

/// OpenEXR refuses its own names with other types, and its own types with other values than they may have.
bool fits(const std::string &name, const Attribute &attribute)
{
    constexpr std::array<const char *, 2> types[] = {
        {"owner", "string"},      {"comments", "string"}, {"capDate", "string"},
        {"expTime", "float"},     {"aperture", "float"},  {"framesPerSecond", "rational"},
        {"timeCode", "timecode"}, {"keyCode", "keycode"}, {"xDensity", "float"}};
    for (const auto &[own, type] : types)
        if (name == own)
            return attribute.type == type;
    return true;
}

}  // namespace

Metadata metadata_of(const Imf::Header &header)
{
    Metadata metadata;
    for (auto at = header.begin(); at != header.end(); ++at)
        if (!is_layout(at.name()))
            metadata.push_back(attribute_of(common_name(at.name()), at.attribute()));
    if (const Attribute *density = find(metadata, "XResolution"); density && density->type == "float") {
        Attribute y = *density;
        y.name = "YResolution";
        const float rows = Imf::xDensity(header) * header.pixelAspectRatio();
        y.bytes = packed(rows);
        metadata.push_back(y);
        metadata.push_back(text_attribute("ResolutionUnit", "in"));
    }
    return metadata;
}

void put_metadata(Imf::Header &header, const Metadata &metadata)
{
    const Attribute *unit = find(metadata, "ResolutionUnit");
    for (Attribute attribute : metadata) {
        const std::string name = name_here(attribute.name);
        const bool density = attribute.name.ends_with("Resolution") || attribute.name == "ResolutionUnit";
        if (density && (attribute.name != "XResolution" || !unit))
            continue;
        if (std::array<float, 1> x{}; density && unit->bytes == "cm" && unpack(attribute, "float", x))
            attribute.bytes = packed(x[0] * 2.54f);
        if (name.empty() || name.size() > 255 || is_layout(name) || !fits(name, attribute) ||
            header.find(name) != header.end())
            continue;
        try {
            put(header, name, attribute);
        } catch (const std::exception &) {
            // A timecode or keycode with digits that none may have.
        }
    }
}

}  // namespace brume::tool
