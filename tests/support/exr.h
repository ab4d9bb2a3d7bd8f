#pragma once
// Small EXR files for tests, through OpenEXR.
#include <string>
#include <vector>

#include "fog.h"

namespace fog {

// The named channels, 0 where the file lacks one (A: 1).
Picture read_exr(const std::string &file, const std::vector<std::string> &channels);

void write_exr(const std::string &file, const Picture &p, const std::vector<std::string> &channels);

}  // namespace fog
