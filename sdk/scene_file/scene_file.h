#pragma once
#include <filesystem>
#include <vector>

#include "base/json_node.h"
#include "scene/scene.h"

namespace brume {

// Blocks of a scene file. Files that they name are relative to `folder`, the scene file's own.
Medium read_medium(const JsonNode &node, const std::filesystem::path &folder);
std::vector<Light> read_lights(const JsonNode &node, const std::filesystem::path &folder);
Environment read_environment(const JsonNode &node, const std::filesystem::path &folder);

}  // namespace brume
