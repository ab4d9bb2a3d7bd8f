// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// shaders/lib for several pixels of a row side by side, which is what the CPU runs where a pass costs most:
// brume::lanes_generic for every machine, brume::lanes_avx2 for those of which runs_avx2() is true. Loops that use them are
// compiled once for each (lanes_bodies.inc), the second between BRUME_BEGIN_AVX2 and BRUME_END_AVX2.
//
// GCC's vectors and arithmetic of our own won over Highway and xsimd: they round alike on every machine (nothing is fused,
// the exponentials are the same), so that a picture does not depend on where it was made, and there is no second object
// file whose inline functions a linker may hand to machines without the instructions.
#include <cstdint>

#include <brume/brume_plugin.h>

#include "maths.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define BRUME_AVX2 1  // the address sanitizer does not see gathers: it has the loads of every machine
#define BRUME_BEGIN_AVX2 _Pragma("GCC push_options") _Pragma("GCC target(\"avx2\")")
#define BRUME_END_AVX2 _Pragma("GCC pop_options")
#endif

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wpsabi"
#define R(x) real(x)
#define IN(type) const type &

// All inlined into one loop runs a seventh faster, and takes twice as long to compile: not where the loop runs on few
// machines, or slowly anyway.
#if defined(BRUME_AVX2) || defined(__SANITIZE_ADDRESS__)
#define BRUME_PURE_GENERIC inline
#else
#define BRUME_PURE_GENERIC [[gnu::always_inline]] inline
#endif
#define BRUME_PURE_AVX2 [[gnu::always_inline]] inline

namespace brume {

#define BRUME_GATHER 0
#define PURE BRUME_PURE_GENERIC
namespace lanes_generic {
#include "lanes_types.inc"
}
#undef PURE
#undef BRUME_GATHER

#ifdef BRUME_AVX2
inline bool runs_avx2()
{
    return __builtin_cpu_supports("avx2");
}

#define BRUME_GATHER 1
#define PURE BRUME_PURE_AVX2
BRUME_BEGIN_AVX2
namespace lanes_avx2 {
#include "lanes_types.inc"
}
BRUME_END_AVX2
#undef PURE
#undef BRUME_GATHER
#define BRUME_OF_THIS_MACHINE(name) (brume::runs_avx2() ? avx2::name : generic::name)
#else
#define BRUME_OF_THIS_MACHINE(name) generic::name
#endif

}  // namespace brume
#undef R
#undef IN
#pragma GCC diagnostic pop
