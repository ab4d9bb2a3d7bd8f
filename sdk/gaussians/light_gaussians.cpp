#include "gaussians/light_gaussians.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "base/error.h"
#include "scene_maths.hpp"

namespace brume {
namespace {

using namespace maths_double;

constexpr size_t most_texels = size_t(1) << 24;  // indices travel as floats
constexpr size_t most_entries = most_texels;
constexpr int most_levels = 6;

// The cone around a cell's directions. Octahedral cells are polygons of great circles, so a corner lies farthest out.
struct Cone {
    vec3 axis;
    double cosine, sine;
};

std::vector<Cone> cones_of(int grid)
{
    std::vector<Cone> cones(size_t(grid) * size_t(grid));
    for (int y = 0; y < grid; ++y)
        for (int x = 0; x < grid; ++x) {
            Cone &cone = cones[size_t(y * grid + x)];
            cone.axis = octahedral_direction((vec2(x, y) + 0.5) / double(grid));
            cone.cosine = 1;
            for (int corner = 0; corner < 4; ++corner)
                cone.cosine =
                    std::min(cone.cosine,
                             dot(cone.axis, octahedral_direction(vec2(x + (corner & 1), y + (corner >> 1)) / double(grid))));
            cone.cosine -= 1e-6;  // the shader's rounding may put a direction into the cell beside
            cone.sine = std::sqrt(std::max(0.0, 1 - cone.cosine * cone.cosine));
        }
    return cones;
}

const std::vector<Cone> &cones_at(int level)
{
    static const std::vector<std::vector<Cone>> levels = [] {
        std::vector<std::vector<Cone>> all;
        for (int i = 0; i <= most_levels; ++i)
            all.push_back(cones_of(1 << i));
        return all;
    }();
    return levels[size_t(level)];
}

vec3 three(const std::array<double, 3> &v)
{
    return {v[0], v[1], v[2]};
}

std::array<double, 3> in_world_axes(const brume_plugin_camera &camera, const float (&v)[3])
{
    std::array<double, 3> w;
    for (size_t i = 0; i < 3; ++i)
        w[i] = double(v[0]) * camera.right[i] + double(v[1]) * camera.up[i] + double(v[2]) * camera.back[i];
    return w;
}

vec3 in_camera_axes(const brume_plugin_camera &camera, vec3 w)
{
    auto along = [&](const float(&axis)[3]) { return w.x * axis[0] + w.y * axis[1] + w.z * axis[2]; };
    return {along(camera.right), along(camera.up), along(camera.back)};
}

}  // namespace

void LightGaussians::refresh(const brume_plugin_scene &scene, bool moved, bool with_camera)
{
    if (!moved && build(scene, false, with_camera))
        return;
    // About four cells per Gaussian, fewer where there are many lights. Where Gaussians cover so much that their lists do
    // not fit, fewer cells are as good.
    const double most_cells = double(most_entries) / 16 / (1.0 + scene.light_count);
    const double cells_wanted = std::min(4.0 * scene.gaussian_count, most_cells);
    grid_ = std::clamp(int(std::bit_floor(uint32_t(std::sqrt(cells_wanted)))), 1, 1 << most_levels);
    for (; grid_ > 0; grid_ /= 2)
        if (build(scene, true, with_camera))
            return;
    throw Error(BRUME_ERROR_UNSUPPORTED,
                fmt::format("medium.density: {} Gaussians shadow too much of each other; expected fewer or smaller ones",
                            scene.gaussian_count));
}

bool LightGaussians::build(const brume_plugin_scene &scene, bool moved, bool with_camera)
{
    const Medium medium = medium_of(scene);
    const uint32_t per_origin = uint32_t(grid_) * uint32_t(grid_);
    spheres_.resize(scene.gaussian_count);
    for (uint32_t i = 0; i < scene.gaussian_count; ++i) {
        const brume_plugin_gaussian &g = scene.gaussians[i];
        spheres_[i] = {in_world_axes(*scene.camera, g.center), gaussian_reach(medium, gaussian_of(g))};
    }

    const uint32_t count = 1 + scene.light_count;
    first_cell_ = 3 * size_t(count);
    first_gaussian_ = (first_cell_ + size_t(count) * per_origin + 1) / 2;
    texels.resize(moved ? 8 * (first_gaussian_ + scene.gaussian_count) : lights_end_);
    for (uint32_t origin = 0; origin < count; ++origin) {
        float *texel = &texels[12 * size_t(origin)];
        std::fill_n(texel, 12, 0.0f);
        texel[8] = float(first_cell_ + size_t(origin) * per_origin);
        texel[9] = float(grid_);
        texel[10] = float(first_gaussian_);
    }
    static_assert(sizeof(brume_plugin_gaussian) == 8 * sizeof(float));
    if (scene.gaussian_count > 0)
        std::memcpy(&texels[8 * first_gaussian_], scene.gaussians, scene.gaussian_count * sizeof(brume_plugin_gaussian));
    entries_.clear();
    for (uint32_t l = 0; l < scene.light_count; ++l) {
        const brume_plugin_light &light = scene.lights[l];
        const uint32_t first = (1 + l) * per_origin;
        if (light.type == BRUME_LIGHT_DIRECTIONAL)
            add_across(scene, l, first, &texels[12 * (1 + size_t(l))], moved);
        else if (moved)
            add_around(in_world_axes(*scene.camera, light.position), first);
        if (entries_.size() > most_entries)
            return false;
    }
    if (moved) {
        if (!sort_entries(per_origin, scene.light_count * per_origin))
            return false;
        lights_end_ = texels.size();
    }
    entries_.clear();
    if (with_camera)
        add_around({0, 0, 0}, 0);
    return sort_entries(0, per_origin);
}

void LightGaussians::add_around(const std::array<double, 3> &origin, uint32_t first_cell)
{
    const int levels = std::countr_zero(uint32_t(grid_));
    for (uint32_t i = 0; i < spheres_.size(); ++i) {
        const vec3 away = three(spheres_[i].center) - three(origin);
        const double distance = length(away), reach = spheres_[i].reach;
        const bool around = distance <= reach;
        const double sine = around ? 1 : reach / distance, cosine = std::sqrt(1 - sine * sine);
        auto descend = [&](auto &self, int level, int x, int y) -> void {
            const Cone &cone = cones_at(level)[size_t((y << level) + x)];
            // The cosine of the sum of both half angles; a sum beyond half a turn always overlaps.
            if (!around && level > 0 && dot(cone.axis, away) < distance * (cosine * cone.cosine - sine * cone.sine))
                return;
            if (level == levels) {
                entries_.push_back({first_cell + uint32_t(y * grid_ + x), i});
                return;
            }
            for (int child = 0; child < 4; ++child)
                self(self, level + 1, 2 * x + (child & 1), 2 * y + (child >> 1));
        };
        descend(descend, 0, 0, 0);
        if (entries_.size() > most_entries)
            return;
    }
}

// The grid lies across the light, around all Gaussians; its axes are fixed in the world, so that it outlives a move of the
// camera as the others do.
void LightGaussians::add_across(const brume_plugin_scene &scene, uint32_t l, uint32_t first_cell, float *texels, bool moved)
{
    const vec3 direction = three(in_world_axes(*scene.camera, scene.lights[l].direction));
    const vec3 helper = std::abs(direction.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 u = glm::normalize(cross(direction, helper)), v = cross(direction, u);
    vec2 low(1e30), high(-1e30);
    for (const Sphere &s : spheres_) {
        const vec2 at(dot(u, three(s.center)), dot(v, three(s.center)));
        low = min(low, at - s.reach);
        high = max(high, at + s.reach);
    }
    if (spheres_.empty())
        low = high = vec2(0);
    const vec2 size = max(high - low, vec2(1e-20));
    const vec3 axes[2] = {in_camera_axes(*scene.camera, u / size.x), in_camera_axes(*scene.camera, v / size.y)};
    for (int axis = 0; axis < 2; ++axis) {
        for (int i = 0; i < 3; ++i)
            texels[4 * axis + i] = float(axes[axis][i]);
        texels[4 * axis + 3] = float(-low[axis] / size[axis]);
    }
    if (!moved)
        return;
    for (uint32_t i = 0; i < spheres_.size(); ++i) {
        const vec2 at = (vec2(dot(u, three(spheres_[i].center)), dot(v, three(spheres_[i].center))) - low) / size;
        const vec2 reach = spheres_[i].reach / size + 1e-5;
        auto cell = [&](double x) { return std::clamp(int(std::floor(x * grid_)), 0, grid_ - 1); };
        for (int y = cell(at.y - reach.y); y <= cell(at.y + reach.y); ++y)
            for (int x = cell(at.x - reach.x); x <= cell(at.x + reach.x); ++x)
                entries_.push_back({first_cell + uint32_t(y * grid_ + x), i});
        if (entries_.size() > most_entries)
            return;
    }
}

// Appends the entries, cell by cell, and writes where each cell's are.
bool LightGaussians::sort_entries(uint32_t first_cell, uint32_t cell_count)
{
    std::vector<uint32_t> &counts = counts_;
    counts.assign(cell_count, 0);
    for (const Entry &entry : entries_)
        ++counts[entry.cell - first_cell];
    size_t end = texels.size() / 4;
    for (uint32_t i = 0; i < cell_count; ++i) {
        float *cell = &texels[4 * (first_cell_ + first_cell + i)];
        cell[0] = float(end);
        cell[1] = float(counts[i]);
        cell[2] = cell[3] = 0;
        end += (counts[i] + 3) / 4;
        counts[i] = 0;
    }
    if (end > most_texels)
        return false;
    texels.resize(4 * end);
    for (const Entry &entry : entries_) {
        const size_t first = size_t(texels[4 * (first_cell_ + entry.cell)]);
        texels[4 * first + counts[entry.cell - first_cell]++] = float(first_gaussian_ + entry.gaussian);
    }
    return true;
}

}  // namespace brume
