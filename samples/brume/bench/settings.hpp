#pragma once

#include <string>
#include <utility>
#include <vector>

#include "support/sdk.hpp"

namespace brume::tool {

enum class Kind {
    kSetting,
    kPublished,  ///< as a paper has it
    kBaseline    ///< what others do, made here
};
const char *name_of(Kind kind);

/// An effect's parameters that are not at their defaults.
using Parameters = std::vector<std::pair<std::string, std::string>>;

struct Setting {
    std::string effect, name;
    Kind kind = Kind::kSetting;
    Parameters parameters;
};

/// What is measured of an effect, its default first: of effects that no study was made for, each choice of each parameter by
/// itself. A setting that the scene or the backend does not allow is listed with the reason.
std::vector<Setting> settings_of(const Context &context, const std::string &effect);

/// The yardstick of an effect: the choice that it calls `reference`; without one, its defaults.
Setting reference_of(const Context &context, const std::string &effect);

}  // namespace brume::tool
