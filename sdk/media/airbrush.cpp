#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "media/operations.h"
#include "media/random.h"

namespace brume::media {
namespace {

constexpr double time_step = 1.0 / 60;  // [s]
constexpr double most_steps = 2e7;      // of all particles together
constexpr int most_samples = 64;        // of the way of one step, a pixel each where that is enough

// The depth a frame shows, as a solid that begins there and has no end.
class Surface {
public:
    Surface(const Lens &lens, const DepthMap &map) : lens_(lens), map_(map) {}

    // Whether the point lies in it.
    bool contains(const dvec3 &point) const
    {
        const auto place = lens_.project(point);
        int x, y;
        return place && pixel_of(place->pixel, x, y) && place->depth > double(depth(x, y));
    }

    // Where the way from `from`, which is outside, to `to` is still outside: at `to`, or just before the surface. Then the
    // normal is that of the surface hit.
    dvec3 advance(const dvec3 &from, const dvec3 &to, std::optional<dvec3> &normal) const
    {
        const auto begin = lens_.project(from), end = lens_.project(to);
        double pixels = most_samples;
        if (begin && end)
            pixels = glm::distance(begin->pixel, end->pixel);
        // The comparison is false for NaN, too.
        const int samples = pixels < most_samples ? int(pixels) + 1 : most_samples;
        dvec3 free = from;
        for (int i = 1; i <= samples; ++i) {
            const dvec3 at = i == samples ? to : from + (to - from) * (double(i) / samples);
            if (contains(at)) {
                normal = normal_at(at);
                return free;
            }
            free = at;
        }
        return free;
    }

private:
    bool pixel_of(const glm::dvec2 &p, int &x, int &y) const
    {
        if (!(p.x >= 0 && p.y >= 0 && p.x < map_.width && p.y < map_.height))
            return false;
        x = int(p.x);
        y = int(p.y);
        return true;
    }

    float depth(int x, int y) const { return map_.depth[size_t(y) * map_.width + size_t(x)]; }

    dvec3 point(int x, int y) const { return lens_.eye + double(depth(x, y)) * lens_.direction({x + 0.5, y + 0.5}); }

    // Towards the neighbour that is nearer in depth: the other may lie on another surface.
    dvec3 slope(int x, int y, int dx, int dy) const
    {
        dvec3 best(0.0);
        double least = INFINITY;
        for (int side : {-1, 1}) {
            const int nx = x + side * dx, ny = y + side * dy;
            if (nx < 0 || ny < 0 || nx >= int(map_.width) || ny >= int(map_.height))
                continue;
            const double difference = std::abs(double(depth(nx, ny)) - double(depth(x, y)));
            if (difference < least) {
                least = difference;
                best = double(side) * (point(nx, ny) - point(x, y));
            }
        }
        return best;
    }

    // Towards the camera; of the pixel that the point, which lies in the solid, is seen at.
    dvec3 normal_at(const dvec3 &in_solid) const
    {
        int x = 0, y = 0;
        pixel_of(lens_.project(in_solid)->pixel, x, y);
        const dvec3 cross = glm::cross(slope(x, y, 1, 0), slope(x, y, 0, 1));
        const dvec3 to_eye = -lens_.direction({x + 0.5, y + 0.5});
        const double size = glm::length(cross);
        if (!(size > 0))
            return glm::normalize(to_eye);
        return glm::dot(cross, to_eye) < 0 ? -cross / size : cross / size;
    }

    const Lens &lens_;
    const DepthMap &map_;
};

}  // namespace

void Airbrush::apply(State &state) const
{
    const double born = std::floor(duration * rate);
    expect_room(state, born, name);
    const double steps = born * (duration / time_step) / 2;
    if (steps > most_steps)
        throw Error(BRUME_ERROR_ARGUMENT, fmt::format("{}: {} particles for {} s are {:.3g} steps; expected {:.3g} at most",
                                                      name, born, duration, steps, most_steps));
    std::optional<Surface> surface;
    if (depth)
        surface.emplace(lens, *depth);
    if (surface && surface->contains(position))
        throw Error(BRUME_ERROR_ARGUMENT,
                    fmt::format("{}.position: {}, {}, {}; expected a place before what the view's depth shows", name,
                                position.x, position.y, position.z));

    // The variance of a uniform ball is 1/5 along each axis.
    const double wander = std::sqrt(2 * diffusion * time_step * 5);
    for (uint64_t i = 0; i < uint64_t(born); ++i) {
        Random random(seed, i);
        const double birth = (double(i) + random.next()) / rate;
        // Whole steps only, or a longer duration would not carry the same particles on.
        const double age = std::floor((duration - birth) / time_step);
        dvec3 at = position, speed = velocity + spread * random.in_ball();
        for (double step = 0; step < age; ++step) {
            const dvec3 to = at + time_step * speed + wander * random.in_ball();
            std::optional<dvec3> normal;
            at = surface ? surface->advance(at, to, normal) : to;
            if (normal) {
                const double into = glm::dot(speed, *normal);
                // Around an outline the way leads behind things, not into their front.
                speed = into < 0 ? speed - 2 * into * *normal : -speed;
            }
            speed *= 1 - drag * time_step;
        }
        add(state, {{at.x, at.y, at.z}, scale, amplitude, {float(color.x), float(color.y), float(color.z)}}, name);
    }
}

}  // namespace brume::media
