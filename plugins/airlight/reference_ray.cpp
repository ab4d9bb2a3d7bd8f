#include "reference_ray.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

namespace brume::airlight {
namespace {

using namespace maths_double;

constexpr double half_root_pi = 0.88622692545275801365;

double integral_of(const Profile &p, double distance)
{
    const double from = -p.scale * p.middle, to = p.scale * (distance - p.middle);
    // On the flanks erf has no digits left, near the centre erfc has none of a short way through a wide Gaussian.
    const double area = from > 0.5  ? std::erfc(from) - std::erfc(to)
                        : to < -0.5 ? std::erfc(-to) - std::erfc(-from)
                                    : std::erf(to) - std::erf(from);
    return half_root_pi * p.peak / p.scale * area;
}

// expm1 in place of the single precision series of mean_exponential.
double terms_integral(const Medium &medium, vec3 origin, vec3 direction, double distance, double constant_distance)
{
    double p = medium.constant * constant_distance;
    for (int i = 0; i < medium.term_count; ++i) {
        const vec4 term = moved_term(medium.terms[i], origin);
        const double q = distance * glm::dot(vec3(term), direction);
        const double mean = std::abs(q) < 1e-300 ? 1 : -std::expm1(-std::abs(q)) / std::abs(q);
        p += std::min(distance * mean * std::exp(std::min(term.w + std::max(-q, 0.0), 600.0)), density_limit);
    }
    return std::min(p, density_limit);
}

// One light's integrand along one ray.
class Integrand {
public:
    Integrand(const ReferenceScene &scene, vec3 direction, int light, double distance)
        : scene_(scene), direction_(direction), light_(scene.lights[size_t(light)]), aspect_(aspect_of(light_, direction)),
          around_(scene.around.empty() ? open_surroundings() : scene.around[size_t(light)])
    {
        find_shadows(light, distance);
        for (const Gaussian &g : scene.gaussians) {
            seen_.push_back(sight_profile(scene.medium, scene.camera, g, direction));
            most_.push_back(profile_along(g, g.center, direction).peak);
        }
    }

    vec3 operator()(double t) const
    {
        const vec3 x = t * direction_;
        const Medium &medium = scene_.medium;
        vec3 way = light_.direction;
        double d = far_away, constant_distance = light_.distance;
        if (light_.type != light_directional) {
            const vec3 from = x - light_.position;
            d = constant_distance = glm::length(from);
            way = from / std::max(d, 1e-300);
        }
        const double strength = in_shadow(t) ? 0 : lit_strength(medium, light_, aspect_, direction_, t);
        if (strength <= 0 && scene_.orders == orders_single)
            return vec3(0);
        double depth = terms_integral(medium, vec3(0), direction_, t, t);
        double to_light = terms_integral(medium, x, -way, d, constant_distance);
        vec3 scattering(density_at(medium, x));
        for (size_t i = 0; i < seen_.size(); ++i) {
            const Gaussian &g = scene_.gaussians[i];
            const double y = seen_[i].scale * (t - seen_[i].middle);
            const Profile shadow = profile_along(g, x, -way);
            depth += integral_of(seen_[i], t);
            if (shadow.peak > 1e-14 * most_[i])
                to_light += integral_of(shadow, d);
            scattering += seen_[i].peak * std::exp(-y * y) * g.color;
        }
        const vec3 extinction = medium.scattering + medium.absorption;
        vec3 arrives = strength * light_.intensity * glm::exp(-extinction * std::min(to_light, density_limit));
        if (scene_.orders == orders_all)
            arrives += rescattered_strength(medium, scene_.camera, light_, aspect_, around_, direction_, t,
                                            std::min(to_light, density_limit));
        return arrives * medium.scattering * scattering * glm::exp(-extinction * std::min(depth, density_limit));
    }

    // Where it may bend: quadrature begins with these ends.
    std::vector<double> breaks(double distance) const
    {
        std::vector<double> t{0, distance};
        for (double far = 1e-6; far < distance; far *= 8)
            t.push_back(far);
        if (light_.type != light_directional) {
            const double t0 = aspect_.foot, h = aspect_.height;
            for (double s : {0.0, 0.25, 1.0, 4.0, 16.0, 64.0})
                for (double side : {-1.0, 1.0})
                    t.push_back(t0 + side * s * h);
            // Where the ray enters the light's sphere, whose inside has constant fluence.
            const double k = std::sqrt(std::max(light_.radius * light_.radius - h * h, 0.0));
            t.push_back(t0 - k);
            t.push_back(t0 + k);
            if (light_.type == light_spot)
                for (double c : {light_.cos_outer, light_.cos_inner}) {
                    const vec2 lit = lit_interval(light_, direction_, distance, c);
                    t.push_back(lit.x);
                    t.push_back(lit.y);
                }
        }
        t.insert(t.end(), edges_.begin(), edges_.end());
        // Many Gaussians part the ray finely enough between them.
        const bool many = seen_.size() > 16;
        for (const Profile &p : seen_)
            if (p.peak > 0)
                for (double s : {-6.0, -3.0, -1.5, 0.0, 1.5, 3.0, 6.0})
                    if (!many || s == 0 || std::abs(s) == 3)
                        t.push_back(p.middle + s / p.scale);
        std::erase_if(t, [&](double x) { return !(x >= 0 && x <= distance); });
        std::sort(t.begin(), t.end());
        return t;
    }

private:
    void find_shadows(int light, double distance)
    {
        if (!scene_.shadowed)
            return;
        const Texture &light_shadows = *scene_.light_shadows, &shadow_maps = *scene_.shadow_maps;
        const double reach = scene_.gaussians.empty() ? terms_range(scene_.medium, Sight{direction_, distance, 0, 0}).y
                                                      : std::min(distance, quadrature_limit);
        const ShadowRay ray = shadow_ray(scene_.camera, SHADOW_MAP_PASSED, scene_.shadowed, light, direction_, reach);
        if (ray.kind == 0)
            return;
        edges_.push_back(-1);  // so that a ray of which nothing is lit has edges, too
        edges_.push_back(-1);
        for (LitWalk walk = next_lit(shadow_maps, ray, lit_walk(0), distance); walk.part.x < walk.part.y;
             walk = next_lit(shadow_maps, ray, walk, distance)) {
            edges_.push_back(walk.part.x);
            edges_.push_back(walk.part.y);
        }
    }

