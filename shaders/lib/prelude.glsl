// Stands before every program: what the other files take as given. shaders/maths.hpp is its C++ counterpart.
layout(local_size_x = 8, local_size_y = 8) in;

// Marks every function of these files: C++ makes them inline.
#define PURE

// A struct that is only read: C++ passes a reference, where GLSL copies nothing anyway.
#define IN(type) type

// A literal of the precision that is compiled; C++ needs it spelled out.
#define R(x) x

// Truth of a pixel's value, and the choice by it. C++ runs several pixels side by side, each with its own truth, and has
// no ?: for that; `if` and ?: are for what all pixels share. Both values are computed.
#define Bool bool

float choose(bool which, float a, float b)
{
    return which ? a : b;
}

// Whether that is so of any of the pixels side by side.
#define some(truth) (truth)

// By bits: compilers may assume that isnan() and isinf() are false.
bool is_finite(float x)
{
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}

// How many turns of its loops a pixel may take: more end early in Mesa's software GL.
#ifndef BRUME_MOST_TURNS
#define BRUME_MOST_TURNS 0x7fffffff
#endif
const int most_turns = BRUME_MOST_TURNS;

uniform ivec2 brume_grid;
