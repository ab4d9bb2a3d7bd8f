#pragma once

#include "bench/sample.hpp"
#include "bench/settings.hpp"
#include "run/scene.hpp"

namespace brume::tool {

/// A scene under one setting, planned for a picture. `setting` null: the scene as it is.
class SettingRun {
public:
    /// Throws RequestError where the setting is refused.
    SettingRun(const Context &context, const SceneText &scene, const Setting *setting, const Sample &sample,
               std::string output = "");

    /// Fogs the picture; milliseconds of the effect's passes and of those that serve all effects.
    double execute();

    const std::vector<float> &pixels() const { return pixels_; }
    Picture picture() const { return picture_of(pixels_, sample_.width(), sample_.height(), sample_.channels); }
    const std::vector<float> &extra() const { return extra_; }  ///< RGB of the further output

    bool runs(const std::string &effect) const;
    std::uint64_t bytes() const;  ///< of images that it holds

private:
    const Sample &sample_;
    std::string effect_;
    std::string output_;  ///< layer that is filled, too; empty: none
    Plan plan_;
    std::vector<float> pixels_, extra_;
};

}  // namespace brume::tool
