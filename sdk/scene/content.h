#pragma once
#include <array>
#include <vector>

#include "scene/format.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace brume {

// A scene's medium, camera, lights, Gaussians and environment at one frame, as effects see them. Worked out again only where
// the frame's values or the camera are others than the frame's before.
class Content {
public:
    // To plan with: the medium at its peaks. Of Gaussians only that there are some where files bring them with the frame, or
    // frames the camera.
    const brume_plugin_scene &plan(const Scene &scene, const Format &format);

    const brume_plugin_scene &at(const Scene &scene, double frame, const View &view, const Format &format, uint32_t origin);

    // The scene that comes with the next frame is another one.
    void scene_changed();

    const brume_plugin_scene &scene() const { return seen_; }
    void set_output_limit(float limit) { seen_.output_limit = limit; }

private:
    void take_environment(const Scene &scene);
    void point_to_values();

    brume_plugin_scene seen_{};
    brume_plugin_medium medium_{};
    brume_plugin_camera camera_{};
    std::vector<brume_plugin_light> lights_;
    std::vector<brume_plugin_gaussian> gaussians_;
    std::vector<std::array<float, 3>> environment_;

    // What they are of.
    bool evaluated_ = false, animated_ = false;
    double frame_ = 0;
    std::array<double, 16> pose_{};
    uint64_t revision_ = 0;
};

}  // namespace brume
