#pragma once
#include <string>

#include "effects/effects.h"

namespace brume {

// Loads one plugin and checks its table. A plugin that is not taken comes back with a refusal; nothing is thrown.
Effect load_plugin(const std::string &file);

Effect refused_plugin(const std::string &file, const std::string &refusal);

}  // namespace brume
