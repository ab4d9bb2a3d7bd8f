#include "image/oiio/metadata.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace brume::tool {
namespace {

/// What follows from the pixels and how they are stored, is true of them as they were before, or has a place of its own.
/// Writers take what they are told for their own whatever its letters' case.
bool is_layout(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    constexpr const char *names[] = {"orientation",
                                     "pixelaspectratio",
                                     "compression",
                                     "planarconfig",
                                     "xresolution",
                                     "yresolution",
                                     "resolutionunit",
                                     "compressionquality",
                                     "exif:pixelxdimension",
                                     "exif:pixelydimension",
                                     "exif:colorspace",
                                     "exif:exifversion",
                                     "exif:flashpixversion",
                                     "exif:componentsconfiguration",
                                     "exif:compressedbitsperpixel",
                                     "dpx:imagedescriptor",
                                     "dpx:dittokey",
                                     "dpx:endoflinepadding",
                                     "dpx:endofimagepadding",
                                     "dpx:packing",
                                     "dpx:version",
                                     "dpx:encoding"};
    constexpr const char *kinds[] = {"oiio:", "tiff:", "jpeg:", "png:", "hdr:", "iccprofile:", "thumbnail_"};
    return std::any_of(std::begin(names), std::end(names), [&](const char *n) { return name == n; }) ||
           std::any_of(std::begin(kinds), std::end(kinds), [&](const char *k) { return name.starts_with(k); });
}

/// IPTC's names of what the formats' writers put there by themselves, from the attribute that is carried.
bool is_copy_of_another(const OIIO::ImageSpec &spec, const OIIO::ParamValue &value)
{
    if (!value.name().string().starts_with("IPTC:") || value.type() != OIIO::TypeString)
        return false;
    for (const char *name : {"Software", "Artist", "Copyright", "ImageDescription", "DocumentName"})
        if (spec.get_string_attribute(name) == value.get_string())
            return true;
    return false;
}

/// What is none would be refused by some writers, and a picture with it by some readers.
bool is_profile(const OIIO::ParamValue &value)
{
    const auto *bytes = static_cast<const unsigned char *>(value.data());
    constexpr int kHeader = 128, kSignature = 36;
    return value.datasize() >= kHeader && std::equal(bytes + kSignature, bytes + kSignature + 4, "acsp") &&
           ((bytes[0] * 256u + bytes[1]) * 256u + bytes[2]) * 256u + bytes[3] == unsigned(value.datasize());
}

Attribute attribute_of(const OIIO::ParamValue &value)
{
    Attribute attribute{value.name().string(), value.type().c_str(), "", value.get_string()};
    if (value.type() == OIIO::TypeString)
        attribute.bytes = value.get_string(0);
    else if (value.type().basetype != OIIO::TypeDesc::STRING && value.type().basetype != OIIO::TypeDesc::PTR)
        attribute.bytes.assign(static_cast<const char *>(value.data()), value.datasize());
    return attribute;
}

double number_in(const Metadata &metadata, const char *name)
{
    const Attribute *attribute = find(metadata, name);
    float number = 0;
    if (attribute && attribute->type == "float" && attribute->bytes.size() == sizeof number)
        std::copy_n(attribute->bytes.data(), sizeof number, reinterpret_cast<char *>(&number));
    return double(number);
}

void put_resolution(OIIO::ImageSpec &spec, const std::string &format, const Metadata &metadata, double aspect)
{
    double x = number_in(metadata, "XResolution"), y = number_in(metadata, "YResolution");
    const Attribute *unit = find(metadata, "ResolutionUnit");
    const bool known = x > 0 && y > 0;
    if (!known && aspect == 1)
        return;
    if (!known)
        x = 72, y = x * aspect;
    if (format == "png" && known && unit && (unit->bytes == "in" || unit->bytes == "cm")) {
        // They are stored in whole pixels a metre, and the library cuts what it should round.
        const double metre = unit->bytes == "in" ? 0.0254 : 0.01;
        x = (std::round(x / metre) + 0.25) * metre;
        y = (std::round(y / metre) + 0.25) * metre;
    }
    spec.attribute("XResolution", float(x));
    spec.attribute("YResolution", float(y));
    spec.attribute("ResolutionUnit", known && unit ? unit->bytes : "none");
    // Of a JPEG the library takes the one for its inverse.
    if (format != "jpeg")
        spec.attribute("PixelAspectRatio", float(aspect));
}

}  // namespace

Metadata metadata_of(const OIIO::ImageSpec &spec)
{
    Metadata metadata;
    for (const OIIO::ParamValue &value : spec.extra_attribs)
        if (!is_layout(value.name().string()) && !is_copy_of_another(spec, value) &&
            (value.name() != "ICCProfile" || is_profile(value)))
            metadata.push_back(attribute_of(value));
    const float x = spec.get_float_attribute("XResolution", 0), y = spec.get_float_attribute("YResolution", 0);
    const std::string unit = spec.get_string_attribute("ResolutionUnit", "none");
    // A unit of nothing is the pixels' aspect.
    if (x > 0 && y > 0 && unit != "none") {
        metadata.push_back(attribute_of({"XResolution", x}));
        metadata.push_back(attribute_of({"YResolution", y}));
        metadata.push_back(text_attribute("ResolutionUnit", unit == "inch" ? "in" : unit));
    }
    return metadata;
}

void put_metadata(OIIO::ImageSpec &spec, const std::string &format, const Metadata &metadata, double pixel_aspect)
{
    put_resolution(spec, format, metadata, pixel_aspect);
    for (const Attribute &attribute : metadata) {
        const OIIO::TypeDesc type(attribute.type);
        if (is_layout(attribute.name))
            continue;
        if (type == OIIO::TypeString)
            spec.attribute(attribute.name, attribute.bytes);
        else if (!attribute.bytes.empty() && type.size() == attribute.bytes.size())
            spec.attribute(attribute.name, type, attribute.bytes.data());
    }
}

std::vector<std::string> lost_from(const OIIO::ImageSpec &written, const Metadata &metadata)
{
    std::vector<std::string> lost;
    for (const Attribute &attribute : metadata) {
        if (attribute.name == "YResolution" || attribute.name == "ResolutionUnit")
            continue;
        const OIIO::ParamValue *kept = written.find_attribute(attribute.name);
        const bool cut = kept && attribute.type == "string" && kept->get_string(0).size() < attribute.bytes.size();
        if ((!kept || cut) && attribute.text != "")
            lost.push_back(attribute.name);
    }
    return lost;
}

}  // namespace brume::tool
