// What arrives of a sun and of a sky within a medium that lies in layers. Needs radiance.glsl.
//
// Two streams of Eddington's kind (Joseph, Wiscombe and Weinman 1976): with E the sun's irradiance across its rays, m the inverse cosine
// of their slant, t the depth below the top and all depths and coefficients those of a medium whose forward peak f goes straight on, S = D + U and F = D - U of the light that comes down and up obey
//   S' = -b F + d E e^(-m t),  F' = -a S + w E e^(-m t),  a = 2 (1 - w),  b = 3/2 (1 - w g),  d = 3/2 w g / m,
// between a sky's D at the top and a ground that gives back its albedo of all that falls on it. No energy is lost: where nothing is
// absorbed F and the sun's own flux keep their sum. f is g^2, or g^2 (1 - (1 - g) low).

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

// The solution for all depths: S = sun q between_decays + top sinh(k (T - t)) / sinh(k T) + bottom sinh(k t) / sinh(k T).
struct SlabStreams {
    float depth;     // T, of all the medium
    float turning;   // 1 - f
    float turned;    // g of what is left
    float slant;     // m
    float w;
    float a;
    float b;
    float d;
    float k;
    float q;
    float fading;    // (1 - e^(-2 k T)) / (2 k T)
    float straight;  // e^(-m T)
    float source;    // of S at the ground
    float top;
    float bottom;
};

// scattering, absorption: optical depths straight down to the ground. sun: 1, and the cosine that its light has to straight down; or 0,
// and all comes from the sky. albedo: the ground's.
PURE SlabStreams slab_streams(float scattering, float absorption, float asymmetry, float low, float sun, float cosine, float albedo)
{
    float g = clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
    // 1 - f and (g - f) / (1 - f), as they do not cancel.
    float less = min(low, R(1.0) / (R(1.0) - g));
    float rest = R(1.0) + g + g * g * less;
    float turning = (R(1.0) - g) * rest;
    float turned = g * (R(1.0) + g * less) / rest;
    float s = min(scattering, slab_depth_limit) * turning;
    float taken = min(absorption, slab_depth_limit);
    float T = s + taken;
    float w = clamp(s / max(T, R(1e-30)), R(0.0), R(1.0));
    float lost = clamp(taken / max(T, R(1e-30)), R(0.0), R(1.0));
    float m = R(1.0) / max(cosine, least_slant);
    float a = R(2.0) * lost;
    float b = R(1.5) * (R(1.0) - w * turned);
    float k = sqrt(a * b);
    float d = R(1.5) * w * turned / m;
    float q = R(1.5) * w * (R(1.0) + turned * lost);
    float fading = mean_exponential(min(R(2.0) * k * T, slab_depth_limit));
    float gone = exp(-k * T);
    float coth = R(0.5) * (R(1.0) + gone * gone) / fading;  // k T coth(k T)
    float csch = gone / fading;                             // k T / sinh(k T)
    float straight = R(0.0);
    float source = R(0.0);
    float slope = R(0.0);
    if (some(sun > R(0.0))) {
        straight = exp(-min(m * T, slab_depth_limit));
        source = sun * q * between_decays(k, m, T);
        slope = sun * q * straight / (m + k) - k * source;
    }
    float first = R(2.0) * b * (R(1.0) - sun) - sun * (d - q / (m + k));
    float second = R(2.0) * albedo * b * sun / m * straight - (R(1.0) - albedo) * b * source -
                   (R(1.0) + albedo) * (slope - sun * d * straight);
    float scale = b * ((R(1.0) - albedo) * T * b + R(2.0) * coth + (R(1.0) + albedo) * a * T);
    float top = (first * ((R(1.0) - albedo) * T * b + (R(1.0) + albedo) * coth) + second * csch) / scale;
    float bottom = ((T * b + coth) * second + (R(1.0) + albedo) * csch * first) / scale;
    return SlabStreams(T, turning, turned, m, w, a, b, d, k, q, fading, straight, source, top, bottom);
}

// Of what surfaces receive of low suns less counts as straight, for a small turn sends it up or down: fitted to Monte Carlo
// (slab_calibration), by which radiance is nearer with all of it.
PURE float low_sun(float cosine)
{
    return R(2.0) * (R(1.0) - clamp(cosine, R(0.0), R(1.0)));
}

// Shallower, the solution takes differences of what it divides by T, and their series serve.
const float thin_slab = R(1e-3);

PURE float down_through_thin(IN(SlabStreams) streams, float t, float sun, float albedo)
{
    float m = streams.slant;
    float down = (R(1.0) - sun) * (R(1.0) - R(0.5) * (streams.a + streams.b) * t) +
                 R(0.5) * (streams.b - streams.a) * albedo * (R(1.0) - sun + sun / m) * t +
                 R(0.5) * sun * (streams.w + streams.d) * one_minus_exp(m * t) / m;
    return max(down, R(0.0));
}

