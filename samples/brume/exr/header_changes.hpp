#pragma once

#include <string>
#include <vector>

#include "image/file.hpp"

namespace brume::tool {

/// What `a` has otherwise than `b` beside the pixels, a line each: parts, windows, compression, channels, attributes. Of
/// OpenEXR files only.
std::vector<std::string> header_changes(const ImageFile &a, const ImageFile &b);

/// Where two files say that they were made otherwise: how. Empty where they agree or neither says.
std::string provenance_note(const ImageFile &a, const ImageFile &b);

}  // namespace brume::tool
