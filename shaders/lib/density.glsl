// Density integrals along a ray from the camera (Iser 2018 sec. 3.3). Needs scene.glsl.

// P saturates here: what lies behind it is invisible for any cross-section above 1e-28 / m.
const float density_limit = R(1e30);

// phi(q) = (1 - e^-q) / q for q >= 0: the mean of e^-qt over t in [0, 1]. The quotient cancels for small q (33 % off in
// 32 bits near 1e-7); there e^(-q/2) sinh(q/2) / (q/2) takes over, whose series is good to 3e-8 up to q = 2.
PURE float sinh_series(float q)
{
    float y2 = R(0.25) * q * q;
    return R(1.0) + y2 * R(1.0 / 6.0) *
                        (R(1.0) + y2 * R(1.0 / 20.0) * (R(1.0) + y2 * R(1.0 / 42.0) * (R(1.0) + y2 * R(1.0 / 72.0))));
}

PURE float mean_exponential(float q)
{
    Bool small = q < R(2.0);
    float e = exp(choose(small, -R(0.5) * q, -q));
    return choose(small, e * sinh_series(q), (R(1.0) - e) / q);
}

// Iser eq. 4 for one exponential term. term.xyz = b R^T n, term.w = log rho(camera). Measured from whichever end of the
// segment is denser, so that only the true magnitude can overflow, and that saturates.
PURE float exponential_density_integral(vec4 term, vec3 direction, float distance)
{
    float q = distance * dot(vec3(term.x, term.y, term.z), direction);
    float peak = term.w + max(-q, R(0.0));
    return distance * mean_exponential(abs(q)) * exp(min(peak, R(80.0)));
}

// P = int_0^D rho dt [m at unit density], in [0, density_limit].
PURE float density_integral(IN(Medium) medium, vec3 direction, float distance)
{
    float p = min(medium.constant * distance, density_limit);
    for (int i = 0; i < medium.term_count; ++i)
        p += min(exponential_density_integral(medium.terms[i], direction, distance), density_limit);
    return min(p, density_limit);
}

// An exponential term as seen from another origin.
PURE vec4 moved_term(vec4 term, vec3 origin)
{
    return vec4(term.x, term.y, term.z, term.w - (term.x * origin.x + term.y * origin.y + term.z * origin.z));
}

// The constant and exponential terms at a point.
PURE float density_at(IN(Medium) medium, vec3 point)
{
    float rho = medium.constant;
    for (int i = 0; i < medium.term_count; ++i)
        rho += exp(min(moved_term(medium.terms[i], point).w, R(69.0)));
    return min(rho, density_limit);
}

// density_integral along a segment that begins elsewhere, without the constant terms: these have no end, and the light of a
// directional light has come through `constant_distance` of them only.
PURE float density_between(IN(Medium) medium, vec3 origin, vec3 direction, float distance, float constant_distance)
{
    float p = min(medium.constant * constant_distance, density_limit);
    for (int i = 0; i < medium.term_count; ++i)
        p += min(exponential_density_integral(moved_term(medium.terms[i], origin), direction, distance), density_limit);
    return min(p, density_limit);
}
