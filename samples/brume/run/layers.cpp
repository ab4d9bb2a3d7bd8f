#include "run/layers.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/nearest.hpp"

namespace brume::tool {
namespace {

struct KnownOutput {
    std::string_view layer, name;
    SampleType type;
};

// Optical depth runs to 1e30 for sky in an endless medium, far past half; errors may be smaller than halves are. What
// strangers' layers hold is not known, so they are floats too.
constexpr KnownOutput kKnownOutputs[] = {{"transmittance", "transmittance", SampleType::kHalf},
                                         {"scattered", "scattered", SampleType::kHalf},
                                         {"blur_radius", "blur_radius", SampleType::kHalf},
                                         {"airlight", "airlight", SampleType::kHalf},
                                         {"light_airlight", "light", SampleType::kHalf}};

LayerOutput output_of(const brume_layer_info &info)
{
    LayerOutput output{info.name, info.name, int(info.channels)};
    output.of_light = info.flags & BRUME_LAYER_OF_LIGHT;
    for (const KnownOutput &known : kKnownOutputs)
        if (known.layer == output.layer) {
            output.name = known.name;
            output.type = known.type;
        }
    return output;
}

std::optional<LayerOutput> find_output(const std::string &name, const std::vector<LayerOutput> &all)
{
    for (LayerOutput output : all) {
        if (!output.of_light && output.name == name)
            return output;
        const char *const end = name.data() + name.size();
        if (output.of_light && name.starts_with(output.name) &&
            std::from_chars(name.data() + output.name.size(), end, output.light).ptr == end &&
            name == fmt::format("{}{}", output.name, output.light)) {
            output.name = name;
            return output;
        }
    }
    return std::nullopt;
}

}  // namespace

std::vector<brume_layer_info> all_layers(const Context &context, std::uint32_t direction)
{
    std::vector<brume_layer_info> all;
    const auto add = [&](const std::vector<brume_layer_info> &layers) {
        for (const brume_layer_info &layer : layers)
            if (layer.flags & direction && std::none_of(all.begin(), all.end(), [&](const brume_layer_info &other) {
                    return std::string_view(other.name) == layer.name;
                }))
                all.push_back(layer);
    };
    add(context.library_layers());
    for (const brume_effect_info &effect : context.effects())
        if (!effect.refusal)
            add(context.layers(effect.name));
    return all;
}

std::vector<LayerOutput> parse_layers(const Context &context, const std::vector<std::string> &names)
{
    std::vector<LayerOutput> all, layers;
    std::vector<std::string> known;
    std::string list;
    for (const brume_layer_info &info : all_layers(context, BRUME_LAYER_OUTPUT)) {
        all.push_back(output_of(info));
        known.push_back(all.back().name + (all.back().of_light ? "0" : ""));
        list += fmt::format("{}{}", list.empty() ? "" : ", ", known.back());
        if (all.back().of_light)
            list += fmt::format(", {}1, ...", all.back().name);
    }
    for (const std::string &name : names) {
        const auto layer = find_output(name, all);
        if (!layer)
            throw RequestError(fmt::format("--layers '{}': no effect fills a layer of that name; {}expected some of {}",
                                           name, known.empty() ? "" : fmt::format("nearest is '{}'; ", nearest(name, known)),
                                           known.empty() ? "none, as there are no effects" : list));
        if (std::none_of(layers.begin(), layers.end(), [&](const LayerOutput &l) { return l.name == name; }))
            layers.push_back(*layer);
    }
    return layers;
}

std::vector<brume_layer> format_layers(const std::vector<LayerOutput> &outputs)
{
    std::vector<brume_layer> layers;
    for (const LayerOutput &output : outputs)
        if (std::none_of(layers.begin(), layers.end(), [&](const brume_layer &l) { return l.name == output.layer; }))
            layers.push_back(brume::layer(output.layer.c_str()));
    return layers;
}

}  // namespace brume::tool
