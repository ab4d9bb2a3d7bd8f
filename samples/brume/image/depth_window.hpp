#pragma once

#include "image/resolve.hpp"

namespace brume::tool {

/// Throws RequestError where depth has another size than the picture, so that its pixels are not the picture's: another
/// display window, or a data window that is the picture's reduced or enlarged. Other data windows are crops.
void check_depth_window(const ImageFile &file, const ColorChoice &color, const ImageFile &depth_file,
                        const DepthChoice &depth);

}  // namespace brume::tool
