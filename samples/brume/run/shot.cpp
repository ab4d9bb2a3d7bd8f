#include "run/shot.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace brume::tool {

brume_format format_of(const Window &data, const Window &display, const PictureOptions &options)
{
    brume_format format = BRUME_FORMAT_INIT;
    format.width = data.width();
    format.height = data.height();
    // Rays come from the display window, whatever part of it, or of what surrounds it, the data window covers.
    format.display_x = display.min.x - data.min.x;
    format.display_y = display.min.y - data.min.y;
    format.display_width = display.width();
    format.display_height = display.height();
    const DepthKind kind = options.depth_kind();
    constexpr std::uint32_t kinds[] = {BRUME_DEPTH_PLANAR, BRUME_DEPTH_RAY, BRUME_DEPTH_INVERSE, BRUME_DEPTH_NORMALIZED,
                                       BRUME_DEPTH_PLANAR};
    format.depth_kind = kinds[kind.type];
    format.depth_range[0] = kind.near;
    format.depth_range[1] = kind.far;
    format.nonpositive = kind.zero_is_near ? BRUME_NONPOSITIVE_NEAR : BRUME_NONPOSITIVE_FAR;
    format.far_distance = options.far;
    const Sky sky = options.sky();
    constexpr std::uint32_t skies[] = {BRUME_SKY_FOG, BRUME_SKY_KEEP, BRUME_SKY_CLAMP};
    format.sky = skies[sky.type];
    format.sky_distance = sky.distance;
    return format;
}

brume_camera camera_of(const Camera &camera, const Window &display)
{
    brume_camera result = BRUME_CAMERA_INIT;
    if (camera.projection) {
        result.given |= BRUME_CAMERA_FIELD_OF_VIEW;
        result.vertical_fov = camera.projection->vertical_fov();
        result.pixel_aspect = camera.projection->pixel_aspect(display);
        result.center[0] = camera.projection->center()[0];
        result.center[1] = camera.projection->center()[1];
    }
    if (camera.pose) {
        result.given |= BRUME_CAMERA_POSE;
        std::copy(camera.pose->begin(), camera.pose->end(), result.camera_to_world);
    }
    return result;
}

Camera camera_of_picture(const ImageFile &file, const ColorChoice &color, const PictureOptions &options,
                         const CameraBlock &scene, int frame)
{
    const PartInfo &picture = file.part(color.part);
    Camera camera = options.camera_asked(picture, scene, color.view, frame);
    camera.fill_from(scene.at(frame, picture, "scene file"));
    if (!camera.projection || !camera.pose)
        camera.fill_from(camera_from_metadata(file, color.part));
    return camera;
}

Shot shot_of(const ImageFile &file, const ColorChoice &color, const PictureOptions &options, const CameraBlock &scene,
             int frame)
{
    Shot shot;
    const Window &display = file.part(color.part).display_window;
    shot.format = format_of(file.parts()[std::size_t(color.part)].data_window, display, options);
    const Camera camera = camera_of_picture(file, color, options, scene, frame);
    shot.camera_source = fmt::format("field of view: {}; pose: {}", camera.projection ? camera.projection_source : "none",
                                     camera.pose ? camera.pose_source : "none");
    shot.camera_notes = camera.notes;
    shot.camera = camera_of(camera, display);
    return shot;
}

}  // namespace brume::tool
