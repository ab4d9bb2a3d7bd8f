// What a density integral P does to radiance. Needs scene.glsl, ray.glsl, density.glsl.

// P to what the pixel shows; gaussians: their part of it.
PURE float density_to(IN(Medium) medium, IN(Ray) ray, float gaussians)
{
    return choose(ray.keep, R(0.0),
                  min(density_integral(medium, ray.direction, ray.distance) + gaussians, density_limit));
}

PURE float luminance(vec3 weights, vec3 color)
{
    return dot(weights, color);
}

// An infinite optical depth times nothing is not a number.
const float optical_depth_limit = R(1e38);

PURE vec3 optical_depth(IN(Medium) medium, float p)
{
    return min((medium.scattering + medium.absorption) * p, vec3(optical_depth_limit));
}

PURE vec3 optical_depth(IN(Medium) medium, vec3 p)
{
    return min((medium.scattering + medium.absorption) * p, vec3(optical_depth_limit));
}

// Where no share of scattered light is wanted beside it, which shares_of() gives at no more cost.
PURE vec3 transmittance(IN(Medium) medium, float p)
{
    return exp(-optical_depth(medium, p));
}

// e^-x and 1 - e^-x, x >= 0, by one exponential.
PURE vec2 parted(float x)
{
    Bool small = x < R(2.0);
    float e = exp(choose(small, -R(0.5) * x, -x));
    return vec2(choose(small, e * e, e), choose(small, x * (e * sinh_series(x)), R(1.0) - e));
}

// 1 - e^-x without cancellation, x >= 0.
PURE float one_minus_exp(float x)
{
    return parted(x).y;
}

struct Shares {
    vec3 straight;   // e^(-C_t P)
    vec3 scattered;  // but not absorbed: e^(-C_a P) (1 - e^(-C_s P)), Iser sec. 4.1
};

PURE Shares shares_of(IN(Medium) medium, float p)
{
    vec3 s = medium.scattering * p;
    vec2 x = parted(s.x);
    vec2 y = x;
    vec2 z = x;
    if (medium.scattering != vec3(medium.scattering.x)) {
        y = parted(s.y);
        z = parted(s.z);
    }
    Shares shares = Shares(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y));
    if (medium.absorption != vec3(R(0.0))) {
        vec3 kept = exp(-min(medium.absorption * p, vec3(optical_depth_limit)));
        shares.straight *= kept;
        shares.scattered *= kept;
    }
    return shares;
}

// p: of each colour by itself.
PURE Shares shares_of(IN(Medium) medium, vec3 p)
{
    vec3 s = min(medium.scattering * p, vec3(optical_depth_limit));
    vec2 x = parted(s.x);
    vec2 y = parted(s.y);
    vec2 z = parted(s.z);
    vec3 kept = exp(-min(medium.absorption * p, vec3(optical_depth_limit)));
    return Shares(vec3(x.x, y.x, z.x) * kept, vec3(x.y, y.y, z.y) * kept);
}

PURE vec3 scattered_share(IN(Medium) medium, float p)
{
    return shares_of(medium, p).scattered;
}

// The part of it that was scattered more than once: scattering events along the ray are Poisson distributed.
PURE vec3 rescattered_share(IN(Medium) medium, float p)
{
    vec3 s = min(medium.scattering * p, vec3(optical_depth_limit));
    vec3 more = vec3(one_minus_exp(s.x), one_minus_exp(s.y), one_minus_exp(s.z)) - s * exp(-s);
    return exp(-medium.absorption * p) * max(more, vec3(R(0.0)));
}

// The medium's own radiance: int C_e rho e^(-C_t P(t)) dt = C_e P phi(C_t P), exact for any density since only P enters.
// Emitted light that scatters on its way is not followed. Saturates at C_e / C_t
// (and, in a medium that only emits, at density_limit).
PURE vec3 emitted(IN(Medium) medium, float p)
{
    if (medium.emission == vec3(R(0.0)))
        return vec3(R(0.0));
    vec3 tau = optical_depth(medium, p);
    vec3 length = p * vec3(mean_exponential(tau.x), mean_exponential(tau.y), mean_exponential(tau.z));
    return min(medium.emission * length, vec3(density_limit));
}

PURE vec3 emitted(IN(Medium) medium, vec3 p)
{
    vec3 tau = optical_depth(medium, p);
    vec3 length = p * vec3(mean_exponential(tau.x), mean_exponential(tau.y), mean_exponential(tau.z));
    return min(medium.emission * length, vec3(density_limit));
}

PURE vec3 chosen(Bool which, vec3 a, vec3 b)
{
    return vec3(choose(which, a.x, b.x), choose(which, a.y, b.y), choose(which, a.z, b.z));
}

// A component that is not finite gives no light to others: one bad pixel must not blacken the frame.
PURE vec3 finite_or_zero(vec3 color)
{
    return vec3(choose(is_finite(color.x), color.x, R(0.0)), choose(is_finite(color.y), color.y, R(0.0)),
                choose(is_finite(color.z), color.z, R(0.0)));
}

PURE float composed(float source, float t, float added, float limit)
{
    return choose(is_finite(source), clamp(source * t + added, -limit, limit), source);
}

// L' = T L + added (Iser sec. 4.4), within what the output holds; a component that is not finite comes back unchanged.
PURE vec3 compose_radiance(vec3 source, vec3 t, vec3 added, float limit)
{
    return vec3(composed(source.x, t.x, added.x, limit), composed(source.y, t.y, added.y, limit),
                composed(source.z, t.z, added.z, limit));
}
