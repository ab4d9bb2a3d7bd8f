// Kernel `calibrated` on the CPU.
#include <algorithm>
#include <cstring>

#include "calibrated/passes.h"
#include "lanes.hpp"

namespace multiscatter {
namespace {

namespace maths_float = brume::maths_float;

namespace generic {
using namespace brume::lanes_generic;
#include "calibrated/rows.inc"
}  // namespace generic

#ifdef BRUME_AVX2
BRUME_BEGIN_AVX2
namespace avx2 {
using namespace brume::lanes_avx2;
#include "calibrated/rows.inc"
}  // namespace avx2
BRUME_END_AVX2
#endif

}  // namespace

const CalibratedRows &calibrated_rows_of_this_machine()
{
#ifdef BRUME_AVX2
    if (brume::runs_avx2())
        return avx2::calibrated_rows;
#endif
    return generic::calibrated_rows;
}

}  // namespace multiscatter
