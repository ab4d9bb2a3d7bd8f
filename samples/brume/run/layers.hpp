#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/sdk.hpp"

namespace brume::tool {

/// What all effects that are loaded and the library itself have in `direction` (BRUME_LAYER_INPUT or _OUTPUT), by name.
std::vector<brume_layer_info> all_layers(const Context &context, std::uint32_t direction);

/// A layer that the command line asked for.
struct LayerOutput {
    std::string name;   ///< as the file has it
    std::string layer;  ///< as the library has it
    int channels = 3;
    SampleType type = SampleType::kFloat;
    bool of_light = false;
    std::uint32_t light = 0;
};

/// What --layers names, each once; of a layer that there is for each light, its name and the light's number. Throws
/// RequestError.
std::vector<LayerOutput> parse_layers(const Context &context, const std::vector<std::string> &names);

/// As parts of a brume_format: each layer once.
std::vector<brume_layer> format_layers(const std::vector<LayerOutput> &outputs);

}  // namespace brume::tool
