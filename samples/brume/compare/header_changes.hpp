#pragma once

#include <string>
#include <vector>

#include "exr/file.hpp"

namespace brume::tool {

/// What `a` has otherwise than `b` beside the pixels, a line each: parts, windows, compression, channels, attributes.
std::vector<std::string> header_changes(const ExrFile &a, const ExrFile &b);

/// Where two files say that they were made otherwise: how. Empty where they agree or neither says.
std::string provenance_note(const ExrFile &a, const ExrFile &b);

}  // namespace brume::tool
