// Before files of one's own that are GLSL and C++ (as those of lib/ are), inside a namespace of one's own that says
//   using namespace brume::maths_float; using real = float;
// (or maths_double, with `#define float double` around them). formulas_end.hpp goes after them. No include guard.
#define R(x) real(x)
#define IN(type) const type &
#define PURE [[gnu::always_inline]] inline
using brume::is_finite;
using brume::most_turns;
