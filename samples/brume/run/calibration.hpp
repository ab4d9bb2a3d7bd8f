#pragma once

#include <filesystem>

#include "support/sdk.hpp"

namespace brume::tool {

/// Where the measured rates of this context's device are kept: $XDG_CACHE_HOME/brume, or ~/.cache/brume. Empty without a
/// home.
std::filesystem::path calibration_file(const Context &context);

/// Gives the context the rates that are kept for its device, if there are any.
void load_calibration(const Context &context);

}  // namespace brume::tool
