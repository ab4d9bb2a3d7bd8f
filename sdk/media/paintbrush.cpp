#include <cmath>

#include "media/operations.h"
#include "media/random.h"

namespace brume::media {
namespace {

constexpr double default_spacing = 0.75;  // of a radius (Zhou et al. 2007 sec. 6)

// Two unit vectors that are perpendicular to `along` and to each other.
std::array<dvec3, 2> across(const dvec3 &along)
{
    const dvec3 size = glm::abs(along);
    const dvec3 other = size.x <= size.y && size.x <= size.z ? dvec3(1, 0, 0)
                        : size.y <= size.z                   ? dvec3(0, 1, 0)
                                                             : dvec3(0, 0, 1);
    const dvec3 first = glm::normalize(glm::cross(along, other));
    return {first, glm::cross(along, first)};
}

}  // namespace

void Paint::apply(State &state) const
{
    const double step = spacing > 0 ? spacing : default_spacing / scale;
    double length = 0;
    for (size_t i = 1; i < points.size(); ++i)
        length += glm::distance(points[i - 1], points[i]);
    expect_room(state, std::floor(length / step) + 1, name);

    uint64_t index = 0;
    auto dab = [&](const dvec3 &at, const dvec3 &along) {
        Random random(seed, index++);
        const auto [u, v] = across(along);
        const glm::dvec2 offset = random.in_disc() * (jitter / scale);
        const dvec3 center = at + offset.x * u + offset.y * v;
        add(state, {{center.x, center.y, center.z}, scale, amplitude, {float(color.x), float(color.y), float(color.z)}},
            name);
    };

    double next = 0;  // along the stroke, from the point at hand
    for (size_t i = 1; i < points.size(); ++i) {
        const dvec3 way = points[i] - points[i - 1];
        const double size = glm::length(way);
        for (; size > 0 && next <= size; next += step)
            dab(points[i - 1] + way * (next / size), way / size);
        next -= size;
    }
    if (index == 0) {
        const double size = glm::length(normal);
        dab(points[0], size > 0 ? normal / size : dvec3(0, 0, 1));
    }
}

}  // namespace brume::media
