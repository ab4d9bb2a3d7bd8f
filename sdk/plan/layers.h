#pragma once
#include <memory>
#include <string>
#include <vector>

#include "plan/backend.h"
#include "effects/effects.h"
#include "scene/format.h"

namespace brume {

// Layers that the library reads itself.
const std::vector<Layer> &host_layers();

// A layer of a format, and how many effects (the host counts as one) do something with it.
struct FormatLayer {
    Format::LayerName name;
    uint32_t flags = 0;  // BRUME_LAYER_INPUT or _OUTPUT, _OF_LIGHT and _ANY_SIZE
    uint32_t channels = 3;
};

// What a plan's frames bring and may ask for beside colour and depth.
class FrameLayers {
public:
    // Throws Error where some layer is known to no effect that is loaded, naming the nearest, or where effects disagree on
    // it.
    void plan(const Format &format, const EffectRegistry &effects);

    // For each layer of an effect's table: 1 if the format has it.
    std::vector<uint32_t> given(const std::vector<Layer> &table) const;
    bool has_input(std::string_view name) const { return find(name, BRUME_LAYER_INPUT) != nullptr; }
    // Of an input that the format has: whether its images may have another size than the frame's.
    bool has_any_size(std::string_view name) const { return find(name, BRUME_LAYER_INPUT)->flags & BRUME_LAYER_ANY_SIZE; }

    const std::vector<FormatLayer> &all() const { return layers_; }

    // Throws Error unless the frame has all inputs and no outputs but those of the format, each once and in memory of its
    // own.
    void check(const brume_frame &frame, size_t lights) const;

    // Imports the frame's inputs and begins its outputs; seen() refers to them until the next begin().
    void begin(const brume_frame &frame, size_t lights, Backend &backend);
    // Brings the outputs to the caller; returns as Backend::finish_output() does.
    int64_t finish(const brume_frame &frame, Backend &backend);
    void release();
    // Of what the frame's layers were converted to.
    uint64_t bytes() const;

    // In the order of an effect's table, where `of` holds the indices that places() gave.
    void see(const std::vector<int> &places, std::vector<brume_plugin_layer> &out) const;
    std::vector<int> places(const std::vector<Layer> &table) const;
    brume_plugin_image input(std::string_view name) const;
    // Of each light; null where the frame brings none.
    const brume_plugin_image *inputs_of_lights(std::string_view name) const;

private:
    // An image of the frame at hand, or one for each light.
    struct Images {
        std::shared_ptr<Image> image;
        std::vector<brume_plugin_image> of_lights;  // empty: none
        bool there = false;
    };

    const FormatLayer *find(std::string_view name, uint32_t direction) const;
    int index_of(std::string_view name, uint32_t direction) const;
    void put(int at, const brume_layer &layer, std::shared_ptr<Image> image, size_t lights);

    std::vector<FormatLayer> layers_;
    std::vector<Images> images_;                // in their order
    std::vector<std::shared_ptr<Image>> held_;  // the frame's inputs, then its outputs
};

}  // namespace brume
