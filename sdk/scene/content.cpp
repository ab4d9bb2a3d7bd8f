#include "scene/content.h"

#include <cfloat>

#include "base/error.h"

namespace brume {

void Content::take_environment(const Scene &scene)
{
    if (!scene.environment.file.empty() && scene.environment.coefficients.empty())
        throw Error(BRUME_ERROR_SCENE,
                    "environment.file: " + scene.environment.file +
                        " is not read by the library; expected brume_scene_set_environment to have been called");
    environment_.clear();
    for (auto &c : scene.environment.coefficients)
        environment_.push_back({float(c[0]), float(c[1]), float(c[2])});
}

void Content::point_to_values()
{
    seen_.struct_size = sizeof seen_;
    seen_.medium = &medium_;
    seen_.camera = &camera_;
    seen_.lights = lights_.data();
    seen_.gaussians = gaussians_.data();
    seen_.environment = environment_.empty() ? nullptr : reinterpret_cast<const float(*)[3]>(environment_.data());
    seen_.medium_size = sizeof medium_;
    seen_.camera_size = sizeof camera_;
    seen_.light_size = sizeof(brume_plugin_light);
    seen_.gaussian_size = sizeof(brume_plugin_gaussian);
    seen_.light_count = uint32_t(lights_.size());
    seen_.gaussian_count = uint32_t(gaussians_.size());
    seen_.environment_count = uint32_t(environment_.size());
    seen_.revision = revision_;
}

const brume_plugin_scene &Content::plan(const Scene &scene, const Format &format)
{
    const View view = view_of(scene, nullptr, 0, format);
    take_environment(scene);
    fill_camera(scene, view, format, BRUME_ORIGIN_TOP_LEFT, camera_);
    evaluate_medium(with_peak_medium(scene), 0, view.camera_to_world, medium_);
    evaluate_lights(scene, 0, view.camera_to_world, lights_);
    gaussians_.clear();
    const uint32_t placed = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    const bool known = (view.given & placed) == placed && !reads_gaussians_by_frame(scene);
    if (has_gaussians(scene) && known)
        evaluate_gaussians(scene, 0, view.camera_to_world, gaussians_);
    point_to_values();
    seen_.has_medium = scene.medium ? 1 : 0;
    seen_.output_limit = FLT_MAX;
    if (gaussians_.empty()) {
        seen_.gaussians = nullptr;
        seen_.gaussian_count = has_gaussians(scene) ? 1 : 0;
    }
    scene_changed();
    return seen_;
}

void Content::scene_changed()
{
    evaluated_ = false;
    ++revision_;
}

const brume_plugin_scene &Content::at(const Scene &scene, double frame, const View &view, const Format &format,
                                      uint32_t origin)
{
    fill_camera(scene, view, format, origin, camera_);
    const bool other_frame = !evaluated_ || (animated_ && frame != frame_);
    if (!other_frame && pose_ == view.camera_to_world)
        return seen_;
    if (!evaluated_) {
        animated_ = scene.animated();
        take_environment(scene);
    } else if (other_frame) {
        ++revision_;
    }
    evaluated_ = false;  // should one of these throw
    evaluate_medium(scene, frame, view.camera_to_world, medium_);
    evaluate_lights(scene, frame, view.camera_to_world, lights_);
    evaluate_gaussians(scene, frame, view.camera_to_world, gaussians_);
    point_to_values();
    seen_.has_medium = scene.medium ? 1 : 0;
    for (size_t i = 0; i < 3; ++i)
        seen_.position[i] = view.camera_to_world[4 * i + 3] * scene.metres_per_unit;
    frame_ = frame;
    pose_ = view.camera_to_world;
    evaluated_ = true;
    return seen_;
}

}  // namespace brume
