#pragma once

#include <string>
#include <vector>

#include "compare/comparison.hpp"

namespace brume::tool {

/// A test case a pair, as CI systems read it. Throws FrameError.
void write_junit(const std::string &path, const std::vector<Comparison> &comparisons);

/// For XML and HTML: marked-up characters escaped, what neither may hold (controls, broken UTF-8) replaced.
std::string escaped(const std::string &text);

}  // namespace brume::tool
