#pragma once

#include <OpenImageIO/imageio.h>

#include "image/metadata.hpp"

namespace brume::tool {

/// What the file says beside its pixels and their layout.
Metadata metadata_of(const OIIO::ImageSpec &spec);

/// Into what is to be written as `format`, together with the shape of its pixels.
void put_metadata(OIIO::ImageSpec &spec, const std::string &format, const Metadata &metadata, double pixel_aspect);

/// The names of what `written`, the file's header as it is read again, has not or has cut.
std::vector<std::string> lost_from(const OIIO::ImageSpec &written, const Metadata &metadata);

}  // namespace brume::tool
