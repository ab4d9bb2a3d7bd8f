#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/file.hpp"

namespace brume::tool {

/// What the command line says about layers; empty strings mean "not said".
struct LayerRequest {
    std::string color, part, view, depth;
};

struct ColorChoice {
    int part = 0;
    std::string layer, view;
    std::array<std::string, 3> rgb;  ///< channel names; all three the same for a luminance image
    std::string alpha;               ///< empty where the layer has none
    bool luminance = false;
    std::string reason;

    std::string label() const;
    SampleType type_in(const ImageFile &file) const { return file.part(part).find(rgb[0])->type; }
};

struct DepthChoice {
    int part = 0;
    std::string channel;
    std::string reason;
    double scale = 1;  ///< stored numbers times this are scene units
};

/// Layers are found by name, never by index. Throws RequestError that lists the candidates when none or several fit.
ColorChoice resolve_color(const ImageFile &file, const LayerRequest &request);

/// Other views that have the same layer.
std::vector<std::string> other_views(const ImageFile &file, const ColorChoice &color);

/// `color` is where depth must share the view; null when depth comes from a file of its own.
DepthChoice resolve_depth(const ImageFile &file, const LayerRequest &request, const ColorChoice *color);

/// The same, but nothing and the reason rather than an error where the file has no depth.
std::optional<DepthChoice> find_depth(const ImageFile &file, const LayerRequest &request, const ColorChoice *color,
                                      std::string *why_not);

}  // namespace brume::tool
