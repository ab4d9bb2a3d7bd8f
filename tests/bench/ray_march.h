#pragma once
// What the airlight is held against: a ray march as one writes it, uniform steps along the ray and from each to the light.
#include <cmath>
#include <vector>

#include "maths.hpp"

namespace bench {

using namespace brume::maths_float;

// Gaussians of isotropic scattering 1/m at unit density, in a grid whose cells list those that reach them.
class March {
public:
    March(std::vector<Gaussian> gaussians, float mean_radius) : gaussians_(std::move(gaussians)), side_(2 * mean_radius)
    {
        low_ = vec3(1e30f);
        vec3 high(-1e30f);
        for (const Gaussian &g : gaussians_) {
            low_ = min(low_, g.center - reach / g.scale);
            high = max(high, g.center + reach / g.scale);
        }
        high_ = high;
        for (int i = 0; i < 3; ++i)
            size_[i] = std::max(1, int(std::ceil((high[i] - low_[i]) / side_)));
        std::vector<int> counts(size_t(size_.x) * size_t(size_.y) * size_t(size_.z) + 1, 0);
        for (int round = 0; round < 2; ++round) {
            for (size_t n = 0; n < gaussians_.size(); ++n) {
                const Gaussian &g = gaussians_[n];
                const ivec3 from = cell(g.center - reach / g.scale), to = cell(g.center + reach / g.scale);
                for (int z = from.z; z <= to.z; ++z)
                    for (int y = from.y; y <= to.y; ++y)
                        for (int x = from.x; x <= to.x; ++x) {
                            const size_t c = (size_t(z) * size_t(size_.y) + size_t(y)) * size_t(size_.x) + size_t(x);
                            if (round == 0)
                                ++counts[c + 1];
                            else
                                entries_[size_t(starts_[c] + counts[c]++)] = gaussians_[n];
                        }
            }
            if (round == 0) {
                for (size_t c = 1; c < counts.size(); ++c)
                    counts[c] += counts[c - 1];
                starts_ = counts;
                entries_.resize(size_t(counts.back()));
                counts.assign(counts.size(), 0);
            }
        }
    }

    // `steps` are those along the ray; to the lights they have the same length.
    float airlight(vec3 direction, float distance, const std::vector<Light> &lights, int steps) const
    {
        const vec2 range = inside(vec3(0), direction, distance);
        const float dt = (range.y - range.x) / float(steps);
        float passed = 0, sum = 0;
        for (int i = 0; i < steps && dt > 0; ++i) {
            const vec3 x = (range.x + (float(i) + 0.5f) * dt) * direction;
            const float rho = density(x);
            passed += 0.5f * dt * rho;
            for (const Light &light : lights) {
                const vec3 way = light.position - x;
                const float d = length(way);
                const float shadow = depth(x, way / d, d, dt);
                sum += dt * rho * light.intensity.x / (d * d) * std::exp(-passed - shadow);
            }
            passed += 0.5f * dt * rho;
        }
        return sum / (4 * 3.14159265f);
    }

private:
    static constexpr float reach = 3.7f;  // radii: no more than 2e-5 of a Gaussian's mass is beyond

    ivec3 cell(vec3 x) const
    {
        const vec3 c = floor((x - low_) / side_);
        return clamp(ivec3(int(c.x), int(c.y), int(c.z)), ivec3(0), size_ - 1);
    }
    vec2 inside(vec3 origin, vec3 direction, float distance) const
    {
        const vec3 a = (low_ - origin) / direction, b = (high_ - origin) / direction;
        const vec3 from = min(a, b), to = max(a, b);
        return {std::max({from.x, from.y, from.z, 0.0f}), std::min({to.x, to.y, to.z, distance})};
    }
    float density(vec3 x) const
    {
        const ivec3 at = cell(x);
        const size_t c = (size_t(at.z) * size_t(size_.y) + size_t(at.y)) * size_t(size_.x) + size_t(at.x);
        float sum = 0;
        for (int i = starts_[c]; i < starts_[c + 1]; ++i) {
            const Gaussian &g = entries_[size_t(i)];
            const vec3 b = x - g.center;
            const float y = g.scale * g.scale * dot(b, b);
            if (y < reach * reach)
                sum += g.amplitude * std::exp(-y);
        }
        return sum;
    }
    float depth(vec3 x, vec3 way, float distance, float step) const
    {
        const vec2 range = inside(x, way, distance);
        if (range.y <= range.x)
            return 0;
        const int steps = std::max(1, int(std::lround((range.y - range.x) / step)));
        const float dt = (range.y - range.x) / float(steps);
        float sum = 0;
        for (int i = 0; i < steps; ++i)
            sum += density(x + (range.x + (float(i) + 0.5f) * dt) * way);
        return sum * dt;
    }

    std::vector<Gaussian> gaussians_;
    std::vector<Gaussian> entries_;
    std::vector<int> starts_;
    vec3 low_, high_;
    float side_;
    ivec3 size_;
};

}  // namespace bench
