// Where along a ray the density lies. Needs scene.glsl, density.glsl.

// int_0^1 s^2 e^(-q s) ds for q >= 0.
PURE float mean_square_exponential(float q)
{
    if (q < R(1.0))
        return R(1.0) / R(3.0) -
               q * (R(0.25) - q * (R(0.1) - q * (R(1.0) / R(36.0) -
               q * (R(1.0) / R(168.0) - q * (R(1.0) / R(960.0) - q * (R(1.0) / R(6480.0) - q * (R(1.0) / R(50400.0) -
               q * (R(1.0) / R(443520.0) - q * (R(1.0) / R(4354560.0) - q / R(47174400.0))))))))));
    float e = min(q, R(100.0));
    return (R(2.0) - exp(-e) * (e * e + R(2.0) * e + R(2.0))) / q / q / q;
}

// int_0^1 (1 - s)^2 e^(-q s) ds for q >= 0.
PURE float mean_square_to_end(float q)
{
    if (q < R(1.0))
        return R(1.0) / R(3.0) -
               q * (R(1.0) / R(12.0) - q * (R(1.0) / R(60.0) - q * (R(1.0) / R(360.0) -
               q * (R(1.0) / R(2520.0) - q * (R(1.0) / R(20160.0) - q * (R(1.0) / R(181440.0) - q / R(1814400.0)))))));
    return (R(1.0) - R(2.0) / q + R(2.0) * (R(1.0) - exp(-q)) / q / q) / q;
}

// int_0^D rho (1 - t/D)^2 dt of the constant and exponential terms: how far from the object the medium sits.
PURE float density_moment(IN(Medium) medium, vec3 direction, float distance)
{
    float m = min(medium.constant * distance / R(3.0), density_limit);
    for (int i = 0; i < medium.term_count; ++i) {
        vec4 term = medium.terms[i];
        float q = distance * dot(vec3(term.x, term.y, term.z), direction);
        float peak = min(term.w + max(-q, R(0.0)), R(80.0));
        float mean = q >= R(0.0) ? mean_square_to_end(q) : mean_square_exponential(-q);
        m += min(distance * mean * exp(peak), density_limit);
    }
    return min(m, density_limit);
}