// What comes down onto the ground.
PURE float slab_ground(IN(SlabStreams) streams, float sun, float albedo)
{
    // Of S and what the ground gives back of the sun's own flux and of D.
    float back = albedo * sun / streams.slant * streams.straight;
    float down = max((streams.source + streams.bottom - back) / (R(1.0) + albedo), R(0.0));
    Bool thin = streams.depth < thin_slab;
    if (some(thin))
        down = choose(thin, down_through_thin(streams, streams.depth, sun, albedo), down);
    return down;
}

// How diffuse light of a sun comes onto the ground, of which slab_ground() is all that level ground receives.
struct SlabSide {
    float walls;   // of that, what a wall has of it, all around
    float toward;  // flux along the ground from the sun's side, over the sine of its slant
};

// Thin layers are bright toward the horizon, thick ones above (fitted to Monte Carlo). The flux along the ground is that of two streams,
// X down and Y up, each at the mean cosine of light that runs along the ground, c = 3/8:
//   c X' = -X + w g (X + Y) / 2 + w g e^(-m t) / 2,  and Y likewise upward,
// of which nothing comes in from above, nor from the ground, which gives back alike to all sides.
PURE SlabSide slab_side(IN(SlabStreams) streams)
{
    const float c = R(0.375);
    float walls = R(0.41) + R(0.64) * exp(-R(1.9) * streams.depth);
    float again = streams.w * streams.turned;
    float k = sqrt(R(1.0) - again) / c;
    float m = streams.slant;
    float strength = again / (c * c);
    float source = strength * between_decays(k, m, streams.depth);
    float gone = exp(-k * streams.depth);
    float both = R(1.0) + c * k;
    float less = R(1.0) - c * k;
    float top = c * strength / (m + k);
    float bottom = -source * less - c * strength * streams.straight / (m + k);
    float scale = both * both - gone * gone * less * less;
    return SlabSide(walls, source + (gone * (top * both - gone * less * bottom) + bottom * both - gone * less * top) / scale);
}

// scattering, absorption: optical depths straight down, to the point and to the ground below.
PURE SlabField slab_field(vec2 scattering, vec2 absorption, float asymmetry, float sun, float cosine, float albedo)
{
    SlabStreams streams =
        slab_streams(max(scattering.x, scattering.y), max(absorption.x, absorption.y), asymmetry, R(0.0), sun, cosine, albedo);
    float m = streams.slant;
    float T = streams.depth;
    float t = min(min(scattering.x, slab_depth_limit) * streams.turning + min(absorption.x, slab_depth_limit), T);
    float straight = sun * exp(-min(m * t, slab_depth_limit));
    Bool thin = T < thin_slab;
    SlabField shallow = SlabField(R(0.0), R(0.0), straight);
    if (some(thin)) {
        float down = down_through_thin(streams, t, sun, albedo);
        float ground = down_through_thin(streams, T, sun, albedo) + sun * exp(-m * T) / m;
        float back = albedo * (R(1.0) - sun + sun / m);
        float up = albedo * ground +
                   (T - t) * (R(0.5) * (streams.b - streams.a) * (R(1.0) - sun) - R(0.5) * (streams.a + streams.b) * back) +
                   R(0.5) * (streams.w - streams.d) * straight * one_minus_exp(m * (T - t)) / m;
        shallow = SlabField(down, max(up, R(0.0)), straight);
    }
    if (!some(!thin))
        return shallow;
    float k = streams.k;
    float depth = max(T, thin_slab);
    float above = t / depth;
    float below = R(1.0) - above;
    float fall = exp(-k * t);
    float rise = exp(-k * (T - t));
    float fading = streams.fading;
    float from_top = fall * below * mean_exponential(min(R(2.0) * k * (T - t), slab_depth_limit)) / fading;
    float from_ground = rise * above * mean_exponential(min(R(2.0) * k * t, slab_depth_limit)) / fading;
    float here = sun * streams.q * between_decays(k, m, t);
    float sum = here + streams.top * from_top + streams.bottom * from_ground;
    // k cosh(k x) / sinh(k T), over T.
    float of_top = fall * (R(1.0) + exp(-R(2.0) * min(k * (T - t), slab_depth_limit))) * R(0.5) / (fading * depth);
    float of_ground = rise * (R(1.0) + exp(-R(2.0) * min(k * t, slab_depth_limit))) * R(0.5) / (fading * depth);
    float steep = streams.q * straight / (m + k) - k * here - streams.top * of_top + streams.bottom * of_ground;
    float net = (streams.d * straight - steep) / streams.b;
    return SlabField(choose(thin, shallow.down, max(R(0.5) * (sum + net), R(0.0))),
                     choose(thin, shallow.up, max(R(0.5) * (sum - net), R(0.0))), straight);
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
    return chosen(size > R(1e-15), sum / max(size, R(1e-15)), vec3(R(0.0)));
}

// How a sun stands to the layers: which way is up, and its cosine to that. Where nothing says, they lie across its rays.
struct SunSlant {
    vec3 up;  // camera space
    float cosine;
};

PURE SunSlant sun_slant(IN(Medium) medium, vec3 direction, vec3 point)
{
    vec3 up = thinning_way(medium, point);
    Bool layered = dot(up, up) > R(0.0);
    return SunSlant(chosen(layered, up, -direction), choose(layered, max(-dot(up, direction), least_slant), R(1.0)));
}
