#include "gaussians/gaussian_tiles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/error.h"
#include "scene_maths.hpp"

namespace brume {
namespace {

constexpr uint64_t most_entries = 1u << 24;  // indices travel as floats

struct Span {
    int32_t first = 0;
    int32_t end = 0;
};

// Tiles that a sphere's shadow covers along one axis of the image. across: the centre's coordinate along that axis, away:
// its distance along the optical axis. Seen from above, the tangents to the circle bound what it covers.
Span covered(double across, double away, double reach, double tangent_scale, double center, int32_t tiles, double pixels)
{
    const double half_turn = std::numbers::pi / 2;
    double distance = std::hypot(across, away);
    if (distance <= reach)
        return {0, tiles};
    double angle = std::atan2(across, away), spread = std::asin(reach / distance);
    if (angle - spread >= half_turn || angle + spread <= -half_turn)
        return {0, 0};
    auto pixel = [&](double a) {
        if (a <= -half_turn + 1e-9 || a >= half_turn - 1e-9)
            return (a < 0) == (tangent_scale > 0) ? -1.0 : pixels + 1;
        return std::clamp(center + std::tan(a) / tangent_scale, -1.0, pixels + 1);
    };
    double one = pixel(angle - spread), other = pixel(angle + spread);
    if (one > other)
        std::swap(one, other);
    if (other < 0 || one > pixels)
        return {0, 0};
    return {std::clamp(int32_t(std::floor(one / BRUME_TILE_SIZE)), 0, tiles - 1),
            std::clamp(int32_t(std::floor(other / BRUME_TILE_SIZE)), 0, tiles - 1) + 1};
}

// The cone around a tile's rays.
struct Cone {
    double axis[3];
    double cosine, sine;
};

std::vector<Cone> tile_cones(const brume_plugin_camera &camera, int32_t columns, int32_t rows)
{
    std::vector<Cone> cones(size_t(columns) * size_t(rows));
    auto ray = [&](double x, double y, double *out) {
        out[0] = (x - camera.center[0]) * camera.tangent_scale[0];
        out[1] = (y - camera.center[1]) * camera.tangent_scale[1];
        out[2] = -1;
        double length = std::sqrt(out[0] * out[0] + out[1] * out[1] + 1);
        for (int i = 0; i < 3; ++i)
            out[i] /= length;
    };
    for (int32_t row = 0; row < rows; ++row)
        for (int32_t column = 0; column < columns; ++column) {
            Cone &cone = cones[size_t(row) * size_t(columns) + size_t(column)];
            double x = column * BRUME_TILE_SIZE, y = row * BRUME_TILE_SIZE, side = BRUME_TILE_SIZE;
            ray(x + side / 2, y + side / 2, cone.axis);
            double least = 1;
            for (int corner = 0; corner < 4; ++corner) {
                double d[3];
                ray(x + (corner & 1 ? side : 0), y + (corner & 2 ? side : 0), d);
                least = std::min(least, d[0] * cone.axis[0] + d[1] * cone.axis[1] + d[2] * cone.axis[2]);
            }
            cone.cosine = least;
            cone.sine = std::sqrt(std::max(0.0, 1 - least * least));
        }
    return cones;
}

}  // namespace

TileEstimate estimate_tiles(const brume_plugin_scene &scene, int32_t width, int32_t height)
{
    const brume_plugin_camera &camera = *scene.camera;
    const maths_double::Medium medium = maths_double::medium_of(scene);
    const int32_t columns = (width + BRUME_TILE_SIZE - 1) / BRUME_TILE_SIZE,
                  rows = (height + BRUME_TILE_SIZE - 1) / BRUME_TILE_SIZE;
    TileEstimate estimate;
    for (uint32_t i = 0; i < scene.gaussian_count; ++i) {
        const brume_plugin_gaussian &g = scene.gaussians[i];
        const double reach = gaussian_reach(medium, maths_double::gaussian_of(g));
        const Span x = covered(g.center[0], -g.center[2], reach, camera.tangent_scale[0], camera.center[0], columns, width);
        const Span y = covered(g.center[1], -g.center[2], reach, camera.tangent_scale[1], camera.center[1], rows, height);
        const double tiles = double(x.end - x.first) * (y.end - y.first);
        estimate.seen += tiles > 0;
        estimate.length += tiles / (double(columns) * rows);
    }
    return estimate;
}

void build_tiles(const brume_plugin_scene &scene, int32_t width, int32_t height, GaussianTiles &out)
{
    const brume_plugin_camera &camera = *scene.camera;
    const maths_double::Medium medium = maths_double::medium_of(scene);
    out.columns = (width + BRUME_TILE_SIZE - 1) / BRUME_TILE_SIZE;
    out.rows = (height + BRUME_TILE_SIZE - 1) / BRUME_TILE_SIZE;
    out.seen = 0;
    const std::vector<Cone> cones = tile_cones(camera, out.columns, out.rows);

    struct Candidate {
        double distance;
        uint32_t index;
    };
    std::vector<Candidate> order(scene.gaussian_count);
    for (uint32_t i = 0; i < scene.gaussian_count; ++i) {
        const float *c = scene.gaussians[i].center;
        order[i] = {std::hypot(double(c[0]), double(c[1]), double(c[2])), i};
    }
    std::sort(order.begin(), order.end(), [](const Candidate &a, const Candidate &b) {
        return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
    });

    struct Entry {
        uint32_t tile;
        uint32_t gaussian;
    };
    std::vector<Entry> entries;
    std::vector<uint32_t> counts(cones.size() + 1, 0);
    for (const Candidate &candidate : order) {
        const brume_plugin_gaussian &g = scene.gaussians[candidate.index];
        double reach = gaussian_reach(medium, maths_double::gaussian_of(g)), distance = candidate.distance;
        Span x = covered(g.center[0], -g.center[2], reach, camera.tangent_scale[0], camera.center[0], out.columns, width);
        Span y = covered(g.center[1], -g.center[2], reach, camera.tangent_scale[1], camera.center[1], out.rows, height);
        bool around = distance <= reach;  // the camera is inside
        double sine = around ? 1 : reach / distance, cosine = std::sqrt(1 - sine * sine);
        size_t before = entries.size();
        for (int32_t row = y.first; row < y.end; ++row)
            for (int32_t column = x.first; column < x.end; ++column) {
                uint32_t tile = uint32_t(row) * uint32_t(out.columns) + uint32_t(column);
                const Cone &cone = cones[tile];
                double toward = cone.axis[0] * g.center[0] + cone.axis[1] * g.center[1] + cone.axis[2] * g.center[2];
                double limit = cosine * cone.cosine - sine * cone.sine;  // of the sum of both angles
                // Tiles of wide views may see more than half of all directions: the sum could pass half a turn.
                if (!around && cone.cosine > 0 && toward < limit * distance)
                    continue;
                entries.push_back({tile, candidate.index});
                ++counts[tile + 1];
            }
        out.seen += entries.size() > before;
        if (entries.size() > most_entries)
            throw Error(BRUME_ERROR_UNSUPPORTED,
                        fmt::format("medium.density: {} Gaussians cover more than {} tiles of the image together; expected "
                                    "fewer or smaller ones",
                                    scene.gaussian_count, most_entries));
    }

    for (size_t tile = 0; tile < cones.size(); ++tile)
        counts[tile + 1] += counts[tile];
    out.ranges.assign(cones.size() * 4, 0.0f);
    for (size_t tile = 0; tile < cones.size(); ++tile) {
        out.ranges[4 * tile] = float(counts[tile]);
        out.ranges[4 * tile + 1] = float(counts[tile + 1] - counts[tile]);
    }
    out.indices.resize(entries.size());
    for (const Entry &entry : entries)
        out.indices[counts[entry.tile]++] = float(entry.gaussian);
}

}  // namespace brume
