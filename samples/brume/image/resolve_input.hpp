#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/resolve.hpp"

namespace brume::tool {

/// A layer of a file that is given to the library under the name of a role: one channel or three.
struct InputChoice {
    std::string role;
    int part = 0;
    std::vector<std::string> channels;
    std::string reason;
    std::optional<std::uint32_t> light = {};  ///< whose it is, of layers of lights

    std::string label() const;
};

/// The layer, channel or part that --input names. `color` is where it must share the view; null where it comes from a file
/// of its own. Throws RequestError that lists the layers where none or several fit.
InputChoice resolve_input(const ImageFile &file, const std::string &role, const std::string &wanted,
                          const ColorChoice *color);

/// The layer that the scene's light names as its own share of the picture. Throws RequestError likewise.
InputChoice resolve_group(const ImageFile &file, const std::string &wanted, std::uint32_t light, const ColorChoice &color);

/// The depth in a light's shadow map: what `wanted` names, else what depth is called. Throws RequestError likewise, and
/// where its numbers cannot be distances.
InputChoice resolve_shadow(const ImageFile &file, const std::string &wanted, std::uint32_t light);

/// Whether some layers are taken for this role without being asked for.
bool has_known_names(const std::string &role);

/// The layer that is named as renderers name this role; nothing where there is none. Throws RequestError where there are
/// several.
std::optional<InputChoice> find_known_input(const ImageFile &file, const std::string &role, const ColorChoice &color);

}  // namespace brume::tool
