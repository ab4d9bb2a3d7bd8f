#include <cmath>
#include <numbers>

#include <ImathMatrix.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <fmt/format.h>

#include "camera/camera.hpp"

namespace brume::tool {
namespace {

using Imath::M44d;
using Imath::V3d;

std::optional<M44d> matrix(const Imf::Header &header, const char *name)
{
    std::optional<M44d> found;
    if (const auto *f = header.findTypedAttribute<Imf::M44fAttribute>(name))
        found = M44d(f->value());
    if (const auto *d = header.findTypedAttribute<Imf::M44dAttribute>(name))
        found = d->value();
    if (found)
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite((*found)[i / 4][i % 4]))
                return std::nullopt;
    return found;
}

std::optional<double> number(const Imf::Header &header, const char *name)
{
    if (const auto *f = header.findTypedAttribute<Imf::FloatAttribute>(name))
        return double(f->value());
    if (const auto *d = header.findTypedAttribute<Imf::DoubleAttribute>(name))
        return d->value();
    if (const auto *i = header.findTypedAttribute<Imf::IntAttribute>(name))
        return double(i->value());
    return std::nullopt;
}

/// `m` maps row vectors from camera to world; its rows are the camera's right, up and `back`ward axes and its place.
std::optional<Pose> pose_from_rows(const M44d &m, double backward)
{
    Pose pose{};
    for (int axis = 0; axis < 3; ++axis) {
        V3d direction(m[axis][0], m[axis][1], m[axis][2]);
        if (!(direction.length() > 0))
            return std::nullopt;
        direction.normalize();  // a renderer's units may sit in the matrix as a scale
        if (axis == 2)
            direction *= backward;
        for (int i = 0; i < 3; ++i)
            pose[std::size_t(4 * i + axis)] = direction[i];
    }
    for (int i = 0; i < 3; ++i)
        pose[std::size_t(4 * i + 3)] = m[3][i];
    pose[15] = 1;
    return pose;
}

struct Ndc {
    double x, y, w;
};

Ndc project(const M44d &camera_to_ndc, const V3d &p)
{
    const auto row = [&](int c) {
        return p.x * camera_to_ndc[0][c] + p.y * camera_to_ndc[1][c] + p.z * camera_to_ndc[2][c] + camera_to_ndc[3][c];
    };
    const double w = row(3);
    return {row(0) / w, row(1) / w, w};
}

void add_standard(const Imf::Header &header, Camera &camera)
{
    const auto world_to_camera = matrix(header, "worldToCamera");
    if (!world_to_camera)
        return;
    M44d camera_to_world;
    try {
        camera_to_world = world_to_camera->inverse(true);
    } catch (const std::exception &) {
        camera.notes.push_back("worldToCamera is singular: ignored");
        return;
    }

    // The standard's camera looks along +z (left-handed), but right-handed ones that look along -z are written as well.
    // What worldToNDC shows in front of the camera decides; without it, handedness does.
    double forward = world_to_camera->determinant() < 0 ? 1 : -1;
    if (const auto world_to_ndc = matrix(header, "worldToNDC")) {
        const M44d camera_to_ndc = camera_to_world * *world_to_ndc;
        const double w_scale = camera_to_ndc[2][3];
        if (std::abs(w_scale) < 1e-9) {
            camera.notes.push_back("worldToNDC is orthographic: it gives no field of view");
        } else {
            forward = w_scale > 0 ? 1 : -1;
            const Ndc axis = project(camera_to_ndc, {0, 0, forward});
            const double x_slope = project(camera_to_ndc, {1, 0, forward}).x - axis.x;
            const double y_slope = project(camera_to_ndc, {0, 1, forward}).y - axis.y;
            // The standard's NDC runs over 0..1 with y down; y up marks the -1..1 screen space that others write there.
            const bool screen = y_slope > 0;
            const double low = screen ? -1 : 0;
            if (x_slope > 0 && y_slope != 0 && std::isfinite(axis.x) && std::isfinite(axis.y)) {
                const auto at = [](double value, double origin, double slope) { return (value - origin) / slope; };
                Projection p{at(low, axis.x, x_slope), at(1, axis.x, x_slope), at(screen ? -1 : 1, axis.y, y_slope),
                             at(screen ? 1 : 0, axis.y, y_slope)};
                camera.projection = p;
                camera.projection_source = screen ? "worldToNDC (read as -1..1: its y points up)" : "worldToNDC";
            } else {
                camera.notes.push_back("worldToNDC is not a perspective view: ignored");
            }
        }
    }
    camera.pose = pose_from_rows(camera_to_world, -forward);
    camera.pose_source = "worldToCamera";
}

void add_vray(const Imf::Header &header, Camera &camera)
{
    if (const auto camera_to_world = matrix(header, "cameraTransform"); camera_to_world && !camera.pose) {
        camera.pose = pose_from_rows(*camera_to_world, 1);
        if (camera.pose)
            camera.pose_source = "cameraTransform (V-Ray's, camera to world)";
    }
    if (camera.projection)
        return;
    if (const auto projection = number(header, "cameraProjection"); projection && *projection != 0) {
        camera.notes.push_back(
            fmt::format("cameraProjection is {} (expected 0, perspective): no field of view", *projection));
        return;
    }
    auto fov = number(header, "cameraFov");
    std::string source = "cameraFov (V-Ray's, horizontal)";
    if (!fov) {
        const auto aperture = number(header, "cameraAperture"), focal = number(header, "cameraFocalLength");
        if (!aperture || !focal || !(*focal > 0))
            return;
        fov = 2 * std::atan(0.5 * *aperture / *focal) * 180 / std::numbers::pi;
        source = "cameraAperture and cameraFocalLength";
    }
    if (!(*fov > 0 && *fov < 180)) {
        camera.notes.push_back(
            fmt::format("{} gives a field of view of {} degrees (expected 0 to 180): ignored", source, *fov));
        return;
    }
    camera.projection =
        Projection::from_horizontal_fov(*fov * std::numbers::pi / 180, header.displayWindow(), header.pixelAspectRatio());
    camera.projection_source = source;
}

}  // namespace

Camera camera_from_metadata(const Imf::Header &header)
{
    Camera camera;
    add_standard(header, camera);
    add_vray(header, camera);
    return camera;
}

}  // namespace brume::tool
