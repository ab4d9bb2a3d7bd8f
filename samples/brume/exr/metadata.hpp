#pragma once

#include <ImfHeader.h>

#include "image/metadata.hpp"

namespace brume::tool {

/// What the header says beside the pixels and their layout, as other formats name it. Attributes of types that none of them
/// has are without bytes.
Metadata metadata_of(const Imf::Header &header);

/// Under the names that OpenEXR has for it, where it has one.
void put_metadata(Imf::Header &header, const Metadata &metadata);

}  // namespace brume::tool
