#pragma once
#include <string>
#include <vector>

#include "core/effects.h"

namespace brume {

// What a parameter may be: "an integer from 1 to 12", "one of paper, reference".
std::string parameter_expectation(const Parameter &parameter);

// The end of a message about an unknown name: "; did you mean ...?" or "; expected one of ...".
std::string did_you_mean(const std::string &word, const std::vector<std::string> &names);

}  // namespace brume
