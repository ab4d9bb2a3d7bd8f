#pragma once

#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
}

#include "camera/block.hpp"
#include "image/resolve.hpp"

namespace brume::tool {

struct DepthKind {
    enum Type { kPlanar, kRay, kInverse, kNormalized, kNegative } type = kPlanar;
    double near = 0, far = 1;   ///< of normalized depth
    bool zero_is_near = false;  ///< planar and ray depth <= 0 is at the camera, not sky

    static DepthKind parse(const std::string &text);
    std::string text() const;

    /// Makes of depth as it is stored what the library takes this kind for: `negative` is planar with the other sign.
    void convert(std::vector<float> &depth) const;
};

struct Sky {
    enum Type { kFog, kKeep, kClamp } type = kFog;
    double distance = 0;  ///< of a clamped sky

    static Sky parse(const std::string &text);
    std::string text() const;
};

/// --plugins
void add_plugins_option(CLI::App &command, std::string &plugins);

struct ColorRequest;

/// --input-space, --output-space and --output-type.
void add_output_options(CLI::App &command, ColorRequest &spaces, std::string &output_type);

/// What the commands that look at one picture have in common.
struct PictureOptions {
    LayerRequest layers;
    std::string depth_kind_text = "planar", sky_text = "fog", camera_file;
    double far = 1e9;
    double depth_scale = 0;  ///< 0: not given
    bool zero_is_near = false;
    double vertical_fov = 0;  ///< [degrees]; 0: not given

    void add_to(CLI::App &command);

    /// Puts the view for %V, and its first letter for %v, into `files`, the first of which is the picture, and into the
    /// names of depth and camera. A picture that is named by its view is that view, so that no more is asked of it.
    void name_view(std::initializer_list<std::string *> files);

    DepthKind depth_kind() const
    {
        DepthKind kind = DepthKind::parse(depth_kind_text);
        kind.zero_is_near = zero_is_near;
        return kind;
    }
    Sky sky() const { return Sky::parse(sky_text); }

    /// "FILE" or "FILE:CHANNEL" names depth in a file of its own; empty where depth is in the picture's file.
    std::string depth_file() const;
    /// The request for depth's own file, or for the picture's.
    LayerRequest depth_request() const;
    /// Depth in integers means nothing without --depth-scale. Throws RequestError.
    void take_depth_scale(DepthChoice &depth, const ImageFile &file) const;

    /// What goes before the scene's camera: --camera or --vfov, which keeps the scene's centre and aspect.
    Camera camera_asked(const PartInfo &picture, const CameraBlock &scene = {}, const std::string &view = "",
                        int frame = 0) const;
};

}  // namespace brume::tool
