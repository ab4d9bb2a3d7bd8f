#include <cmath>
#include <numbers>

#include <ImathMatrix.h>
#include <fmt/format.h>

#include "camera/camera.hpp"

namespace brume::tool {
namespace {

using Imath::M44d;
using Imath::V3d;

const std::vector<double> *numbers(const PartInfo &part, const char *name)
{
    const auto at = part.attributes.find(name);
    return at == part.attributes.end() ? nullptr : &at->second;
}

std::optional<M44d> matrix(const PartInfo &part, const char *name)
{
    const std::vector<double> *elements = numbers(part, name);
    if (!elements || elements->size() != 16)
        return std::nullopt;
    M44d m;
    for (int i = 0; i < 16; ++i) {
        m[i / 4][i % 4] = (*elements)[std::size_t(i)];
        if (!std::isfinite(m[i / 4][i % 4]))
            return std::nullopt;
    }
    return m;
}

std::optional<double> number(const PartInfo &part, const char *name)
{
    const std::vector<double> *value = numbers(part, name);
    return value && value->size() == 1 ? std::optional(value->front()) : std::nullopt;
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
    double x, y;
};

Ndc project(const M44d &camera_to_ndc, const V3d &p)
{
    const auto row = [&](int c) {
        return p.x * camera_to_ndc[0][c] + p.y * camera_to_ndc[1][c] + p.z * camera_to_ndc[2][c] + camera_to_ndc[3][c];
    };
    const double w = row(3);
    return {row(0) / w, row(1) / w};
}

bool is_affine(const M44d &m)
{
    return std::abs(m[0][3]) < 1e-5 && std::abs(m[1][3]) < 1e-5 && std::abs(m[2][3]) < 1e-5 && std::abs(m[3][3] - 1) < 1e-5;
}

/// The standard's pair, for row vectors.
struct Matrices {
    M44d world_to_camera, camera_to_world;
    std::optional<M44d> camera_to_ndc;
    bool were_transposed = false;

    Matrices(const M44d &to_camera, const std::optional<M44d> &to_ndc, bool transposed)
        : world_to_camera(transposed ? to_camera.transposed() : to_camera), camera_to_world(world_to_camera.inverse(true)),
          were_transposed(transposed)
    {
        if (to_ndc)
            camera_to_ndc = camera_to_world * (transposed ? to_ndc->transposed() : *to_ndc);
    }

