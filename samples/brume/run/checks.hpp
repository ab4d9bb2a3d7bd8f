#pragma once

#include <cstdint>
#include <vector>

#include "run/sequence.hpp"

namespace brume::tool {

/// Throws RequestError where an output would overwrite something that is read, links included, or another output.
void check_outputs(const SequenceOptions& options, const std::vector<FrameFile>& files);

/// Physical memory of the machine, or what the process is limited to [bytes].
std::uint64_t memory_of_machine();

}  // namespace brume::tool
