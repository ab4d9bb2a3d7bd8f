#pragma once
// One ray of a case through the tiers, as the CPU backend runs them, and through the reference.
#include <array>
#include <numbers>
#include <vector>

#include "airlight_cases.h"
#include "maths.hpp"
#include "quality.h"
#include "reference_ray.h"
#include "scene_maths.hpp"
#include "tables.h"

namespace airlight_cases {

namespace narrow = brume::maths_float;

inline narrow::Medium narrowed(const Medium &m)
{
    narrow::Medium n{};
    n.scattering = m.scattering;
    n.absorption = m.absorption;
    n.luminance = m.luminance;
    n.phase = m.phase;
    n.asymmetry = float(m.asymmetry);
    n.constant = float(m.constant);
    n.term_count = m.term_count;
    for (int i = 0; i < m.term_count; ++i)
        n.terms[i] = m.terms[i];
    return n;
}

// A case's data images with a single cell for each origin's directions: every list holds all Gaussians.
class World {
public:
    explicit World(const Case &c, double max_error = 0.01) : case_(c), medium_(narrowed(c.medium))
    {
        const int n = int(c.gaussians.size());
        for (const Gaussian &g : c.gaussians)
            append(gaussians_, {g.center.x, g.center.y, g.center.z, g.scale, g.amplitude, g.color.x, g.color.y, g.color.z});
        for (const Light &l : c.lights)
            append(lights_, {l.position.x, l.position.y, l.position.z, l.radius, l.direction.x, l.direction.y, l.direction.z,
                             l.cos_outer, l.intensity.x, l.intensity.y, l.intensity.z, l.cos_inner, double(l.type),
                             l.distance, 0, 0});
        for (int i = 0; i < n; ++i)
            append(seen_, {double(i)});
        // One cell around all origins, which lists all.
        const size_t cell = 3 * (1 + c.lights.size()), first = (cell + 2) / 2;
        for (size_t origin = 0; origin <= c.lights.size(); ++origin)
            append(light_gaussians_, {0, 0, 0, 0.5, 0, 0, 0, 0.5, double(cell), 1, double(first), 0});
        append(light_gaussians_, {2.0 * double(first + size_t(n)), double(n), 0, 0});
        light_gaussians_.resize(8 * first);
        light_gaussians_.insert(light_gaussians_.end(), gaussians_.begin(), gaussians_.end());
        for (int i = 0; i < n; ++i)
            append(light_gaussians_, {double(first + size_t(i))});
        light_gaussians_.resize((light_gaussians_.size() + 3) / 4 * 4);
        camera_.right = {1, 0, 0};
        camera_.up = {0, 1, 0};
        camera_.back = {0, 0, 1};
        camera_.metres_per_unit = 1;
        camera_.tangent_scale = {1, -1};
        surroundings_.resize(4 * brume::maths_float::sides * c.lights.size());
        settings.light_count = int(c.lights.size());
        settings.gaussian_count = n;
        brume::airlight::set_quality(settings, max_error);
    }

    // The ray's list holds these only; shadows are still of all.
    void see_only(const std::vector<int> &gaussians) { seen_.assign(gaussians.begin(), gaussians.end()); }

    // Lights in the order that a tile of these rays has.
    void order_for(const narrow::TileRays &rays)
    {
        std::vector<float> bounds;
        for (int l = 0; l < settings.light_count; ++l)
            bounds.push_back(bound_of(rays, l));
        const narrow::Texture all = image(bounds, 1);
        lamp_order_.resize(2 * bounds.size());
        for (int l = 0; l < settings.light_count; ++l) {
            const narrow::vec2 place = narrow::lamp_place(all, 0, settings.light_count, l);
            lamp_order_[2 * size_t(place.x)] = float(l);
            lamp_order_[2 * size_t(place.x) + 1] = place.y;
        }
    }

    // Light number i of the order and those behind it, at most.
    double rest(int i) const { return lamp_order_[2 * size_t(i) + 1]; }

    float bound_of(const narrow::TileRays &rays, int light) const
    {
        const narrow::Light l = narrow::light_at(image(lights_, 4), light);
        const narrow::LampSight lamp = narrow::lamp_sight(medium_, rays, l);
        const float reach = std::min(narrow::tile_reach(medium_, rays), rays.distance);
        float sum = 0;
        for (int i = 0; i < narrow::tile_pieces; ++i)
            sum += narrow::most_of_piece(
                medium_, l, lamp,
                narrow::ray_piece(medium_, rays, narrow::piece_end(rays, reach, i), narrow::piece_end(rays, reach, i + 1)));
        return narrow::lamp_bound(medium_, l, sum);
    }

    // A map of this light (one at most), and where it looks: as brume_plugin_light from shadow_rows on.
    void add_shadow(int light, const std::array<float, 16> &projection, narrow::Texture map)
    {
        light_shadows_.resize(20 * case_.lights.size());
        float *texels = &light_shadows_[size_t(20 * light)];
        std::copy(projection.begin(), projection.end(), texels);
        texels[14] = projection[14] == float(BRUME_DEPTH_RAY);
        texels[18] = float(map.width);
        texels[19] = float(map.height);
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x)
                shadow_map_.push_back(
                    narrow::shadow_distance({BRUME_DEPTH_PLANAR, 1, {0, 0}}, *narrow::texel_at(map, x, y)));
        shadow_width_ = map.width;
        settings.shadowed = 1;
    }

