#pragma once

#include <OpenColorIO/OpenColorIO.h>

namespace brume::tool {

/// The config used where $OCIO names none: linear Rec. 709 as scene_linear, ACEScg, ACES2065-1 and sRGB beside it, and one
/// sRGB display with the views Filmic (default) and Standard.
OCIO_NAMESPACE::ConstConfigRcPtr builtin_config();

}  // namespace brume::tool
