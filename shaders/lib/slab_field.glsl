// What arrives of a sun and of a sky within a medium that lies in layers. Needs radiance.glsl.
//
// Two streams of Eddington's kind (Joseph, Wiscombe and Weinman 1976): with E the sun's irradiance across its rays, m the inverse cosine
// of their slant, t the depth below the top and all depths and coefficients those of a medium whose forward peak, g^2 of what it
// scatters, goes straight on, S = D + U and F = D - U of the light that comes down and up obey
//   S' = -b F + d E e^(-m t),  F' = -a S + w E e^(-m t),  a = 2 (1 - w),  b = 3/2 (1 - w g),  d = 3/2 w g / m,
// between a sky's D at the top and a ground that gives back its albedo of all that falls on it. No energy is lost: where nothing is
// absorbed F and the sun's own flux keep their sum.

// Over the light's irradiance: of a sun, across its rays; of a sky, on level ground in clear air.
struct SlabField {
    float down;      // diffuse light onto level ground
    float up;
    float straight;  // of the sun, what comes its way, the forward peak with it
};

const float slab_depth_limit = R(1e9);
const float least_slant = R(0.02);

// (e^(-k t) - e^(-m t)) / (m^2 - k^2), without a pole where they are equal.
PURE float between_decays(float k, float m, float t)
{
    return t * exp(-min(k, m) * t) * mean_exponential(min(abs(m - k) * t, slab_depth_limit)) / (m + k);
}

// scattering, absorption: optical depths straight down, to the point and to the ground below. sun: 1, and the cosine that its light has
// to straight down; or 0, and all comes from the sky. albedo: the ground's.
PURE SlabField slab_field(vec2 scattering, vec2 absorption, float asymmetry, float sun, float cosine, float albedo)
{
    float g = clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
    float peak = g * g;
    vec2 s = min(scattering, vec2(slab_depth_limit)) * (R(1.0) - peak);
    vec2 all = s + min(absorption, vec2(slab_depth_limit));
    float t = all.x;
    float T = max(all.y, all.x);
    float m = R(1.0) / max(cosine, least_slant);
    float straight = sun * exp(-min(m * t, slab_depth_limit));
    if (!(T > R(1e-9)))
        return SlabField(R(1.0) - sun, albedo * (R(1.0) - sun + sun / m), straight);
    float w = clamp(s.y / all.y, R(0.0), R(1.0));
    float turned = g >= R(0.0) ? g / (R(1.0) + g) : (g - peak) / (R(1.0) - peak);
    float lost = clamp(min(absorption.y, slab_depth_limit) / all.y, R(0.0), R(1.0));
    float a = R(2.0) * lost;
    float b = R(1.5) * (R(1.0) - w * turned);
    float k = sqrt(a * b);
    float d = R(1.5) * w * turned / m;
    if (T < R(1e-3)) {
        // The general solution takes differences of what it divides by T.
        float same = R(0.5) * (a + b);
        float other = R(0.5) * (b - a);
        float back = albedo * (R(1.0) - sun + sun / m);
        float down = (R(1.0) - sun) * (R(1.0) - same * t) + other * back * t +
                     R(0.5) * sun * (w + d) * one_minus_exp(m * t) / m;
        float ground = (R(1.0) - sun) * (R(1.0) - same * T) + other * back * T +
                       R(0.5) * sun * (w + d) * one_minus_exp(m * T) / m + sun * exp(-m * T) / m;
        float up = albedo * ground + (T - t) * (other * (R(1.0) - sun) - same * back) +
                   R(0.5) * (w - d) * straight * one_minus_exp(m * (T - t)) / m;
        return SlabField(down, max(up, R(0.0)), straight);
    }
    float q = R(1.5) * w * (R(1.0) + turned * lost);
    // S = sun q between_decays + top sinh(k (T - t)) / sinh(k T) + bottom sinh(k t) / sinh(k T).
    float twice = mean_exponential(min(R(2.0) * k * T, slab_depth_limit));
    float gone = exp(-k * T);
    float coth = R(0.5) * (R(1.0) + gone * gone) / twice;  // k T coth(k T)
    float csch = gone / twice;                             // k T / sinh(k T)
    float at_ground = exp(-min(m * T, slab_depth_limit));
    float source = sun * q * between_decays(k, m, T);
    float slope = sun * q * at_ground / (m + k) - k * source;
    float first = R(2.0) * b * (R(1.0) - sun) - sun * (d - q / (m + k));
    float second = R(2.0) * albedo * b * sun / m * at_ground - (R(1.0) - albedo) * b * source -
                   (R(1.0) + albedo) * (slope - sun * d * at_ground);
    float scale = b * ((R(1.0) - albedo) * T * b + R(2.0) * coth + (R(1.0) + albedo) * a * T);
    float top = (first * ((R(1.0) - albedo) * T * b + (R(1.0) + albedo) * coth) + second * csch) / scale;
    float bottom = ((T * b + coth) * second + (R(1.0) + albedo) * csch * first) / scale;
    float above = t / T;
    float below = R(1.0) - above;
    float fall = exp(-k * t);
    float rise = exp(-k * (T - t));
    float from_top = fall * below * mean_exponential(min(R(2.0) * k * (T - t), slab_depth_limit)) / twice;
    float from_ground = rise * above * mean_exponential(min(R(2.0) * k * t, slab_depth_limit)) / twice;
    float here = sun * q * between_decays(k, m, t);
    float sum = here + top * from_top + bottom * from_ground;
    // k cosh(k x) / sinh(k T), over T.
    float of_top = fall * (R(1.0) + exp(-R(2.0) * min(k * (T - t), slab_depth_limit))) * R(0.5) / (twice * T);
    float of_ground = rise * (R(1.0) + exp(-R(2.0) * min(k * t, slab_depth_limit))) * R(0.5) / (twice * T);
    float steep = q * straight / (m + k) - k * here - top * of_top + bottom * of_ground;
    float net = (d * straight - steep) / b;
    return SlabField(max(R(0.5) * (sum + net), R(0.0)), max(R(0.5) * (sum - net), R(0.0)), straight);
}

