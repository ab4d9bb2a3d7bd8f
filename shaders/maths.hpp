// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// shaders/lib as C++: brume::maths_float is what the CPU backend runs, brume::maths_double the yardstick of the tests.
#include <bit>
#include <cstdint>

#include <glm/glm.hpp>

namespace brume {

constexpr int most_turns = 0x7fffffff;

inline bool is_finite(float x)
{
    return (std::bit_cast<uint32_t>(x) & 0x7f800000u) != 0x7f800000u;
}

inline bool is_finite(double x)
{
    return (std::bit_cast<uint64_t>(x) & 0x7ff0000000000000u) != 0x7ff0000000000000u;
}

// The files say `float` and R(literal) for the real type at hand, and PURE before each function (which
// must be inlined: the loops over taps unroll only where the caller's constants reach them).
#define R(x) real(x)
#define IN(type) const type &
#define PURE [[gnu::always_inline]] inline

// Tiers take the same images whether they read them or not.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace maths_float {
using real = float;
#include "maths_types.inc"
}  // namespace maths_float

#define float double
namespace maths_double {
using real = double;
#include "maths_types.inc"
}  // namespace maths_double
#undef float
#pragma GCC diagnostic pop
#undef R
#undef PURE
#undef IN

}  // namespace brume
