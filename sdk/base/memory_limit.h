#pragma once
#include <cstdint>

namespace brume {

// Bytes that this process may use at most: of the machine with its swap space, of its control group and of its address
// space.
uint64_t memory_limit();

}  // namespace brume
