// SPDX-License-Identifier: BSD-3-Clause
// The scene that effects are given, as the maths' types in either precision.
#pragma once
#include <algorithm>
#include <vector>

#include <brume/brume_plugin.h>

#include "maths.hpp"
#include "scene_arrays.hpp"

namespace brume {
namespace maths_float {
#include "scene_maths.inc"
#include "scene_data.inc"

inline Texture texture_of(const brume_plugin_pixels &p)
{
    return {p.data, p.row_stride, p.width, p.height, p.channels};
}
}  // namespace maths_float

namespace maths_double {
#include "scene_maths.inc"
#include "scene_data.inc"
}  // namespace maths_double
}  // namespace brume
