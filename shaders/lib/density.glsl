// Density integrals along a ray from the camera (Iser 2018 sec. 3.3). Needs scene.glsl.

// P saturates here: what lies behind it is invisible for any cross-section above 1e-28 / m.
const float density_limit = R(1e30);

// phi(q) = (1 - e^-q) / q for q >= 0: the mean of e^-qt over t in [0, 1]. The quotient cancels for small q (33 % off in
// 32 bits near 1e-7); there e^(-q/2) sinh(q/2) / (q/2) takes over, whose series is good to 3e-8 up to q = 2.
PURE float mean_exponential(float q)
{
    if (q < R(2.0)) {
        float y2 = R(0.25) * q * q;
        float s = R(1.0) + y2 / R(6.0) * (R(1.0) + y2 / R(20.0) * (R(1.0) + y2 / R(42.0) * (R(1.0) + y2 / R(72.0))));
        return exp(-R(0.5) * q) * s;
    }
    return (R(1.0) - exp(-q)) / q;
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
