#pragma once
// Media, lights and the images that shaders/lib reads them from, in both precisions, for tests of the airlight's maths.
#include <cmath>
#include <vector>

#include "maths.hpp"
#include "reference_ray.h"

// The data images of one scene with a single cell for each origin's directions, so that every list holds all Gaussians.
template <class Real, class Texture> class DataImages {
public:
    template <class Gaussians, class Lights> DataImages(const Gaussians &gaussians, const Lights &lights)
    {
        const int n = int(gaussians.size());
        for (const auto &g : gaussians)
            append(gaussians_, {g.center.x, g.center.y, g.center.z, g.scale, g.amplitude, g.colour.x, g.colour.y, g.colour.z});
        for (const auto &l : lights)
            append(lights_, {l.position.x, l.position.y, l.position.z, l.radius, l.direction.x, l.direction.y, l.direction.z,
                             l.cos_outer, l.intensity.x, l.intensity.y, l.intensity.z, l.cos_inner, double(l.type), l.distance,
                             0.0, 0.0});
        for (int i = 0; i < n; ++i)
            append(indices_, {double(i)});
        append(cells_, {0.0, double(n), 0.0, 0.0});
        for (size_t origin = 0; origin <= lights.size(); ++origin)
            append(origins_, {0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 1.0, 0.0, 0.0});
    }

    Texture gaussians() const { return texture(gaussians_, 4); }
    Texture lights() const { return texture(lights_, 4); }
    Texture indices() const { return texture(indices_, 1); }
    Texture cells() const { return texture(cells_, 4); }
    Texture origins() const { return texture(origins_, 4); }

    static Texture texture(const std::vector<Real> &values, int channels)
    {
        return {values.data(), 1024 * channels, 1024, int(values.size() / size_t(channels) + 1023) / 1024, channels};
    }

private:
    static void append(std::vector<Real> &to, std::initializer_list<double> values)
    {
        for (double v : values)
            to.push_back(Real(v));
    }

    std::vector<Real> gaussians_, lights_, indices_, cells_, origins_;
};
