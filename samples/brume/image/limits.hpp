#pragma once

#include <cstdint>

#include "support/memory.hpp"

namespace brume::tool {

struct ReadLimits {
    /// Largest decoded size of one part, all channels together. A header may claim any size; this is what bounds memory.
    std::uint64_t part_bytes = memory_of_machine() / 2;
    /// Largest width and height: what the library takes. A few hundred bytes can claim one line of 10^8 pixels.
    std::int64_t side = 65536;
    int parts = 1024;
    int channels = 4096;
};

}  // namespace brume::tool
