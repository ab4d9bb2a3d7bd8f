// Phase functions [1/sr]. Needs scene.glsl.

const float pi = R(3.14159265358979);

// g = +-1 is a delta function, which nothing but a delta light can be seen through; it is evaluated at +-.9999.
const float largest_asymmetry = R(0.9999);

// (1 - mu^2 g^2 is left in the form that does not cancel for g mu -> 1: 1 + g^2 - 2 g mu = (1 - g)^2 + 2 g (1 - mu).)
PURE float henyey_greenstein(float asymmetry, float cosine)
{
    float g = clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
    float s = choose(g >= R(0.0), (R(1.0) - g) * (R(1.0) - g) + R(2.0) * g * max(R(1.0) - cosine, R(0.0)),
                     (R(1.0) + g) * (R(1.0) + g) - R(2.0) * g * max(R(1.0) + cosine, R(0.0)));
    return (R(1.0) - g * g) / (R(4.0) * pi * s * sqrt(s));
}

// Draine 2003, as in Jendersie and d'Eon 2023.
PURE float draine(float asymmetry, float alpha, float cosine)
{
    float g = clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
    return henyey_greenstein(g, cosine) * (R(1.0) + alpha * cosine * cosine) /
           (R(1.0) + alpha * (R(1.0) + R(2.0) * g * g) / R(3.0));
}

// cosine: of the angle by which light is turned, 1 where it goes straight on.
PURE float phase(IN(Medium) medium, float cosine)
{
    float p = henyey_greenstein(medium.phase.x, cosine);
    if (some(medium.phase.w > R(0.0)))
        p = mix(p, draine(medium.phase.y, medium.phase.z, cosine), medium.phase.w);
    return p;
}
