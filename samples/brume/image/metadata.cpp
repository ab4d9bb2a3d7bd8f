#include "image/metadata.hpp"

#include <algorithm>

namespace brume::tool {
namespace {

constexpr const char *kSoftware = "Software", *kBetween = "; ", *kOurs = "brume ";

/// Where in the software's text an earlier run's provenance starts.
std::size_t provenance_at(const std::string &software)
{
    if (software.starts_with(kOurs))
        return 0;
    const std::size_t at = software.find(std::string(kBetween) + kOurs);
    return at == software.npos ? at : at + 2;
}

}  // namespace

Attribute text_attribute(std::string name, std::string text)
{
    return {std::move(name), "string", text, text};
}

const Attribute *find(const Metadata &metadata, const std::string &name)
{
    const auto at = std::find_if(metadata.begin(), metadata.end(), [&](const Attribute &a) { return a.name == name; });
    return at == metadata.end() ? nullptr : &*at;
}

void put_provenance(Metadata &metadata, const std::string &provenance, const std::string &format)
{
    if (provenance.empty())
        return;
    if (format == "png" || format == "openexr") {
        metadata.push_back(text_attribute(kProvenance, provenance));
        return;
    }
    const Attribute *software = find(metadata, kSoftware);
    const std::string text = software && !software->bytes.empty() ? software->bytes + kBetween + provenance : provenance;
    std::erase_if(metadata, [](const Attribute &a) { return a.name == kSoftware; });
    metadata.push_back(text_attribute(kSoftware, text));
}

std::string provenance_in(const Metadata &metadata)
{
    if (const Attribute *own = find(metadata, kProvenance))
        return own->bytes;
    const Attribute *software = find(metadata, kSoftware);
    const std::size_t at = software ? provenance_at(software->bytes) : std::string::npos;
    return at == std::string::npos ? "" : software->bytes.substr(at);
}

Metadata carried(Metadata metadata, bool same_space)
{
    std::erase_if(metadata, [&](const Attribute &a) {
        const bool of_space = a.name == "ICCProfile" || a.name == "dpx:Transfer" || a.name == "dpx:Colorimetric";
        return a.name == kProvenance || (of_space && !same_space);
    });
    for (Attribute &a : metadata)
        if (const std::size_t at = a.name == kSoftware ? provenance_at(a.bytes) : std::string::npos; at != std::string::npos)
            a.bytes = a.text = a.bytes.substr(0, at < 2 ? 0 : at - 2);
    return metadata;
}

}  // namespace brume::tool
