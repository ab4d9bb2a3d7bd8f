// After files that stand between it and formulas_begin.hpp.
#undef R
#undef IN
#undef PURE
