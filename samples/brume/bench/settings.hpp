#pragma once

#include <string>
#include <utility>
#include <vector>

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

/// All that is measured, effect by effect, each effect's default first. A setting that the scene or the backend does not
/// allow is listed with the reason.
const std::vector<Setting> &settings();

/// The yardstick of an effect.
Setting reference_of(const std::string &effect);

}  // namespace brume::tool
