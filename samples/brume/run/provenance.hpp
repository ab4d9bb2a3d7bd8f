#pragma once

#include <string>

#include "run/fogger.hpp"
#include "run/scene.hpp"

namespace brume::tool {

/// "brume 0.1.0; cpu; scene 0123456789abcdef": the library's version, the backend and a hash of the scene's text and of what
/// options set over it. White space and the order of keys do not count, nor what is in files that the scene names.
std::string provenance_of(const SceneText &scene, const FogOptions &options, std::uint32_t backend);

}  // namespace brume::tool
