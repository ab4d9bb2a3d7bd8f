#pragma once

#include <vector>

#include "run/sequence.hpp"

namespace brume::tool {

/// Throws RequestError where an output would overwrite something that is read, links included, or another output.
void check_outputs(const SequenceOptions &options, const std::vector<FrameFile> &files);

/// Throws RequestError where it cannot be made or written to.
void make_folder_of(const std::filesystem::path &output);

}  // namespace brume::tool
