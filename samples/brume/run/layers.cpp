#include "run/layers.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <brume/brume.h>
#include <fmt/format.h>

#include "support/error.hpp"

namespace brume::tool {
namespace {

// Optical depth runs to 1e30 for sky in an endless medium, far past half; errors may be smaller than halves are.
const LayerOutput kLayers[] = {
    {"transmittance", BRUME_OUTPUT_TRANSMITTANCE}, {"optical_depth", BRUME_OUTPUT_OPTICAL_DEPTH, 3, Imf::FLOAT},
    {"scattered", BRUME_OUTPUT_SCATTERED},         {"blur_radius", BRUME_OUTPUT_BLUR_RADIUS, 1},
    {"airlight", BRUME_OUTPUT_AIRLIGHT},           {"airlight_error", BRUME_OUTPUT_AIRLIGHT_ERROR, 3, Imf::FLOAT}};

constexpr std::string_view kLight = "light";

std::optional<LayerOutput> find_layer(const std::string &name)
{
    for (const LayerOutput &layer : kLayers)
        if (layer.name == name)
            return layer;
    LayerOutput light{name, BRUME_OUTPUT_LIGHT_AIRLIGHT};
    const char *const end = name.data() + name.size();
    if (name.starts_with(kLight) && std::from_chars(name.data() + kLight.size(), end, light.light).ptr == end &&
        name == fmt::format("{}{}", kLight, light.light))
        return light;
    return std::nullopt;
}

}  // namespace

std::vector<LayerOutput> parse_layers(const std::vector<std::string> &names)
{
    std::vector<LayerOutput> layers;
    for (const std::string &name : names) {
        const auto layer = find_layer(name);
        if (!layer)
            throw RequestError(fmt::format("--layers '{}': expected some of {}", name, known_layers()));
        if (std::none_of(layers.begin(), layers.end(), [&](const LayerOutput &l) { return l.name == name; }))
            layers.push_back(*layer);
    }
    return layers;
}

std::string known_layers()
{
    std::string known;
    for (const LayerOutput &layer : kLayers)
        known += layer.name + ", ";
    return known + "light0, light1, ...";
}

}  // namespace brume::tool
