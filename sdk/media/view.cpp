#include "media/view.h"

#include <limits>

#include <brume/brume_plugin.h>

#include "base/error.h"
#include "base/pixels.h"
#include "scene/view.h"
#include "maths.hpp"

namespace brume::media {
namespace {

// As effects see it, with a scene unit for a metre and rows from the top.
maths_double::Camera effects_camera(const brume_camera &camera, const brume_format &format)
{
    const Scene scene;
    brume_plugin_camera from{};
    fill_camera(scene, view_of(scene, &camera, 0, format), format, BRUME_ORIGIN_TOP_LEFT, from);
    maths_double::Camera to{};
    to.tangent_scale = {from.tangent_scale[0], from.tangent_scale[1]};
    to.center = {from.center[0], from.center[1]};
    to.depth_kind = from.depth_kind;
    to.depth_range = {from.depth_range[0], from.depth_range[1]};
    to.far_distance = from.far_distance;
    to.metres_per_unit = from.metres_per_unit;
    to.nonpositive = from.nonpositive;
    return to;
}

}  // namespace

std::optional<Lens::Place> Lens::project(const glm::dvec3 &point) const
{
    const glm::dvec3 from_eye = point - eye;
    const double depth = -glm::dot(axes[2], from_eye);
    if (!(depth > 0))
        return std::nullopt;
    const glm::dvec2 tangent = glm::dvec2(glm::dot(axes[0], from_eye), glm::dot(axes[1], from_eye)) / depth;
    return Place{center + tangent / tangent_scale, depth};
}

glm::dvec3 Lens::direction(const glm::dvec2 &pixel) const
{
    const glm::dvec2 tangent = (pixel - center) * tangent_scale;
    return tangent.x * axes[0] + tangent.y * axes[1] - axes[2];
}

Lens make_lens(const brume_camera &camera, const brume_format &format)
{
    const maths_double::Camera seen = effects_camera(camera, format);
    Lens lens{seen.center, seen.tangent_scale, {}, {}};
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 3; ++i)
            lens.axes[size_t(axis)][i] = camera.camera_to_world[4 * i + axis];
    for (int i = 0; i < 3; ++i)
        lens.eye[i] = camera.camera_to_world[4 * i + 3];
    return lens;
}

std::shared_ptr<const DepthMap> make_depth_map(const brume_format &format, const brume_camera &camera,
                                               const brume_image &image)
{
    if (image.kind != BRUME_IMAGE_HOST)
        throw Error(BRUME_ERROR_UNSUPPORTED, "brume_media_view.depth: a texture; expected host memory");
    if (image.channels != 1 || image.width != format.width || image.height != format.height)
        throw Error(BRUME_ERROR_FORMAT, "brume_media_view.depth: " + std::to_string(image.width) + " x " +
                                            std::to_string(image.height) + " with " + std::to_string(image.channels) +
                                            " channels; expected 1 channel and the format's size");
    const maths_double::Camera seen = effects_camera(camera, format);
    const HostPixels pixels(image);
    auto map = std::make_shared<DepthMap>();
    map->width = uint32_t(format.width);
    map->height = uint32_t(format.height);
    map->depth.resize(size_t(map->width) * map->height);
    std::vector<float> row(map->width);
    for (int y = 0; y < format.height; ++y) {
        load_row_scalar(pixels, image.origin == BRUME_ORIGIN_BOTTOM_LEFT ? format.height - 1 - y : y, row.data());
        for (int x = 0; x < format.width; ++x) {
            const double stretch = glm::length(maths_double::ray_through(seen, {x + 0.5, y + 0.5}));
            const double distance = maths_double::ray_distance(seen, double(row[size_t(x)]), stretch);
            const bool far = distance >= maths_double::far_away;
            map->depth[size_t(y) * map->width + size_t(x)] =
                far ? std::numeric_limits<float>::infinity() : float(distance / stretch);
        }
    }
    return map;
}

}  // namespace brume::media
