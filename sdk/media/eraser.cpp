#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "media/operations.h"

namespace brume::media {
namespace {

constexpr double most_distances = 1e9;

double squared_distance(const dvec3 &p, const dvec3 &a, const dvec3 &b)
{
    const dvec3 way = b - a;
    const double size = glm::dot(way, way);
    const double t = size > 0 ? std::clamp(glm::dot(p - a, way) / size, 0.0, 1.0) : 0.0;
    const dvec3 away = p - (a + t * way);
    return glm::dot(away, away);
}

}  // namespace

void Erase::apply(State &state) const
{
    if (double(points.size()) * double(state.gaussians.size()) > most_distances)
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}.points: {} of them over {} Gaussians; expected a product of {:.0e} at most", name,
                                points.size(), state.gaussians.size(), most_distances));
    size_t kept = 0;
    for (size_t i = 0; i < state.gaussians.size(); ++i) {
        Gaussian gaussian = state.gaussians[i];
        const dvec3 p(gaussian.center[0], gaussian.center[1], gaussian.center[2]);
        double nearest = squared_distance(p, points.front(), points.front());
        for (size_t j = 1; j < points.size(); ++j)
            nearest = std::min(nearest, squared_distance(p, points[j - 1], points[j]));
        const double rest = 1 - nearest / (radius * radius);
        if (rest > 0) {
            gaussian.amplitude -= strength * rest * rest;
            if (!(gaussian.amplitude > 0))
                continue;
        }
        state.gaussians[kept] = gaussian;
        state.selected[kept++] = state.selected[i];
    }
    state.gaussians.resize(kept);
    state.selected.resize(kept);
}

}  // namespace brume::media
