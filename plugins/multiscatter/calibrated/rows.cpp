// Kernel `calibrated` on the CPU.
#include <algorithm>
#include <cstring>

#include "calibrated/passes.h"
#include "lanes.hpp"

namespace multiscatter {
namespace {

namespace maths_float = brume::maths_float;

#define BRUME_LANES_BODY "calibrated/rows.inc"
#include "lanes_bodies.inc"

}  // namespace

const CalibratedRows &calibrated_rows_of_this_machine()
{
    return BRUME_OF_THIS_MACHINE(calibrated_rows);
}

}  // namespace multiscatter
