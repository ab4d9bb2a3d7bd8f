#include "scene/view.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/scene_ranges.h"

namespace brume {
namespace {

struct DisplayWindow {
    double x, y, width, height;
};

DisplayWindow display_window(const brume_format &format)
{
    if (format.display_width == 0)
        return {0, 0, double(format.width), double(format.height)};
    return {double(format.display_x), double(format.display_y), double(format.display_width), double(format.display_height)};
}

}  // namespace

View view_of(const Scene &scene, const brume_camera *frame_camera, double frame, const brume_format &format)
{
    View view;
    const Camera &camera = scene.camera;
    auto window = display_window(format);
    if (camera.vertical_fov || camera.horizontal_fov) {
        view.given |= BRUME_CAMERA_FIELD_OF_VIEW;
        view.pixel_aspect = camera.pixel_aspect.at(frame);
        view.center = {camera.center[0].at(frame), camera.center[1].at(frame)};
        view.vertical_fov = camera.vertical_fov ? camera.vertical_fov->at(frame)
                                                : 2 * std::atan(std::tan(camera.horizontal_fov->at(frame) / 2) *
                                                                window.height / (window.width * view.pixel_aspect));
    }
    if (camera.camera_to_world) {
        view.given |= BRUME_CAMERA_POSE;
        for (size_t i = 0; i < 16; ++i)
            view.camera_to_world[i] = (*camera.camera_to_world)[i].at(frame);
    }
    if (frame_camera && frame_camera->given & BRUME_CAMERA_FIELD_OF_VIEW) {
        view.given |= BRUME_CAMERA_FIELD_OF_VIEW;
        view.vertical_fov = frame_camera->vertical_fov;
        view.pixel_aspect = frame_camera->pixel_aspect;
        view.center = {frame_camera->center[0], frame_camera->center[1]};
    }
    if (frame_camera && frame_camera->given & BRUME_CAMERA_POSE) {
        view.given |= BRUME_CAMERA_POSE;
        std::copy_n(frame_camera->camera_to_world, 16, view.camera_to_world.begin());
    }
    return view;
}

void fill_camera(const Scene &scene, const View &view, const brume_format &format, uint32_t origin, brume_plugin_camera &out)
{
    auto window = display_window(format);
    // Without a field of view nothing reads these (the plan's needs are checked first); any finite one will do.
    double half = view.given & BRUME_CAMERA_FIELD_OF_VIEW ? std::tan(view.vertical_fov / 2) : 0.5;
    double focal_y = 0.5 * window.height / half;
    double focal_x = focal_y / view.pixel_aspect;
    double center_x = window.x + view.center[0] * window.width;
    double center_y = window.y + view.center[1] * window.height;
    bool bottom_up = origin == BRUME_ORIGIN_BOTTOM_LEFT;
    out.focal[0] = float(focal_x);
    out.focal[1] = float(focal_y);
    out.tangent_scale[0] = float(1 / focal_x);
    out.tangent_scale[1] = float(bottom_up ? 1 / focal_y : -1 / focal_y);
    out.center[0] = float(center_x);
    out.center[1] = float(bottom_up ? format.height - center_y : center_y);
    out.depth_kind = int32_t(format.depth_kind);
    out.sky = int32_t(format.sky);
    double metres = scene.metres_per_unit;
    auto range = [&](double value) {
        double length = value * metres;
        return float(format.depth_kind == BRUME_DEPTH_DEVICE ? 1 / length : length);
    };
    out.depth_range[0] = range(format.depth_range[0]);
    out.depth_range[1] = range(format.depth_range[1]);
    out.far_distance = float(std::min(format.far_distance * metres, 1e30));
    out.sky_distance = float(std::min(format.sky_distance * metres, 1e30));
    out.metres_per_unit = float(metres);
    out.nonpositive = int32_t(format.nonpositive);
    for (int i = 0; i < 3; ++i) {
        out.right[i] = float(view.camera_to_world[size_t(4 * i)]);
        out.up[i] = float(view.camera_to_world[size_t(4 * i + 1)]);
        out.back[i] = float(view.camera_to_world[size_t(4 * i + 2)]);
    }
}

void check_camera(const brume_camera &camera)
{
    auto refuse = [](const std::string &what, double value, const char *expected) {
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("camera.{}: {}; expected {}", what, value, expected));
    };
    if (camera.given & BRUME_CAMERA_FIELD_OF_VIEW) {
        if (!(camera.vertical_fov >= 1e-6 && camera.vertical_fov <= 3.141592))
            refuse("vertical_fov", camera.vertical_fov, "an angle from 1e-6 to 3.141592");
        if (!ranges::pixel_aspect.contains(camera.pixel_aspect))
            refuse("pixel_aspect", camera.pixel_aspect, ranges::pixel_aspect.describe().c_str());
        for (double c : camera.center)
            if (!ranges::center.contains(c))
                refuse("center", c, ranges::center.describe().c_str());
    }
    if (camera.given & BRUME_CAMERA_POSE) {
        const double *m = camera.camera_to_world;
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(m[i]))
                refuse("camera_to_world[" + std::to_string(i) + "]", m[i], "a finite number");
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) {
                double dot = m[i] * m[j] + m[4 + i] * m[4 + j] + m[8 + i] * m[8 + j];
                if (std::abs(dot - (i == j)) > 1e-3)
                    refuse("camera_to_world: product of columns " + std::to_string(i) + " and " + std::to_string(j), dot,
                           "a rigid transform (orthonormal columns)");
            }
        double determinant =
            m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
        if (determinant < 0)
            refuse("camera_to_world: determinant", determinant, "1 (a rigid transform, not a mirroring one)");
        for (int i = 12; i < 16; ++i)
            if (m[i] != (i == 15))
                refuse("camera_to_world[" + std::to_string(i) + "]", m[i], "a last row of 0 0 0 1");
    }
    if (camera.given & ~(BRUME_CAMERA_FIELD_OF_VIEW | BRUME_CAMERA_POSE))
        refuse("given", camera.given, "BRUME_CAMERA_... flags");
}

}  // namespace brume
