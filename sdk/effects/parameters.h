#pragma once
#include <string>
#include <vector>

#include "effects/effects.h"

namespace brume {

// What a parameter may be: "an integer from 1 to 12", "one of paper, reference".
std::string parameter_expectation(const Parameter &parameter);

}  // namespace brume
