#pragma once
#include <string>
#include <tuple>
#include <vector>

#include <brume/brume.h>

namespace brume {

// A caller's format with the layers that it names; the struct's own pointers to them are NULL.
struct Format : brume_format {
    struct LayerName {
        std::string name;
        uint32_t kind = 0;
    };

    Format(const brume_format &given) : brume_format(given)
    {
        for (uint32_t i = 0; i < given.input_count; ++i)
            input_layers.push_back({given.inputs[i].name, given.inputs[i].kind});
        for (uint32_t i = 0; i < given.output_count; ++i)
            output_layers.push_back({given.outputs[i].name, given.outputs[i].kind});
        inputs = outputs = nullptr;
    }

    std::vector<LayerName> input_layers, output_layers;
};

// Whether effects may drop the same for both, of the same structure.
inline bool drops_alike(const Format &a, const Format &b)
{
    const auto distances = [](const Format &f) {
        return std::tie(f.depth_range[0], f.depth_range[1], f.far_distance, f.sky, f.sky_distance, f.nonpositive);
    };
    return distances(a) == distances(b);
}

}  // namespace brume
