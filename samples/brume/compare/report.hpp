#pragma once

#include <string>
#include <vector>

#include "compare/comparison.hpp"

namespace brume::tool {

/// "within", "beyond", "updated", or "failed" where it could not be compared.
const char *outcome_of(const Comparison &comparison);

/// How many of which, in one line.
std::string summary_line(const std::vector<Comparison> &comparisons);

/// All that is known of one pair, several lines.
std::string text_of(const Comparison &comparison);

/// A line a pair, those for what is beyond its limits below it, and a summary.
std::string text_of(const std::vector<Comparison> &comparisons);

/// Of one pair its object; of several {"pairs": [...], "summary": {...}}.
std::string json_of(const std::vector<Comparison> &comparisons, bool one_pair);

}  // namespace brume::tool
