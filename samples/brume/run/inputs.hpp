#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/frame.hpp"
#include "image/resolve_input.hpp"
#include "support/sdk.hpp"

namespace CLI {
class App;
}

namespace brume::tool {

/// Roles of which there is one layer for each light.
inline constexpr const char *kLightGroup = "light_group", *kShadow = "shadow";

/// What --input says: ROLE=LAYER, or ROLE=FILE.exr:LAYER.
struct InputRequest {
    std::string role, file, layer;
};

/// Throws RequestError.
InputRequest parse_input(const std::string &text);

void add_input_option(CLI::App &command, std::vector<std::string> &inputs);

/// A role is an input layer that some effect or the library reads. Throws RequestError.
std::vector<InputRequest> parse_inputs(const Context &context, const std::vector<std::string> &texts);

/// Roles that some effect which is loaded reads, and that layers are taken for without being asked for.
std::vector<std::string> known_roles(const Context &context);

/// The layer of one light's own share of the picture.
struct LightGroup {
    std::uint32_t light;
    std::string layer;
};

/// The file, or files, of one light's shadow map; FILE:LAYER where a layer is named.
struct ShadowFile {
    std::uint32_t light;
    std::string file;
};

/// A layer to be given to the library, and the file it is in where that is not the picture's.
struct OpenInput {
    InputChoice choice;
    std::optional<ImageFile> file;
};

/// What was asked for, the scene's groups and shadow maps, and of `known` roles what the picture's file has. Throws
/// FrameError for files that cannot be read, RequestError where layers cannot be resolved.
std::vector<OpenInput> open_inputs(const ImageFile &file, const ColorChoice &color, int frame,
                                   const std::vector<InputRequest> &asked, const std::vector<std::string> &known,
                                   const std::vector<LightGroup> &groups, const std::vector<ShadowFile> &shadows,
                                   const ReadLimits &limits);

/// Each once.
std::vector<std::string> roles_of(const std::vector<OpenInput> &inputs);
std::vector<std::string> roles_of(const std::vector<InputLayer> &inputs);

/// As parts of a brume_format. The names are kept by the caller.
std::vector<brume_layer> input_layers(const std::vector<std::string> &roles);

/// Inputs as a frame has them. The layers are kept by the caller.
class GivenLayers {
public:
    explicit GivenLayers(const std::vector<InputLayer> &inputs);
    void give_to(brume_frame &frame) const;

private:
    std::vector<brume_image> images_;
    std::vector<brume_layer> layers_;
};

/// Its role, with the light whose it is.
std::string name_of(const OpenInput &input);

/// "FILE:CHANNELS: reason" of one of them.
std::string description(const OpenInput &input);

}  // namespace brume::tool
