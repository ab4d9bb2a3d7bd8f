#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ImfPixelType.h>

namespace brume::tool {

/// An extra output that the command line asked for.
struct LayerOutput {
    std::string name;
    std::uint32_t flag = 0;  ///< BRUME_OUTPUT_...
    int channels = 3;
    Imf::PixelType type = Imf::HALF;
    std::uint32_t light = 0;  ///< of BRUME_OUTPUT_LIGHT_AIRLIGHT
};

/// What --layers names, each once; "light3" is the airlight of the scene's light 3. Throws RequestError.
std::vector<LayerOutput> parse_layers(const std::vector<std::string> &names);

/// What --help and errors say there is.
std::string known_layers();

}  // namespace brume::tool
