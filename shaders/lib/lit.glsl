// A light's radiance that a point of a ray would scatter toward its origin, before extinction. Needs light.glsl, phase.glsl.

// Bounds what a light of no size does at its own place.
const float smallest_light = R(1e-6);       // [m]
const float smallest_light_angle = R(1e-4); // as seen from the camera
const float radiance_limit = R(1e30);

// Where a light stands to a ray: the ray's point nearest to it, and how far it is from there.
struct Aspect {
    float foot;
    float height;
};

PURE Aspect aspect_of(IN(Light) light, vec3 direction)
{
    float least = max(smallest_light, smallest_light_angle * length(light.position));
    return Aspect(dot(light.position, direction), max(length(cross(direction, light.position)), least));
}

// Radiance integrated over the directions from which a sphere of radius R and intensity 1 shines on a point at distance d:
// its solid angle over pi R^2, which is 1/d^2 from afar, and twice that where it is touched; constant within.
PURE float fluence(float d, float radius)
{
    float x = max(d, radius);
    return R(2.0) / (x * x + x * sqrt((x - radius) * (x + radius)));
}

// p I / d^2 at t for I = 1, without extinction.
PURE float lit_strength(IN(Medium) medium, IN(Light) light, IN(Aspect) aspect, vec3 direction, float t)
{
    if (light.type == light_directional)
        return phase(medium, -dot(light.direction, direction));
    float x = t - aspect.foot;
    float d = sqrt(aspect.height * aspect.height + x * x);
    float s = phase(medium, -x / d) * fluence(d, light.radius);
    if (light.type == light_spot) {
        vec3 from = t * direction - light.position;
        s *= spot_factor(light, dot(from, light.direction) / max(length(from), R(1e-20)));
    }
    return s;
}

// int rho dt of the constant and exponential terms between the light and a point.
PURE float terms_to_light(IN(Medium) medium, IN(Light) light, vec3 point)
{
    if (light.type == light_directional)
        return density_between(medium, point, -light.direction, far_away, light.distance);
    vec3 way = light.position - point;
    float d = length(way);
    return density_between(medium, point, way / max(d, R(1e-20)), d, d);
}

// The constant and exponential terms at a point of the ray.
struct TermsAt {
    float density;
    float from_camera;  // int rho dt
    float from_light;   // int rho dt
};

// The exponential terms' densities at the ends of all ways from points of a ray.
struct TermEnds {
    float camera[max_density_terms];
    float light[max_density_terms];
};

PURE TermEnds term_ends(IN(Medium) medium, IN(Light) light)
{
    TermEnds ends;
    for (int i = 0; i < medium.term_count; ++i) {
        ends.camera[i] = exp(min(medium.terms[i].w, R(69.0)));
        ends.light[i] = exp(min(moved_term(medium.terms[i], light.position).w, R(69.0)));
    }
    return ends;
}

// Mean of an exponential between its values a and b, q = |log(a / b)|: mean_exponential() where both are known.
PURE float mean_between(float a, float b, float q)
{
    return choose(q < R(2.0), sqrt(a) * sqrt(b) * sinh_series(q), abs(a - b) / q);
}

// density_at(), density_integral() and terms_to_light() at t, for one exponential a term.
PURE TermsAt terms_at(IN(Medium) medium, IN(TermEnds) ends, IN(Light) light, vec3 direction, float t)
{
    vec3 point = t * direction;
    vec3 way = light.position - point;
    bool parallel = light.type == light_directional;
    float d = parallel ? light.distance : length(way);
    float rho = medium.constant;
    float before = min(medium.constant * t, density_limit);
    float after = min(medium.constant * d, density_limit);
    for (int i = 0; i < medium.term_count; ++i) {
        vec4 term = medium.terms[i];
        vec3 fall = vec3(term.x, term.y, term.z);
        float q = t * dot(fall, direction);
        float here = exp(min(term.w - q, R(69.0)));
        rho += here;
        before += min(t * mean_between(ends.camera[i], here, abs(q)), density_limit);
        after += min(parallel ? exponential_density_integral(moved_term(term, point), -light.direction, far_away)
                              : d * mean_between(here, ends.light[i], abs(dot(fall, way))),
                     density_limit);
    }
    return TermsAt(min(rho, density_limit), min(before, density_limit), min(after, density_limit));
}
