// What surfaces get of light that an isotropic medium scattered once, as published. Needs environment.glsl.
//
// In a homogeneous medium of optical depth T between lamp and surface, what was scattered once arrives from the angle gamma beside
// the lamp as the lamp's light in clear air times (Sun et al. 2005 eq. 12)
//   PSF_T = T e^(-T cos gamma) / (2 pi sin gamma) [F(T sin gamma, pi / 2) - F(T sin gamma, gamma / 2)].
// Where the density varies, T is its integral along the way (Zhou et al. 2007 par. 4.1). Both methods say what a lobe of Phong
// sees of it, (n + 1) / (2 pi) cos^n around an axis; n = 1 around the normal is Lambert's.

const int method_calibrated = 0;
const int method_sun = 1;
const int method_psf = 2;

// Sun et al. par. 4: T (n + 1) / (4 pi^2) G_n(T, theta) over T e^-T, its logarithm to base 2. Depths are two an octave from
// environment_thinnest on, exponents three an octave from 1 on, which is G_0 where the axis is the normal; angles crowd toward the lamp,
// and on either side of pi / 2, where a lobe's horizon passes the lamp.
const int lobe_depths = 41;
const int lobe_angles = 97;
const int lobe_exponents = 40;

// Weights of four values at 0 .. 3 for the cubic through them.
PURE vec4 through_four(float t)
{
    float a = t - R(1.0);
    float b = t - R(2.0);
    float c = t - R(3.0);
    return vec4(-a * b * c / R(6.0), t * b * c / R(2.0), -t * a * c / R(2.0), t * a * b / R(6.0));
}

// cosine: between the lobe's axis and the lamp.
PURE float sun_lobe(sampler2D table, float depth, float exponent, float cosine)
{
    float c = clamp(cosine, R(-1.0), R(1.0));
    // The angle to the nearer of the lamp and what is opposite is pi / 2 sin^2(pi / 2 (place / middle)^(3 / 2)).
    float q = clamp(atan(sqrt((R(1.0) - abs(c)) * (R(1.0) + abs(c))), abs(c)) / (R(0.5) * pi), R(0.0), R(1.0));
    float crowded = atan(sqrt(q), sqrt(R(1.0) - q)) / (R(0.5) * pi);
    float middle = R(0.5) * float(lobe_angles - 1);
    float place = middle * exp2(R(0.666666666667) * log2(max(crowded, R(1e-12))));
    int half_way = (lobe_angles - 1) / 2;
    int first = c < R(0.0) ? half_way : 0;
    float x = c < R(0.0) ? R(2.0) * middle - place : place;
    float t = clamp(R(2.0) * log2(max(depth, environment_thinnest) / environment_thinnest), R(0.0), float(lobe_depths - 1));
    float e = clamp(R(3.0) * log2(max(exponent, R(1.0))), R(0.0), float(lobe_exponents - 1));
    int i = clamp(int(t) - 1, 0, lobe_depths - 4);
    int j = clamp(int(x) - 1, first, first + half_way - 3);
    int k = clamp(int(e) - 1, 0, lobe_exponents - 4);
    vec4 of_depth = through_four(t - float(i));
    vec4 of_angle = through_four(x - float(j));
    vec4 of_exponent = through_four(e - float(k));
    float sum = R(0.0);
    for (int n = 0; n < 4; ++n)
        for (int m = 0; m < 4; ++m) {
            int at = ((k + n) * lobe_angles + j + m) * lobe_depths + i;
            for (int l = 0; l < 4; ++l)
                sum += of_exponent[n] * of_angle[m] * of_depth[l] * data_texel(table, at + l).x;
        }
    return depth * exp(-depth) * exp2(sum);
}

// Degrees 0 to 5 of the lobe, each over that of a delta function of the same energy: 1, (n + 1) / (n + 2), and by turns from there.
PURE float lobe_degree(int degree, float exponent)
{
    float n = exponent;
    float even = R(1.0);
    float odd = (n + R(1.0)) / (n + R(2.0));
    for (int l = 2; l <= degree; ++l) {
        float step = (n - float(l) + R(2.0)) / (n + float(l) + R(1.0));
        if ((l & 1) == 0)
            even *= step;
        else
            odd *= step;
    }
    return (degree & 1) == 0 ? even : odd;
}

// Zhou et al. eq. 25 without the light that comes straight, which pictures have; PSF_T of six degrees. table: the environment's.
PURE float psf_lobe(sampler2D table, float depth, float exponent, float cosine)
{
    vec4 low = environment_factors(table, depth, 0);
    vec4 high = environment_factors(table, depth, 1);
    float x = clamp(cosine, R(-1.0), R(1.0));
    float before = R(0.0);
    float legendre = R(1.0);
    float sum = R(0.0);
    for (int l = 0; l < 6; ++l) {
        float factor = l < 4 ? low[l] : high[l - 4];
        sum += factor * lobe_degree(l, exponent) * legendre * float(2 * l + 1) / (R(4.0) * pi);
        float next = (float(2 * l + 1) * x * legendre - float(l) * before) / float(l + 1);
        before = legendre;
        legendre = next;
    }
    return max(sum, R(0.0));
}

PURE float published_lobe(int method, sampler2D table, float depth, float exponent, float cosine)
{
    if (method == method_psf)
        return psf_lobe(table, depth, exponent, cosine);
    return sun_lobe(table, depth, exponent, cosine);
}

// Eq. 27 without the light that comes straight, of one colour of the environment in the direction of the lobe's axis.
PURE float psf_lobe_of_environment(sampler2D table, IN(Degrees) degree, int order, int colour, float depth, float exponent)
{
    vec4 low = environment_factors(table, depth, 0);
    vec4 high = environment_factors(table, depth, 1);
    float sum = R(0.0);
    for (int l = 0; l < order; ++l)
        sum += degree.of[l][colour] * (l < 4 ? low[l] : high[l - 4]) * lobe_degree(l, exponent);
    return max(sum, R(0.0));
}

// Par. 4.2: mean over all directions of a Gaussian's integral from a point on, for amplitude and scale 1, is sqrt(pi) / 2 times
// Dawson's function of the distance over the distance. In the table after the environment's, at every sixteenth; past them its
// asymptotic series.
const int mean_depths = 97;

PURE float mean_depth_of_gaussian(sampler2D table, float distance)
{
    float u = distance * R(16.0);
    float v = R(0.5) / max(distance * distance, R(1.0));
    if (u < float(mean_depths - 1))
        return data_between(table, 2 * environment_table_size, mean_depths, u);
    return R(0.886226925453) * v * (R(1.0) + v * (R(1.0) + R(3.0) * v));
}

// T-bar of eq. 26 at unit density [m], of Gaussians and of a constant density that ends at the sky's distance; negative where
// density has no end.
PURE float mean_density_around(IN(Medium) medium, IN(Camera) camera, sampler2D table, sampler2D light_gaussians,
                               int gaussian_count, vec3 point)
{
    if (medium.term_count > 0 || (medium.constant > R(0.0) && camera.sky != sky_clamp))
        return R(-1.0);
    float p = medium.constant > R(0.0) ? medium.constant * camera.sky_distance : R(0.0);
    int first = gaussian_count > 0 ? first_gaussian(light_gaussians) : 0;
    for (int i = 0; i < gaussian_count; ++i) {
        Gaussian g = gaussian_at(light_gaussians, first + i);
        float u = min(g.scale * length(point - g.center), R(1e15));
        p += min(g.amplitude / g.scale * mean_depth_of_gaussian(table, u), density_limit);
    }
    return min(p, density_limit);
}
