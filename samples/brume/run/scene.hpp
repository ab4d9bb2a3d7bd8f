#pragma once

#include <string>
#include <vector>

#include "support/sdk.hpp"

namespace brume::tool {

/// A scene file's text, and what the command line sets over it.
struct SceneText {
    std::string text, name;        ///< the name is the file's: other files are relative to it
    std::vector<std::string> set;  ///< effect.param=value
};

/// Throws RequestError.
SceneText read_scene(const std::string &path, const std::vector<std::string> &set);

/// With the environment image that it names. Throws RequestError.
Scene make_scene(const Context &context, const SceneText &scene);

}  // namespace brume::tool
