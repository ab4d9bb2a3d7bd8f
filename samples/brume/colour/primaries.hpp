#pragma once

#include <optional>

#include <OpenColorIO/OpenColorIO.h>

#include "image/types.hpp"
#include "metrics/metrics.hpp"

namespace brume::tool {

/// Of a linear colour space of the config, by its aces_interchange role: those of a well-known space that it is, else as the
/// config sees them, adapted to the white of ACES. Nothing for what is not linear, or without that role.
std::optional<Chromaticities> primaries_of(const OCIO_NAMESPACE::ConstConfigRcPtr &config, const char *space);

/// What each of them adds to the luminance of white; nothing for degenerate ones.
std::optional<LuminanceWeights> luminance_of(const Chromaticities &primaries);

}  // namespace brume::tool
