// Distant light from all around, scattered once (Zhou et al. 2007 eq. 28) or any number of times. Needs radiance.glsl, data.glsl.
//
// The paper's six coefficients of NPSF hold at the optical depth T = 1 only (46 % low at T = .05, 95 % high at 4 for l = 0);
// these are tabulated over T. environment_table: entry k of environment_table_size has its c_0 .. c_3 and c_4, c_5 in texels
// 2 k and 2 k + 1, each times sqrt(4 pi / (2 l + 1)) / (T e^-T), at T = environment_thinnest 2^(k / 4).

const int environment_table_size = 81;
const float environment_thinnest = R(1e-4);  // the ratio is constant below; the last entry is at T = 105

// c_l(T) sqrt(4 pi / (2 l + 1)), l = 0 .. 3 or 4, 5: what convolution by the medium multiplies degree l by.
PURE vec4 environment_factors(sampler2D environment_table, float depth, int upper)
{
    float x = clamp(R(4.0) * log2(max(depth, environment_thinnest) / environment_thinnest), R(0.0),
                    float(environment_table_size - 1));
    int k = min(int(x), environment_table_size - 2);
    vec4 a = data_texel(environment_table, 2 * k + upper);
    vec4 b = data_texel(environment_table, 2 * k + 2 + upper);
    return mix(a, b, x - float(k)) * (depth * exp(-depth));
}

// The environment in a direction, degree by degree. environment: real spherical harmonics in world axes, orthonormal, without the
// Condon-Shortley phase, texel l^2 + l + m for degrees l < order <= 6.
struct Degrees {
    vec3 of[6];
};

PURE Degrees environment_degrees(sampler2D environment, int order, vec3 d)
{
    Degrees degree;
    for (int l = 0; l < 6; ++l)
        degree.of[l] = vec3(R(0.0));
    float diagonal = R(0.282094791774);  // Y_mm = diagonal * Re or Im (x + i y)^m
    float re = R(1.0);
    float im = R(0.0);
    for (int m = 0; m < order; ++m) {
        if (m > 0) {
            diagonal *= sqrt(float(2 * m + 1) / float(2 * m)) * (m == 1 ? R(1.41421356237) : R(1.0));
            float next = re * d.x - im * d.y;
            im = re * d.y + im * d.x;
            re = next;
        }
        float before = R(0.0);
        float value = diagonal;
        for (int l = m; l < order; ++l) {
            if (l > m) {
                float span = float(l * l - m * m);
                float a = sqrt(float(4 * l * l - 1) / span);
                float b = sqrt(float((l - 1) * (l - 1) - m * m) * float(2 * l + 1) / (float(max(2 * l - 3, 1)) * span));
                float next = a * d.z * value - b * before;
                before = value;
                value = next;
            }
            vec4 c = data_texel(environment, l * l + l + m);
            vec3 coefficient = re * vec3(c.x, c.y, c.z);
            if (m > 0) {
                vec4 s = data_texel(environment, l * l + l - m);
                coefficient += im * vec3(s.x, s.y, s.z);
            }
            degree.of[l] += value * coefficient;
        }
    }
    return degree;
}

// Of what has been scattered at least once on its way through this optical depth of scattering, what keeps degree l of the light's
// directions: forward, deviations add up (degree l of the phase function is g^l), and far in, where it arrives from still says a
// little of where it came from: degree 1, fitted to Monte Carlo of a ball of fog about the eye (AirlightEnvironment.BallsOfFog).
PURE float environment_kept(float asymmetry, float scattering, int l)
{
    if (l == 0)
        return R(1.0);
    float moment = R(1.0);
    for (int i = 0; i < l; ++i)
        moment *= asymmetry;
    float tau = min(scattering, R(60.0));
    float kept = moment * exp(-(R(1.0) - moment) * tau) * mean_exponential(moment * tau) / mean_exponential(tau);
    float x = (R(1.0) - asymmetry) * min(scattering, R(1e6));
    if (l == 1)
        kept += x / (R(6.5) + x * (R(0.876) + R(1.456) * x)) * (R(1.0) - max(asymmetry, R(0.0)) * exp(-R(0.5) * x));
    return kept;
}

// The environment as fog of this density integral turns it toward the eye, over scattered_share(): as bright where it is alike all
// around, so that nothing is lost or won. Never negative, as spherical harmonics' ringing would have it.
PURE vec3 environment_around(IN(Medium) medium, IN(Degrees) degree, int order, float density)
{
    vec3 scattering = min(medium.scattering * density, vec3(density_limit));
    vec3 sum = degree.of[0];
    for (int c = 0; c < 3; ++c) {
        for (int l = 1; l < order; ++l)
            sum[c] += degree.of[l][c] * environment_kept(medium.asymmetry, scattering[c], l);
        sum[c] = clamp(sum[c], R(0.0), density_limit);
    }
    return sum;
}

// Airlight of the environment where the density integral to what the pixel shows is `density`, colour by colour, times the
// albedo; or (all_orders) what of it has been scattered any number of times. Never negative, likewise.
PURE vec3 environment_airlight(IN(Medium) medium, IN(Camera) camera, sampler2D environment, sampler2D environment_table,
                               int order, int all_orders, vec3 direction, float density)
{
    Degrees degree = environment_degrees(environment, order, in_world(camera, direction));
    if (all_orders != 0)
        return scattered_share(medium, density) * environment_around(medium, degree, order, density);
    vec3 t = min(optical_depth(medium, density), vec3(density_limit));
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        vec4 low = environment_factors(environment_table, t[c], 0);
        vec4 high = environment_factors(environment_table, t[c], 1);
        for (int l = 0; l < order; ++l)
            sum[c] += degree.of[l][c] * (l < 4 ? low[l] : high[l - 4]);
        sum[c] = clamp(sum[c], R(0.0), density_limit) * (medium.scattering[c] / max(extinction[c], R(1e-30)));
    }
    return sum;
}