// Of the sun's light that has been scattered before, what one more scattering turns toward an eye, per sigma_s and steradian: the two
// streams' part by their first moment, and of the forward peak what is not `straight`, e^(-sigma_t t), by g^1.5. turned: cosine of the
// eye's ray to the way to the sun; up: to the way up.
PURE float slab_source(IN(SlabField) field, float asymmetry, float straight, float turned, float up)
{
    float even = R(2.0) * (field.down + field.up) + R(3.0) * asymmetry * (field.down - field.up) * up;
    return max(even, R(0.0)) / (R(4.0) * pi) +
           max(field.straight - straight, R(0.0)) * henyey_greenstein(asymmetry * sqrt(abs(asymmetry)), turned);
}

// The way on which the constant and exponential terms thin out fastest, unit; 0 where none does.
PURE vec3 thinning_way(IN(Medium) medium, vec3 point)
{
    float most = -density_limit;
    for (int i = 0; i < medium.term_count; ++i)
        most = max(most, moved_term(medium.terms[i], point).w);
    vec3 sum = vec3(R(0.0));
    for (int i = 0; i < medium.term_count; ++i) {
        vec4 term = moved_term(medium.terms[i], point);
        sum += exp(term.w - most) * vec3(term.x, term.y, term.z);
    }
    float size = length(sum);
    return size > R(1e-15) ? sum / size : vec3(R(0.0));
}

// How a sun stands to the layers: which way is up, and its cosine to that. Where nothing says, they lie across its rays.
struct SunSlant {
    vec3 up;  // camera space
    float cosine;
};

PURE SunSlant sun_slant(IN(Medium) medium, vec3 direction, vec3 point)
{
    vec3 up = thinning_way(medium, point);
    if (up == vec3(R(0.0)))
        return SunSlant(-direction, R(1.0));
    return SunSlant(up, max(-dot(up, direction), least_slant));
}
