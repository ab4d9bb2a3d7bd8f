#pragma once

#include <string>
#include <vector>

namespace brume::tool {

/// What a file says beside its pixels, by the name and the type that OpenImageIO has for it, so that all formats mean the
/// same.
struct Attribute {
    std::string name, type;
    std::string bytes;  ///< of a string its text; none where no other format has such a type
    std::string text;   ///< for people
};
using Metadata = std::vector<Attribute>;

Attribute text_attribute(std::string name, std::string text);
const Attribute *find(const Metadata &metadata, const std::string &name);

/// Attribute of the part with the colour, or of the file: what made it. One of an earlier run is replaced or goes.
constexpr const char *kProvenance = "brume:provenance";

/// Of files that have no place for it, at the end of `Software`.
void put_provenance(Metadata &metadata, const std::string &provenance, const std::string &format);
std::string provenance_in(const Metadata &metadata);

/// What remains true of a picture that has been fogged: without what describes pixels in a space that they have left, and
/// what an earlier run said of itself.
Metadata carried(Metadata metadata, bool same_space);

}  // namespace brume::tool
