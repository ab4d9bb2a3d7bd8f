#include "fog.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace openfx {
namespace {

constexpr double degree = std::numbers::pi / 180;

void check(brume_context context, brume_status status)
{
    if (status == BRUME_OK)
        return;
    std::string message(brume_message(context, nullptr, 0), '\0');
    brume_message(context, message.data(), message.size());
    message.pop_back();
    throw LibraryError(status, message.empty() ? brume_status_name(status) : message);
}

// The camera stands at the origin; height is the fog's matter.
brume_camera camera(const Settings &settings, const Frame &frame)
{
    const double c = std::cos(settings.camera_tilt * degree), s = std::sin(settings.camera_tilt * degree);
    brume_camera camera = BRUME_CAMERA_INIT;
    camera.given = BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE;
    camera.vertical_fov = settings.vertical_fov * degree;
    camera.pixel_aspect = frame.pixel_aspect;
    camera.camera_to_world[5] = camera.camera_to_world[10] = c;
    camera.camera_to_world[6] = -s;
    camera.camera_to_world[9] = s;
    return camera;
}

brume_format format(const Settings &settings, const Frame &frame)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = frame.width;
    format.height = frame.height;
    format.display_x = frame.display_x;
    format.display_y = frame.display_y;
    format.display_width = frame.display_width;
    format.display_height = frame.display_height;
    format.depth_kind = uint32_t(settings.depth_kind);
    format.depth_range[0] = settings.near_distance;
    format.depth_range[1] = settings.far_distance;
    format.sky = uint32_t(settings.sky);
    format.sky_distance = settings.sky_distance;
    return format;
}

}  // namespace

Fog::Fog(uint32_t backend, brume_progress_callback progress, void *user)
{
    brume_context_desc desc = BRUME_CONTEXT_DESC_INIT;
    desc.backend = backend;
    desc.gl_context = BRUME_GL_BORROWED;
    desc.threads = std::min(granted_threads(), 1024u);
    desc.progress = progress;
    desc.progress_user = user;
    brume_context context = nullptr;
    openfx::check(nullptr, brume_context_create(&desc, &context));
    context_.reset(context);
}

void Fog::check(brume_status status) const
{
    openfx::check(context_.get(), status);
}

Owned<brume_scene> Fog::scene_of_file(const Settings &settings, const Frame &frame) const
{
    const std::string &text = settings.scene_text;
    brume_scene made = nullptr;
    check(brume_scene_create_from_text(context_.get(), text.data(), text.size(), settings.scene_file.c_str(), &made));
    Owned<brume_scene> scene(made);
    uint32_t given = 0;
    check(brume_scene_get_camera_given(made, &given));
    if (given == BRUME_CAMERA_POSE)
        throw Refusal("Scene file: \"" + settings.scene_file +
                      "\": a camera with a pose and no field of view; expected both or neither");
    const brume_camera standing = camera(settings, frame);
    if (given == 0)
        check(brume_scene_set_camera(made, &standing));
    return scene;
}

Owned<brume_scene> Fog::scene_of_parameters(const Settings &settings, const Frame &frame) const
{
    brume_density_term falloff = BRUME_DENSITY_TERM_INIT;
    falloff.type = BRUME_DENSITY_EXPONENTIAL;
    falloff.falloff = settings.falloff;
    falloff.origin[1] = -settings.camera_height / settings.metres;
    brume_medium medium = BRUME_MEDIUM_INIT;
    const double extinction = 3.912 / settings.visibility;
    for (int i = 0; i < 3; ++i) {
        medium.scattering[i] = extinction * settings.scattering[i];
        medium.absorption[i] = extinction * settings.absorption[i];
    }
    medium.g = settings.g;
    if (settings.falloff > 0) {
        medium.terms = &falloff;
        medium.term_count = 1;
    }
    const brume_camera standing = camera(settings, frame);
    brume_scene made = nullptr;
    check(brume_scene_create(context_.get(), &made));
    Owned<brume_scene> scene(made);
    check(brume_scene_set_metres_per_unit(made, settings.metres));
    check(brume_scene_set_medium(made, &medium));
    check(brume_scene_set_camera(made, &standing));
    return scene;
}

void Fog::prepare(const Settings &settings, const Frame &frame)
{
    if (plan_ && settings == settings_ && frame == frame_)
        return;
    const Owned<brume_scene> scene =
        settings.scene_file.empty() ? scene_of_parameters(settings, frame) : scene_of_file(settings, frame);
    if (settings.quality != BRUME_PRESET_NONE) {
        brume_quality quality = BRUME_QUALITY_INIT;
        quality.preset = uint32_t(settings.quality);
        check(brume_scene_set_quality(scene.get(), &quality));
    }
    const brume_format wanted = format(settings, frame);
    // A value that is animated leaves the plan's structure as it was. Whether it does nothing is of the scene that was
    // planned.
    if (!plan_ || does_nothing() || brume_plan_update(plan_.get(), scene.get(), &wanted) != BRUME_OK) {
        plan_.reset();
        brume_plan made = nullptr;
        check(brume_plan_create(scene.get(), &wanted, &made));
        plan_.reset(made);
    }
    settings_ = settings;
    frame_ = frame;
}

bool Fog::does_nothing(const Settings &settings, const Frame &frame)
{
    if (!plan_ || settings != settings_)
        prepare(settings, frame);
    return does_nothing();
}

bool Fog::does_nothing() const
{
    brume_plan_info info = BRUME_PLAN_INFO_INIT;
    check(brume_plan_get_info(plan_.get(), &info));
    return info.does_nothing != 0;
}

void Fog::run(const brume_image &color, const brume_image &depth, const brume_image &output, ofx::Time time)
{
    brume_frame frame = BRUME_FRAME_INIT;
    frame.color = &color;
    frame.depth = &depth;
    frame.output = &output;
    frame.frame = time;
    check(brume_plan_execute(plan_.get(), &frame));
}

}  // namespace openfx
