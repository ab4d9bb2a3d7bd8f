// Gaussian density terms and their integrals along rays (Zhou et al. 2007 eq. 7 and 31). Needs data.glsl, density.glsl,
// erf.glsl.

struct Gaussian {
    vec3 center;      // camera space [m]
    float scale;      // a [1/m]; the radius is 1/a
    float amplitude;  // c
    vec3 color;       // share of what it scatters that is not absorbed after all
};

PURE Gaussian gaussian_at(sampler2D gaussians, int i)
{
    vec4 a = data_texel(gaussians, 2 * i);
    vec4 b = data_texel(gaussians, 2 * i + 1);
    return Gaussian(vec3(a.x, a.y, a.z), a.w, b.x, vec3(b.y, b.z, b.w));
}

// Arguments beyond are as good as infinite; their squares are finite in 32 bits.
const float gaussian_limit = R(1e15);

// e^(x^2) (1 - erf x) for x >= 0: neither under- nor overflows. 4e-9 relative.
PURE float scaled_erfc(float x)
{
    float y = min(x, gaussian_limit);
    float s = (y - R(3.0)) / (y + R(3.0));
    float p = -R(9.24032345205e-5) + s * R(7.70762823319e-5);
    p = R(0.00187472843918) + s * (-R(0.000725842402489) + s * p);
    p = -R(0.0237632743399) + s * (R(0.00249854596591) + s * p);
    p = -R(0.119275380861) + s * (R(0.0683167949398) + s * p);
    p = -R(0.0475621441475) + s * (R(0.129644079112) + s * p);
    p = R(1.25300805613) + s * (-R(0.135621068005) + s * p);
    return p / (R(1.0) + R(2.0) * y);
}

// int_a^(a+width) e^(-x^2) dx, to a few 1e-7 of itself wherever the ends lie: a difference of two erf loses all digits on
// the flanks and for narrow intervals.
PURE float gaussian_area(float a, float width)
{
    float from = clamp(a, -gaussian_limit, gaussian_limit);
    float to = clamp(a + width, -gaussian_limit, gaussian_limit);
    float w = R(0.5) * min(width, gaussian_limit);
    float c = from + w;
    Bool narrow = w * max(abs(c), R(1.0)) < R(0.25);
    float area = R(0.0);
    if (some(narrow)) {
        float w2 = w * w;
        float y = c * c * w2;
        float s = R(1.0) + (R(2.0) * y - w2) / R(3.0) + (R(4.0) * y * y - R(12.0) * y * w2 + R(3.0) * w2 * w2) / R(30.0) +
                  (R(8.0) * y * y * y - R(60.0) * y * y * w2 + R(90.0) * y * w2 * w2 - R(15.0) * w2 * w2 * w2) / R(630.0);
        area = R(2.0) * w * exp(-c * c) * s;
    }
    if (some(!narrow)) {
        // Not |c| -+ w: of a long interval the middle forgets where it begins.
        float least = min(abs(from), abs(to));
        float nearer = choose(from * to < R(0.0), -least, least);
        float farther = max(abs(from), abs(to));
        Bool flank = nearer > R(0.5);
        const float half_root_pi = R(0.886226925453);
        float wide = R(0.0);
        if (some(flank))
            wide = half_root_pi * (scaled_erfc(nearer) * exp(-nearer * nearer) - scaled_erfc(farther) * exp(-farther * farther));
        if (some(!flank))
            wide = choose(flank, wide, half_root_pi * (erf(farther) - erf(nearer)));
        area = choose(narrow, area, wide);
    }
    return area;
}

// A Gaussian's density along a ray: peak exp(-(a (t - middle))^2).
struct Profile {
    float peak;
    float scale;   // a
    float middle;  // where on the ray its centre projects
};

