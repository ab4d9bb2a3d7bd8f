#pragma once
// Monte Carlo of a point lamp's light in a homogeneous medium: what arrives after one scattering and more.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

namespace lamp_tracer {

using std::numbers::pi;
using vec3 = glm::dvec3;

class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}
    // In (0, 1); splitmix64.
    double operator()()
    {
        uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return (double((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
    }

private:
    uint64_t state_;
};

inline vec3 uniform_direction(Random &random)
{
    const double z = 2 * random() - 1, angle = 2 * pi * random(), s = std::sqrt(1 - z * z);
    return {s * std::cos(angle), s * std::sin(angle), z};
}

// Henyey-Greenstein.
inline double sampled_cosine(double g, Random &random)
{
    const double u = random();
    if (std::abs(g) < 1e-6)
        return 2 * u - 1;
    const double q = (1 - g * g) / (1 - g + 2 * g * u);
    return std::clamp((1 + g * g - q * q) / (2 * g), -1.0, 1.0);
}

inline vec3 turned(vec3 d, double cosine, double angle)
{
    const double s = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    const vec3 a = glm::normalize(std::abs(d.z) < 0.7 ? glm::cross(d, vec3(0, 0, 1)) : glm::cross(d, vec3(1, 0, 0)));
    return glm::normalize(cosine * d + s * std::cos(angle) * a + s * std::sin(angle) * glm::cross(d, a));
}

// Edges of the bins of the angle from the way away from the lamp, in degrees.
constexpr std::array<double, 11> angles{0, 8, 16, 26, 38, 52, 68, 86, 108, 135, 180};
constexpr int bins = int(angles.size()) - 1;

struct Shell {
    double radius = 0;         // its mean [1 / s']
    double fluence = 0;        // of what has scattered at least once, for an intensity of 1
    double once = 0;           // of what has scattered exactly once
    double moments[3] = {};    // mean P_1, P_2, P_3 of the cosine between its way and that away from the lamp
    double source[bins] = {};  // density per steradian of the way after one more scattering, integral 1
    double deviation = 0;      // of the fluence, relative
};

struct Endless {
    double g, albedo;
    std::vector<Shell> shells;
};

// All albedos from one set of paths: absorption is a weight e^(-sigma_a length). Radii in units of 1 / s', shells +-5 %.
// Paths end on a sphere around all of it; what comes back from beyond is, as far within, an even and isotropic field.
inline std::vector<Endless> trace_endless(double g, const std::vector<double> &albedos, const std::vector<double> &radii,
                                          int photons, uint64_t seed)
{
    struct Tally {
        double inner, outer;
        double sum = 0, square = 0, once = 0, moments[3] = {}, source[bins] = {}, now = 0;
    };
    const size_t media = albedos.size(), count = radii.size();
    std::vector<double> absorption(media), scale(media);
    std::vector<Tally> tallies(media * count);
    for (size_t m = 0; m < media; ++m) {
        absorption[m] = 1 / albedos[m] - 1;
        scale[m] = 1 / (absorption[m] + 1 - g);
        for (size_t i = 0; i < count; ++i) {
            tallies[m * count + i].inner = 0.95 * radii[i] * scale[m];
            tallies[m * count + i].outer = 1.05 * radii[i] * scale[m];
        }
    }
    const double limit = 2 * radii.back() / (1 - g), nearest = 1e-3;
    std::array<double, bins - 1> cosines;
    for (int i = 0; i < bins - 1; ++i)
        cosines[size_t(i)] = std::cos(angles[size_t(i) + 1] * pi / 180);
    Random random(seed);

    auto add = [&](Tally &t, double amount, int order, vec3 p, vec3 d, double s) {
        t.now += amount;
        if (order == 1)
            t.once += amount;
        const vec3 away = glm::normalize(p + s * d);
        const double c = glm::dot(away, d);
        t.moments[0] += amount * c;
        t.moments[1] += amount * 0.5 * (3 * c * c - 1);
        t.moments[2] += amount * 0.5 * (5 * c * c * c - 3 * c);
        const double out = glm::dot(away, turned(d, sampled_cosine(g, random), 2 * pi * random()));
        int bin = 0;
        while (bin < bins - 1 && out < cosines[size_t(bin)])
            ++bin;
        t.source[bin] += amount;
    };

    for (int n = 0; n < photons; ++n) {
        vec3 p(0), d = uniform_direction(random);
        // Half of the first scatterings are spread evenly over the logarithm of their distance: few would be near the lamp.
        const double span = std::log(limit / nearest);
        const double first = random() < 0.5 ? -std::log(random()) : nearest * std::exp(span * random());
        const double likely = 0.5 * std::exp(-first) + (first > nearest && first < limit ? 0.5 / (span * first) : 0);
        const double weight = std::exp(-first) / likely;
        double length = first;
        p = first * d;
        for (int order = 1; glm::dot(p, p) < limit * limit; ++order) {
            d = turned(d, sampled_cosine(g, random), 2 * pi * random());
            const double flight = -std::log(random());
            const double b = glm::dot(p, d), h2 = std::max(glm::dot(p, p) - b * b, 0.0);
            // Early flights count by what they are expected to, later ones by what they do.
            const bool expected = order <= 4;
            const double reach = expected ? 30 : flight;
            for (size_t m = 0; m < media; ++m) {
                const double before = weight * std::exp(-absorption[m] * length);
                if (before < 1e-12)
                    continue;
                const double rate = absorption[m] + (expected ? 1.0 : 0.0);
                for (size_t i = 0; i < count; ++i) {
                    Tally &t = tallies[m * count + i];
                    if (h2 >= t.outer * t.outer)
                        continue;
                    const double far = std::sqrt(t.outer * t.outer - h2);
                    if (far - b <= 0 || -far - b >= reach)
                        continue;
                    const double near = h2 < t.inner * t.inner ? std::sqrt(t.inner * t.inner - h2) : -1;
                    const double ends[4] = {-far - b, near < 0 ? far - b : -near - b, near < 0 ? 0 : near - b,
                                            near < 0 ? 0 : far - b};
                    for (int part = 0; part < 2; ++part) {
                        const double from = std::max(ends[2 * part], 0.0), to = std::min(ends[2 * part + 1], reach);
                        if (to <= from)
                            continue;
                        const double way = to - from, faded = -std::expm1(-rate * way);
                        const double amount = before * std::exp(-rate * from) * (rate * way > 1e-9 ? faded / rate : way);
                        const double u = random();
                        const double s = from + (rate * way > 1e-9 ? -std::log1p(-u * faded) / rate : u * way);
                        add(t, amount, order, p, d, s);
                    }
                }
            }
            p += flight * d;
            length += flight;
        }
        for (Tally &t : tallies) {
            t.sum += t.now;
            t.square += t.now * t.now;
            t.now = 0;
        }
    }

    std::vector<Endless> out;
    for (size_t m = 0; m < media; ++m) {
        Endless e{g, albedos[m], {}};
        const double a = absorption[m] * scale[m], kappa = std::sqrt(3 * a), edge = limit / scale[m] + 0.7104;
        for (size_t i = 0; i < count; ++i) {
            const Tally &t = tallies[m * count + i];
            Shell s;
            const double u = 0.95 * radii[i], v = 1.05 * radii[i];
            s.radius = 0.75 * (std::pow(v, 4) - std::pow(u, 4)) / (std::pow(v, 3) - std::pow(u, 3));
            // Of volume s^3, times s to be a length of 1 / s'.
            const double unit = 4 * pi / (photons * 4 / 3.0 * pi * (std::pow(v, 3) - std::pow(u, 3))) / scale[m];
            const double own = unit * t.sum;
            const double x = s.radius;
            const double beyond =
                kappa < 1e-6 ? 3 * (1 - a) / edge
                             : 3 * (1 - a) * std::sinh(kappa * x) / x * std::exp(-kappa * edge) / std::sinh(kappa * edge);
            s.fluence = own + beyond;
            s.once = unit * t.once;
            s.deviation = std::sqrt(std::max(t.square / (t.sum * t.sum) - 1.0 / photons, 0.0));
            for (int l = 0; l < 3; ++l)
                s.moments[l] = unit * t.moments[l] / s.fluence;
            for (int k = 0; k < bins; ++k) {
                const double solid =
                    2 * pi * (std::cos(angles[size_t(k)] * pi / 180) - std::cos(angles[size_t(k) + 1] * pi / 180));
                s.source[k] = (unit * t.source[k] / solid + beyond / (4 * pi)) / s.fluence;
            }
            e.shells.push_back(s);
        }
        out.push_back(e);
    }
    return out;
}

// A cell of points around a lamp over a black plane, in units of 1 / s'.
struct GroundCell {
    double aside = 0, height = 0;  // from the lamp's foot, over the plane
    double fluence = 0;            // of what has scattered at least once and not touched the plane
    double deviation = 0;
};

// Rings of +-10 % by slices of +-10 % of their height, no absorption; the lamp is at `height`.
inline std::vector<GroundCell> trace_over_ground(double g, double height, int photons, uint64_t seed)
{
    const std::vector<double> asides{0.1 * height, 0.5 * height, height, 2 * height, 4 * height, 8 * height},
        heights{0.2 * height, 0.6 * height, height, 1.6 * height};
    struct Tally {
        double sum = 0, square = 0, now = 0;
    };
    std::vector<Tally> tallies(asides.size() * heights.size());
    const double scale = 1 / (1 - g), limit = 40 * scale, nearest = 1e-2 * height * scale, span = std::log(limit / nearest);
    Random random(seed);
    auto index_of = [](const std::vector<double> &middles, double x) {
        for (size_t i = 0; i < middles.size(); ++i)
            if (std::abs(x - middles[i]) <= 0.1 * middles[i])
                return int(i);
        return -1;
    };
    for (int n = 0; n < photons; ++n) {
        vec3 p(0, 0, height * scale), d = uniform_direction(random);
        double flight = random() < 0.5 ? -std::log(random()) : nearest * std::exp(span * random());
        const double weight =
            std::exp(-flight) / (0.5 * std::exp(-flight) + (flight > nearest && flight < limit ? 0.5 / (span * flight) : 0));
        for (int order = 0; glm::dot(p, p) < limit * limit; ++order) {
            if (order > 0) {
                d = turned(d, sampled_cosine(g, random), 2 * pi * random());
                flight = -std::log(random());
            }
            const double to_plane = d.z < 0 ? -p.z / d.z : 1e30, way = std::min(flight, to_plane);
            const int samples = 4;
            for (int i = 0; order > 0 && i < samples; ++i) {
                const vec3 x = (p + way * (i + random()) / double(samples) * d) / scale;
                const int z = index_of(heights, x.z), r = z < 0 ? -1 : index_of(asides, std::hypot(x.x, x.y));
                if (r >= 0)
                    tallies[size_t(r) * heights.size() + size_t(z)].now += weight * way / samples;
            }
            if (to_plane <= flight)
                break;
            p += flight * d;
        }
        for (Tally &t : tallies)
            if (t.now > 0) {
                t.sum += t.now;
                t.square += t.now * t.now;
                t.now = 0;
            }
    }
    std::vector<GroundCell> out;
    for (size_t r = 0; r < asides.size(); ++r)
        for (size_t z = 0; z < heights.size(); ++z) {
            const Tally &t = tallies[r * heights.size() + z];
            const double volume = 2 * pi * asides[r] * 0.2 * asides[r] * 0.2 * heights[z];
            out.push_back({asides[r], heights[z], 4 * pi * t.sum / (photons * volume * scale),
                           t.sum > 0 ? std::sqrt(t.square) / t.sum : 1});
        }
    return out;
}

// Black walls around a lamp at the origin, in units of a room's size; infinite: there is none.
struct Room {
    const char *name;
    vec3 low, high;
};

constexpr double no_wall = std::numeric_limits<double>::infinity();
inline const Room rooms[] = {{"floor", {-no_wall, -no_wall, -1}, {no_wall, no_wall, no_wall}},
                             {"two walls", {-1, -no_wall, -no_wall}, {1, no_wall, no_wall}},
                             {"corner", {-1, -no_wall, -1}, {no_wall, no_wall, no_wall}},
                             {"corridor", {-1, -no_wall, -1}, {1, no_wall, no_wall}},
                             {"tunnel", {-1, -no_wall, -1}, {1, no_wall, 1}},
                             {"cube", {-1, -1, -1}, {1, 1, 1}},
                             {"room", {-2, -3, -1}, {2, 3, 0.6}}};

struct RoomPoint {
    vec3 way{};          // from the lamp [1 / s']
    double fluence = 0;  // of what has scattered at least once and touched no wall
    double deviation = 0;
};

// Spheres of a fifth of the room's size [1 / s'], no absorption.
inline std::vector<RoomPoint> trace_in_room(const Room &room, double g, double size, int photons, uint64_t seed)
{
    const double scale = 1 / (1 - g), unit = size * scale, radius = 0.2 * unit, limit = 40 * scale, nearest = 1e-2 * unit,
                 span = std::log(limit / nearest);
    struct Tally {
        vec3 at;
        double sum = 0, square = 0, now = 0;
    };
    std::vector<Tally> tallies;
    for (const vec3 at :
         {vec3(0.4, 0.3, -0.3), vec3(-0.3, 0.8, 0.1), vec3(0.2, -0.5, -0.7), vec3(0.7, 1.5, -0.2), vec3(0.1, 2.5, 0.3)})
        if (glm::all(glm::greaterThanEqual(at - 0.2, room.low)) && glm::all(glm::lessThanEqual(at + 0.2, room.high)))
            tallies.push_back({unit * at});
    Random random(seed);
    for (int n = 0; n < photons; ++n) {
        vec3 p(0), d = uniform_direction(random);
        double flight = random() < 0.5 ? -std::log(random()) : nearest * std::exp(span * random());
        const double weight =
            std::exp(-flight) / (0.5 * std::exp(-flight) + (flight > nearest && flight < limit ? 0.5 / (span * flight) : 0));
        for (int order = 0; glm::dot(p, p) < limit * limit; ++order) {
            if (order > 0) {
                d = turned(d, sampled_cosine(g, random), 2 * pi * random());
                flight = -std::log(random());
            }
            double wall = no_wall;
            for (int axis = 0; axis < 3; ++axis)
                wall = std::min(wall, (unit * (d[axis] > 0 ? room.high : room.low)[axis] - p[axis]) / d[axis]);
            for (Tally &t : tallies) {
                const vec3 to = t.at - p;
                const double along = glm::dot(to, d), square = radius * radius - (glm::dot(to, to) - along * along);
                if (order == 0 || square <= 0)
                    continue;
                // By what the flight is expected to.
                const double from = std::max(along - std::sqrt(square), 0.0),
                             end = std::min(along + std::sqrt(square), wall);
                if (end > from)
                    t.now += weight * (std::exp(-from) - std::exp(-end));
            }
            if (wall <= flight)
                break;
            p += flight * d;
        }
        for (Tally &t : tallies) {
            t.sum += t.now;
            t.square += t.now * t.now;
            t.now = 0;
        }
    }
    std::vector<RoomPoint> out;
    for (const Tally &t : tallies) {
        const double volume = 4 / 3.0 * pi * std::pow(0.2 * size, 3);
        out.push_back(
            {t.at / scale, 4 * pi * t.sum / (photons * volume * scale), t.sum > 0 ? std::sqrt(t.square) / t.sum : 1});
    }
    return out;
}

}  // namespace lamp_tracer