    bool in_shadow(double t) const
    {
        if (edges_.empty())
            return false;
        const auto after = std::upper_bound(edges_.begin(), edges_.end(), t);
        return (after - edges_.begin()) % 2 == 0;
    }

    const ReferenceScene &scene_;
    vec3 direction_;
    const Light &light_;
    Aspect aspect_;
    Surroundings around_;
    std::vector<Profile> seen_;  // the Gaussians along the ray
    std::vector<double> most_;   // their peaks along rays through their centres
    std::vector<double> edges_;  // begins and ends of what is lit, by turns; none: all is
};

struct Piece {
    double from, to;
    vec3 value, error;
    double rank = 0;
    bool operator<(const Piece &other) const { return rank < other.rank; }
};

// QUADPACK's 7 points of Gauss within 15 of Kronrod.
Piece integrated(const Integrand &f, double from, double to)
{
    static constexpr double node[8] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                       0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                       0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                       0.207784955007898467600689403773245, 0};
    static constexpr double kronrod[8] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                          0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                          0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                          0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
    static constexpr double gauss[4] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                        0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    vec3 k(0), g(0);
    for (int i = 0; i < 8; ++i) {
        const vec3 v = i == 7 ? f(middle) : f(middle - half * node[i]) + f(middle + half * node[i]);
        k += kronrod[i] * v;
        if (i % 2 == 1)
            g += gauss[i / 2] * v;
    }
    return {from, to, half * k, glm::abs(half * (k - g)), 0};
}

double largest(vec3 v)
{
    return std::max({v.x, v.y, v.z});
}

ReferenceAirlight of_light(const ReferenceScene &scene, vec3 direction, double distance, int light, double tolerance)
{
    const Integrand f(scene, direction, light, distance);
    const std::vector<double> breaks = f.breaks(distance);
    std::vector<Piece> first;
    ReferenceAirlight out;
    for (size_t i = 0; i + 1 < breaks.size(); ++i)
        if (breaks[i + 1] > breaks[i]) {
            first.push_back(integrated(f, breaks[i], breaks[i + 1]));
            out.radiance += first.back().value;
            out.error += first.back().error;
        }
    // Errors count relative to each channel's whole; a channel without light has none.
    const vec3 per_channel = 1.0 / glm::max(out.radiance, vec3(1e-300));
    auto ranked = [&](Piece p) { return p.rank = largest(p.error * per_channel), p; };
    std::priority_queue<Piece> pieces;
    for (const Piece &p : first)
        pieces.push(ranked(p));
    const size_t most = first.size() + 3000;
    size_t made = first.size();
    while (made < most && !pieces.empty() && largest(out.error / glm::max(out.radiance, vec3(1e-300))) > tolerance) {
        const Piece p = pieces.top();
        pieces.pop();
        const double middle = 0.5 * (p.from + p.to);
        if (!(middle > p.from && middle < p.to))
            continue;
        const Piece l = ranked(integrated(f, p.from, middle)), r = ranked(integrated(f, middle, p.to));
        out.radiance += l.value + r.value - p.value;
        out.error = glm::max(out.error + l.error + r.error - p.error, vec3(0));
        pieces.push(l);
        pieces.push(r);
        made += 2;
    }
    out.evaluations = int(15 * made);
    return out;
}

}  // namespace

ReferenceAirlight reference_airlight(const ReferenceScene &scene, vec3 direction, double distance, int first_light,
                                     int last_light, double tolerance)
{
    ReferenceAirlight sum;
    for (int l = first_light; l < last_light; ++l) {
        const ReferenceAirlight one = of_light(scene, direction, std::clamp(distance, 0.0, far_away), l, tolerance);
        sum.radiance += one.radiance;
        sum.error += one.error;
        sum.evaluations += one.evaluations;
    }
    return sum;
}

}  // namespace brume::airlight