// The distance of the centre from the ray by a cross product: sqrt(|b|^2 - m^2) cancels.
PURE Profile profile_along(IN(Gaussian) g, vec3 origin, vec3 direction)
{
    vec3 b = g.center - origin;
    float x = min(g.scale * length(cross(direction, b)), gaussian_limit);
    // So that an integral over it stays below density_limit, and is not infinity times nothing.
    float most = min(g.amplitude, density_limit * min(g.scale, R(1.0)));
    return Profile(most * exp(-x * x), g.scale, dot(b, direction));
}

PURE float profile_density(IN(Profile) p, float t)
{
    float x = min(p.scale * abs(t - p.middle), gaussian_limit);
    return p.peak * exp(-x * x);
}

// peak / a, bounded so that it may be multiplied by nothing.
PURE float profile_length(IN(Profile) p)
{
    return min(p.peak / p.scale, density_limit);
}

PURE float profile_integral(IN(Profile) p, float from, float to)
{
    return min(profile_length(p) * gaussian_area(p.scale * (from - p.middle), p.scale * (to - from)), density_limit);
}

// The same to 4e-7 of the whole line's integral, which is what an exponent needs, and cheaper.
PURE float profile_depth(IN(Profile) p, float from, float to)
{
    if (!some(p.peak > R(0.0)))
        return R(0.0);
    float sum = erf(p.scale * (to - p.middle)) - erf(p.scale * (from - p.middle));
    return min(R(0.886226925453) * profile_length(p) * max(sum, R(0.0)), density_limit);
}

// int rho dt [m at unit density] over [from, to] (eq. 31), in [0, density_limit]. `to` may be far_away.
PURE float gaussian_integral(IN(Gaussian) g, vec3 origin, vec3 direction, float from, float to)
{
    return profile_integral(profile_along(g, origin, direction), from, to);
}

// int_0^D rho dt and int_0^D rho (1 - t/D)^2 dt, from the camera. The latter's terms cancel on the flanks: there it is good
// to 1e-4 of the former only.
PURE vec2 profile_density_moment(IN(Profile) p, float distance)
{
    float a = clamp(-p.scale * p.middle, -gaussian_limit, gaussian_limit);
    float width = p.scale * distance;
    // Cut off at both ends alike, so that what is before the middle of a long way stays before it.
    width = choose(width >= gaussian_limit || abs(a) >= gaussian_limit,
                   clamp(p.scale * (distance - p.middle), -gaussian_limit, gaussian_limit) - a, width);
    width = max(width, R(1e-30));
    float area = gaussian_area(a, width);
    float b = a + width;
    Bool short_way = width * max(abs(a), R(1.0)) < R(0.5);
    float moment = R(0.0);
    if (some(short_way)) {
        // Simpson-like by Gauss-Legendre: the integrand is nearly a parabola.
        float h = R(0.387298334621);  // sqrt(3/5) / 2
        float l = a + width * (R(0.5) - h);
        float m = a + width * R(0.5);
        float r = a + width * (R(0.5) + h);
        moment = width * (R(5.0) * (R(0.5) + h) * (R(0.5) + h) * exp(-l * l) + R(2.0) * exp(-m * m) +
                          R(5.0) * (R(0.5) - h) * (R(0.5) - h) * exp(-r * r)) / R(18.0);
    }
    if (some(!short_way)) {
        float s = b / width;
        float of_long = (R(0.5) / width / width + s * s) * area + R(0.5) * s / width * exp(-b * b) -
                        (s - R(0.5) * a / width) / width * exp(-a * a);
        moment = choose(short_way, moment, choose(area > R(1e-30), of_long, R(0.0)));
    }
    float scale = profile_length(p);
    return vec2(min(scale * area, density_limit), min(scale * clamp(moment, R(0.0), area), density_limit));
}

PURE vec2 gaussian_density_moment(IN(Gaussian) g, vec3 direction, float distance)
{
    return profile_density_moment(profile_along(g, vec3(R(0.0)), direction), distance);
}
