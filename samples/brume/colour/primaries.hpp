#pragma once

#include <optional>

#include <ImfChromaticities.h>
#include <OpenColorIO/OpenColorIO.h>

namespace brume::tool {

/// Of a linear colour space of the config, by its aces_interchange role: those of a well-known space that it is, else as the
/// config sees them, adapted to the white of ACES. Nothing for what is not linear, or without that role.
std::optional<Imf::Chromaticities> primaries_of(const OCIO_NAMESPACE::ConstConfigRcPtr &config, const char *space);

}  // namespace brume::tool
