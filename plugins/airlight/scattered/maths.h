// shaders/lib/airlight_scattered.glsl and scattered_grid.glsl as C++.
#pragma once
#include "scene_maths.hpp"

#define R(x) real(x)
#define IN(type) const type &
#define PURE [[gnu::always_inline]] inline
namespace brume::maths_float {
#include "lib/airlight_scattered.glsl"
#include "lib/scattered_grid.glsl"
}  // namespace brume::maths_float
#undef R
#undef IN
#undef PURE