    double w_slope() const { return (*camera_to_ndc)[2][3]; }
    /// Whether x and y over w make a picture of what stands along the camera's z, and depth is a matter of z alone.
    bool is_perspective() const
    {
        const M44d &m = *camera_to_ndc;
        const double least = 1e-3 * std::abs(w_slope()), z = 1e-3 * (std::abs(m[2][2]) + std::abs(m[3][2]));
        return least > 0 && std::abs(m[0][3]) <= least && std::abs(m[1][3]) <= least && std::abs(m[0][2]) <= z &&
               std::abs(m[1][2]) <= z;
    }
};

/// pbrt stores matrices for column vectors. A translation shows it; without one, what the other reading makes of the NDC.
std::optional<Matrices> read_standard(const PartInfo &part, const M44d &world_to_camera, Camera &camera)
try {
    const auto world_to_ndc = matrix(part, "worldToNDC");
    const bool rows = is_affine(world_to_camera), columns = is_affine(world_to_camera.transposed());
    if (!rows && !columns) {
        const M44d &m = world_to_camera;
        camera.notes.push_back(fmt::format("worldToCamera is ignored: its last column is {:.4g} {:.4g} {:.4g} {:.4g} "
                                           "(expected 0 0 0 1)",
                                           m[0][3], m[1][3], m[2][3], m[3][3]));
        return std::nullopt;
    }
    const Matrices as_rows(world_to_camera, world_to_ndc, !rows);
    if (!rows || !columns || !world_to_ndc || as_rows.w_slope() == 0)
        return as_rows;
    const Matrices as_columns(world_to_camera, world_to_ndc, true);
    const auto is_usual = [](const Matrices &m) { return m.is_perspective() && std::abs(std::abs(m.w_slope()) - 1) < 1e-3; };
    return is_usual(as_columns) && !is_usual(as_rows) ? as_columns : as_rows;
} catch (const std::exception &) {
    camera.notes.push_back("worldToCamera is singular: ignored");
    return std::nullopt;
}

/// NDC of the standard runs over 0..1 with y down. Renderers write 0..1 with y up and -1..1 screen space there as well, and
/// some span 0..1 by the shorter side of the window alone.
void add_projection(const Matrices &matrices, const PartInfo &part, Camera &camera)
{
    const M44d &m = *matrices.camera_to_ndc;
    const double w = matrices.w_slope(), tilt = 1e-3 * std::abs(w);
    if (std::abs(w) < 1e-9) {
        camera.notes.push_back("worldToNDC is orthographic: it gives no field of view");
        return;
    }
    const double front = w > 0 ? 1 : -1;
    const Ndc axis = project(m, {0, 0, front});
    const double x_slope = project(m, {1, 0, front}).x - axis.x, y_slope = project(m, {0, 1, front}).y - axis.y;
    if (!(x_slope > 0) || !(y_slope != 0) || !std::isfinite(axis.x) || !std::isfinite(axis.y) || !std::isfinite(x_slope) ||
        !std::isfinite(y_slope) || std::abs(m[0][3]) > tilt || std::abs(m[1][3]) > tilt) {
        camera.notes.push_back("worldToNDC is not a perspective view along the camera's axis: ignored");
        return;
    }
    const bool screen = std::abs(axis.x) + std::abs(axis.y) < std::abs(axis.x - 0.5) + std::abs(axis.y - 0.5);
    const double low = screen ? -1 : 0, bottom = y_slope > 0 ? low : 1, top = y_slope > 0 ? 1 : low;
    Projection p{(low - axis.x) / x_slope, (1 - axis.x) / x_slope, (bottom - axis.y) / y_slope, (top - axis.y) / y_slope};
    std::string how = screen ? "-1..1" : y_slope > 0 ? "0..1, y up" : "";
    if (matrices.were_transposed)
        how += how.empty() ? "for column vectors" : ", for column vectors";

    const Window &display = part.display_window;
    const double width = double(display.max.x) - display.min.x + 1, height = double(display.max.y) - display.min.y + 1;
    const double window = width * part.pixel_aspect / height;
    if (std::abs(x_slope / std::abs(y_slope) - 1) < 1e-4 && std::abs(window - 1) > 1e-3) {
        const double wide = std::max(window, 1.0), high = std::max(1 / window, 1.0), half = 0.5 * (p.top - p.bottom);
        const double x = 0.5 * (p.left + p.right), y = 0.5 * (p.top + p.bottom);
        p = {x - half * wide, x + half * wide, y - half * high, y + half * high};
        how += how.empty() ? "of the shorter side" : ", of the shorter side";
    } else if (const double aspect = p.pixel_aspect(display); std::abs(aspect / part.pixel_aspect - 1) > 0.02) {
        camera.notes.push_back(fmt::format("worldToNDC has pixels of the aspect {:.4g}, pixelAspectRatio is {:.4g}: the "
                                           "former is taken",
                                           aspect, part.pixel_aspect));
    }
    camera.projection = p;
    camera.projection_source = how.empty() ? "worldToNDC" : fmt::format("worldToNDC (read as {})", how);
}

/// Notes and leaves out what is no rigid motion.
void take_pose(Camera &camera, const std::optional<Pose> &pose, const char *matrix, const std::string &source)
{
    const std::string defect = pose ? rigid_defect(*pose) : "an axis of it has no length";
    if (!defect.empty()) {
        camera.notes.push_back(fmt::format("{} gives no pose: {}", matrix, defect));
        return;
    }
    camera.pose = pose;
    camera.pose_source = source;
}

void add_standard(const PartInfo &part, Camera &camera)
{
    const auto world_to_camera = matrix(part, "worldToCamera");
    if (!world_to_camera) {
        if (part.attributes.contains("worldToCamera"))
            camera.notes.push_back("worldToCamera is ignored: expected a 4 x 4 matrix of finite numbers");
        return;
    }
    const auto matrices = read_standard(part, *world_to_camera, camera);
    if (!matrices)
        return;
    if (matrices->camera_to_ndc)
        add_projection(*matrices, part, camera);

    // The world is right-handed, so a camera with x right and y up that mirrors looks along +z (the standard's; Mantra's,
    // whose NDC has the sign of one that looks along -z), and one that does not looks along -z. Where the NDC shows +z
    // without mirroring, the world itself is left-handed (pbrt's), and no rigid pose fits it.
    const bool mirrors = matrices->world_to_camera.determinant() < 0;
    if (!mirrors && matrices->camera_to_ndc && matrices->w_slope() > 1e-9) {
        camera.notes.push_back("worldToCamera gives no pose: with worldToNDC it describes a left-handed world, as pbrt's");
        return;
    }
    take_pose(camera, pose_from_rows(matrices->camera_to_world, mirrors ? -1 : 1), "worldToCamera",
              matrices->were_transposed ? "worldToCamera (for column vectors)" : "worldToCamera");
}

void add_vray(const PartInfo &part, Camera &camera)
{
    if (const auto camera_to_world = matrix(part, "cameraTransform"); camera_to_world && !camera.pose) {
        if (is_affine(*camera_to_world))
            take_pose(camera, pose_from_rows(*camera_to_world, 1), "cameraTransform",
                      "cameraTransform (V-Ray's, camera to world)");
        else
            camera.notes.push_back("cameraTransform is ignored: its last column is not 0 0 0 1");
    }
    if (camera.projection)
        return;
    if (const auto projection = number(part, "cameraProjection"); projection && *projection != 0) {
        camera.notes.push_back(
            fmt::format("cameraProjection is {} (expected 0, perspective): no field of view", *projection));
        return;
    }
    auto fov = number(part, "cameraFov");
    std::string source = "cameraFov (V-Ray's, horizontal)";
    if (!fov) {
        const auto aperture = number(part, "cameraAperture"), focal = number(part, "cameraFocalLength");
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
        Projection::from_horizontal_fov(*fov * std::numbers::pi / 180, part.display_window, part.pixel_aspect);
    camera.projection_source = source;
}

/// A number in the wrong unit or convention, or what is left of a damaged matrix, gives a picture that is silently absurd.
void refuse_implausible(Camera &camera)
{
    if (!camera.projection)
        return;
    const double degrees = camera.projection->vertical_fov() * 180 / std::numbers::pi;
    if (degrees >= 1 && degrees <= 170)
        return;
    camera.notes.push_back(
        fmt::format("{} is ignored: a vertical field of view of {:.4g} degrees (expected 1 to 170; --camera "
                    "FILE.exr takes it as it is)",
                    camera.projection_source, degrees));
    camera.projection.reset();
}

}  // namespace

Camera camera_from_metadata(const PartInfo &part, Implausible implausible)
{
    Camera camera;
    const auto check = [&] {
        if (implausible == Implausible::kRefused)
            refuse_implausible(camera);
    };
    add_standard(part, camera);
    check();
    add_vray(part, camera);
    check();
    return camera;
}

}  // namespace brume::tool
