#pragma once

#include <cstdint>

namespace brume::tool {

/// Physical memory of the machine, or what the process is limited to [bytes].
std::uint64_t memory_of_machine();

}  // namespace brume::tool