    // A plane at this height below the camera, or (`high`) above it, across this axis.
    void add_plane(int axis, bool high, double away)
    {
        for (size_t l = 0; l < case_.lights.size(); ++l) {
            const double lamp = case_.lights[l].position[axis];
            float *texel = surroundings_.data() + 4 * (brume::maths_float::sides * l + size_t(2 * axis + high));
            texel[0] = float(std::max(away + (high ? -lamp : lamp), 0.0));
            texel[1] = 1;
        }
    }

    narrow::Airlight airlight(int tier)
    {
        const narrow::Texture light_shadows = image(light_shadows_, 4),
                              shadow_maps{shadow_map_.data(), shadow_width_, shadow_width_,
                                          int(shadow_map_.size()) / std::max(shadow_width_, 1), 1};
        const narrow::Texture gaussians = image(gaussians_, 4), light_gaussians = image(light_gaussians_, 4),
                              lights = image(lights_, 4), tile_gaussians = image(seen_, 1);
        if (tier == narrow::airlight_fogshop && blob_density_.empty())
            for (int i = 0; i < settings.gaussian_count * (1 + settings.light_count); ++i)
                blob_density_.push_back(narrow::blob_density_at(medium_, camera_, settings, SHADOW_PASSED, lights, i));
        const std::vector<float> &table = brume::airlight::sun_table();
        const narrow::Texture blob_density = image(blob_density_, 1), sun_table = image(table, 1),
                              surroundings = image(surroundings_, 4);
        const narrow::Sight sight{narrow::vec3(case_.direction), float(case_.distance), 0, int(seen_.size())};
        return narrow::airlight_of_tier(tier, medium_, camera_, settings, AIRLIGHT_PASSED, sight, image(lamp_order_, 2),
                                        lamp_order_.empty() ? -1 : 0, 0, settings.light_count);
    }

    // int rho dt of the Gaussians between a light (-1: the camera) and a point.
    float shadow(int light, vec3 point) const
    {
        const narrow::Texture light_gaussians = image(light_gaussians_, 4), lights = image(lights_, 4);
        if (light < 0)
            return narrow::camera_density(light_gaussians, camera_, narrow::vec3(point));
        return narrow::shadow_density(light_gaussians, camera_, light, narrow::light_at(lights, light), narrow::vec3(point));
    }

    brume::airlight::ReferenceAirlight reference() const
    {
        Camera camera{};
        camera.right = {1, 0, 0};
        camera.up = {0, 1, 0};
        camera.back = {0, 0, 1};
        std::vector<Surroundings> around;
        const Data planes(surroundings_.data(), surroundings_.size() / 4, 4);
        for (size_t l = 0; l < case_.lights.size(); ++l)
            around.push_back(surroundings_of(planes.texture(), int(l)));
        return brume::airlight::reference_airlight(
            {case_.medium, case_.gaussians, case_.lights, camera, settings.orders, around}, case_.direction, case_.distance,
            0, int(case_.lights.size()));
    }

    narrow::AirlightSettings settings{};

private:
    static void append(std::vector<float> &to, std::initializer_list<double> values)
    {
        for (double v : values)
            to.push_back(float(v));
    }
    static narrow::Texture image(const std::vector<float> &values, int channels)
    {
        return {values.data(), 1024 * channels, 1024, int(values.size()) / (1024 * channels) + 1, channels};
    }

    const Case &case_;
    narrow::Medium medium_;
    narrow::Camera camera_{};
    int shadow_width_ = 0;
    std::vector<float> lamp_order_, shadow_map_, light_shadows_, gaussians_, lights_, light_gaussians_, seen_, blob_density_,
        surroundings_;
};

// Errors of one tier over many rays, relative to the exact radiance (mean of the colours). Lights of intensity 1 that send
// less than 1e-12 are left out: nothing arrives. Errors of `rounding` or less are no matter for an estimate.
struct Errors {
    static constexpr double rounding = 2e-6;

    std::vector<double> relative;
    std::vector<double> overestimate;  // estimate / error
    size_t bounded = 0;
    double seconds = 0;

    void add(const narrow::Airlight &found, vec3 exact)
    {
        const double reference = (exact.x + exact.y + exact.z) / 3;
        const double value = (double(found.radiance.x) + found.radiance.y + found.radiance.z) / 3;
        const double estimate = (double(found.error.x) + found.error.y + found.error.z) / 3;
        if (reference < 1e-12)
            return;
        const double error = std::abs(value - reference);
        relative.push_back(error / reference);
        bounded += error <= estimate + rounding * reference;
        if (error > rounding * reference)
            overestimate.push_back(estimate / error);
    }
    void append(const Errors &other)
    {
        relative.insert(relative.end(), other.relative.begin(), other.relative.end());
        overestimate.insert(overestimate.end(), other.overestimate.begin(), other.overestimate.end());
        bounded += other.bounded;
        seconds += other.seconds;
    }
    double mean() const
    {
        double sum = 0;
        for (double e : relative)
            sum += e;
        return sum / double(relative.size());
    }
    double covered() const { return double(bounded) / double(relative.size()); }
};

inline double quantile(std::vector<double> v, double share)
{
    std::sort(v.begin(), v.end());
    return v.empty() ? 0 : v[std::min(v.size() - 1, size_t(share * double(v.size())))];
}

}  // namespace airlight_cases
