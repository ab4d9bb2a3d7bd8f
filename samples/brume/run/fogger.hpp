#pragma once

#include <map>
#include <string>
#include <vector>

#include "run/options.hpp"
#include "image/frame.hpp"
#include "image/resolve.hpp"
#include "image/write.hpp"
#include "metrics/metrics.hpp"
#include "run/inputs.hpp"
#include "run/layers.hpp"
#include "run/scene.hpp"
#include "run/shadow_files.hpp"
#include "support/sdk.hpp"
#include "run/shot.hpp"

namespace brume::tool {

struct FogOptions {
    std::string scene, backend = "auto", plugins;
    std::string preset;  ///< quality; empty: the scene's
    double max_error = 0, budget_ms = 0;
    std::vector<std::string> set;     ///< effect.param=value
    std::vector<std::string> layers;  ///< extra outputs by name
    std::vector<std::string> inputs;  ///< role=layer
    bool element = false;             ///< to go over a plate in the same fog
    PictureOptions picture;

    void add_to(CLI::App &command);
    void add_scene_to(CLI::App &command);  ///< scene, backend, plugins, `set` and picture alone
};

struct PassTime {
    std::string effect, name;
    double ms;
};

struct FogReport {
    std::vector<PassTime> passes;
    std::string camera;  ///< where field of view and pose came from
    std::vector<std::string> warnings;
    bool nothing_to_do = false;
};

/// The library with one scene: a plan for each format met, made when first needed. One thread at a time.
class Fogger {
public:
    explicit Fogger(const FogOptions &options);

    /// Another text in the place of the scene file's, with files relative to that. Throws RequestError.
    void change_scene(const std::string &text);

    /// Learns from a frame what predictions of quality depend on, where quality is asked for and the scene does not say.
    void expect(const ImageFile &file, const ColorChoice &color, const ImageFile &depth_file, const DepthChoice &depth,
                const std::vector<OpenInput> &inputs, int number);

    /// Finds the roles that effects of the scene read and that layers of known names are taken for.
    void learn_roles(const ImageFile &file, const ColorChoice &color, int number);

    /// The layers that the library is to be given with such a picture. May be called from any thread.
    std::vector<OpenInput> open_inputs(const ImageFile &file, const ColorChoice &color, int number,
                                       const ReadLimits &limits) const;

    /// The pixels of one of them. stored: every channel of the choice's part of the picture, where they have been read
    /// already. May be called from any thread.
    InputLayer read_pixels(const OpenInput &input, const ImageFile &picture, const PartInfo &onto,
                           const StoredPixels *stored) const;

    /// Makes the plan for such a picture, and throws RequestError where the scene cannot be planned for it or needs a camera
    /// that nobody gave.
    Plan &plan_for(const ImageFile &file, const ColorChoice &color, const LuminanceWeights &weights,
                   const std::vector<std::string> &roles, int number);

    /// In place. Throws FrameError.
    FogReport fog(Frame &frame, int number, const LuminanceWeights &weights, std::vector<AddedLayer> &layers);

    const Context &context() const { return context_; }
    /// What the frames' attribute says of it.
    const std::string &provenance() const { return provenance_; }
    const brume_scene_info &scene_info() const { return scene_info_; }
    Shot shot_of(const ImageFile &file, const ColorChoice &color, int number) const;

private:
    Fogger(const FogOptions &options, const SceneText &text);
    void take_scene(const SceneText &text);
    void ask_for_quality();
    std::vector<LightGroup> scene_groups() const;
    void take_uncovered_light(Plan &plan, brume_frame call, Frame &frame) const;

    FogOptions options_;
    Context context_;
    Scene scene_;
    std::string provenance_;
    CameraBlock scene_camera_;
    brume_scene_info scene_info_ = BRUME_SCENE_INFO_INIT;
    std::vector<LayerOutput> outputs_;
    std::vector<brume_layer> output_layers_;  ///< of `outputs_`, as formats have them
    std::vector<InputRequest> inputs_;
    std::vector<std::string> known_roles_;
    std::vector<LightGroup> groups_;
    std::vector<ShadowFile> shadows_;
    mutable ShadowFiles shadow_files_;
    std::map<std::pair<std::vector<double>, std::vector<std::string>>, Plan> plans_;
};

}  // namespace brume::tool
