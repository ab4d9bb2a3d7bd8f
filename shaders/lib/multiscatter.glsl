// The hierarchical filter, kernel `paper` (Iser 2018 sec. 4, Fig. 4): the body of each of its passes.
// Needs the other files here; the image reads are fetch.glsl's in GLSL and fetch.hpp's in C++.

const int fetch_linear_bilinear = 0;
const int fetch_linear_bicubic = 1;
const int fetch_cubic_bicubic = 2;

struct Filter {
    int top;                // K, the coarsest level
    int fetch;
    int masking;
    int density_blurring;
    int separation;
    int placement;
    float scale;            // c
    float mask_width;       // epsilon
    float bright;           // T_y
    float bright_width;     // epsilon_y
    float dense;            // T_d' [m at unit density]
    float dense_width;      // epsilon_d'
    int lights;             // those that can be seen and whose scattering another effect adds: once,
    int all_orders;         // or all of it
    float separation_level; // k_ssc
};

// ---- sec. 4.1

// The width of a pixel that knows where along the ray the medium lies. texel: of product "density"; of_gaussians: their part of
// P's moment.
PURE Pixel placed_pixel(Pixel p, IN(Medium) medium, IN(Camera) camera, IN(Filter) f, vec2 pixel, vec2 texel, float of_gaussians)
{
    if (f.placement != 0 && texel.y >= R(0.0)) {
        vec3 through = ray_through(camera, pixel);
        p.spread *= placement(density_moment(medium, through / length(through), texel.y) + of_gaussians, p.density);
    }
    return p;
}

struct Sources {
    vec4 spread;     // L_sc, W
    vec4 separated;  // L_ssc, W
};

// L_sc and, of bright pixels in thin fog, L_ssc (sec. 4.3, radiance separation). W stops where the coarsest level does:
// the sky's, which has no bound, would drown that of everything near the horizon once it is blurred.
PURE Sources scattered_sources(IN(Medium) medium, IN(Filter) f, IN(Pixel) pixel, vec3 color)
{
    vec3 l = finite_or_zero(color);
    float m = R(0.0);
    if (f.separation != 0)
        m = soft_step(f.bright, f.bright_width, luminance(medium.luminance, l)) *
            (R(1.0) - soft_step(f.dense - f.dense_width, f.dense_width, pixel.density));
    vec3 sc = pixel.share * l;
    float w = min(pixel.spread, f.scale * float(1 << f.top));
    return Sources(vec4(sc * (R(1.0) - m), w), vec4(sc * m, w));
}

// ---- sec. 4.2-4.3: one texel of level `level` from the finer level, whose first row in its image is finer_row

// (M[k] L[k-1]) * G, and the luminance-weighted mean of W over the same support. Black regions take the plain mean.
PURE vec4 downsampled_radiance(sampler2D finer, ivec2 finer_size, int finer_row, ivec2 texel, int level, int taps, int masking,
                          IN(Filter) f, vec3 weights)
{
    vec3 sum = vec3(R(0.0));
    float y_sum = R(0.0);
    float yw_sum = R(0.0);
    for (int j = 0; j < taps; ++j) {
        for (int i = 0; i < taps; ++i) {
            vec4 t = texelFetch(finer, finer_texel(texel, taps, i, j, finer_size, finer_row), 0);
            float g = kernel_weight(taps, i) * kernel_weight(taps, j);
            float y = clamp(luminance(weights, vec3(t)), R(1e-20), R(1e30));
            y_sum += y;
            yw_sum += y * t.w;
            sum += vec3(t) * (masking != 0 ? g * leak_mask(t.w, f.scale, f.mask_width, level) : g);
        }
    }
    return vec4(sum, yw_sum / y_sum);
}

// W[k-1] * G, of the channel that holds W.
PURE float downsampled_spread(sampler2D finer, ivec2 finer_size, int finer_row, ivec2 texel, int taps, int channel)
{
    float sum = R(0.0);
    for (int j = 0; j < taps; ++j)
        for (int i = 0; i < taps; ++i)
            sum += kernel_weight(taps, i) * kernel_weight(taps, j) *
                   texelFetch(finer, finer_texel(texel, taps, i, j, finer_size, finer_row), 0)[channel];
    return sum;
}

// ---- sec. 4.2, 5: fetching at a pixel and a fractional level

// One level, of which level 0 is in `base`. Coarser than K is K.
PURE vec4 fetch_level(sampler2D base, sampler2D stack, IN(Pyramid) pyramid, int level, vec2 pixel, int mode)
{
    int k = clamp(level, 0, pyramid.top);
    Region region = level_region(pyramid, k);
    vec2 position = level_position(pixel, k);
    if (mode == fetch_linear_bilinear)
        return k == 0 ? fetch_linear(base, region, position) : fetch_linear(stack, region, position);
    return k == 0 ? fetch_bicubic(base, region, position) : fetch_bicubic(stack, region, position);
}

// The same of W blurred: level 0 is the fourth channel of the radiance, the others are an image of one channel.
PURE float fetch_spread_level(sampler2D base, sampler2D stack, IN(Pyramid) pyramid, int level, vec2 pixel, int mode)
{
    int k = clamp(level, 0, pyramid.top);
    Region region = level_region(pyramid, k);
    vec2 position = level_position(pixel, k);
    if (mode == fetch_linear_bilinear)
        return k == 0 ? fetch_linear_channel(base, region, position, 3) : fetch_linear_channel(stack, region, position, 0);
    return k == 0 ? fetch_bicubic_channel(base, region, position, 3) : fetch_bicubic_channel(stack, region, position, 0);
}

// Weights of the levels floor(k) - 1 to floor(k) + 2 for a fraction f between floor(k) and the next.
PURE vec4 level_weights(int mode, float f)
{
    return mode == fetch_cubic_bicubic ? cubic_weights(f) : vec4(R(0.0), R(1.0) - f, f, R(0.0));
}

// L[k] at a pixel, k in [0, K] fractional.
PURE vec4 fetch_pyramid(sampler2D base, sampler2D stack, IN(Pyramid) pyramid, int mode, vec2 pixel, float level)
{
    int below = int(level);
    vec4 weights = level_weights(mode, level - float(below));
    vec4 sum = vec4(R(0.0));
    for (int i = 0; i < 4; ++i)
        if (weights[i] > R(0.0))
            sum += weights[i] * fetch_level(base, stack, pyramid, below - 1 + i, pixel, mode);
    return sum;
}

PURE float fetch_spread(sampler2D base, sampler2D stack, IN(Pyramid) pyramid, int mode, vec2 pixel, float level)
{
    int below = int(level);
    vec4 weights = level_weights(mode, level - float(below));
    float sum = R(0.0);
    for (int i = 0; i < 4; ++i)
        if (weights[i] > R(0.0))
            sum += weights[i] * fetch_spread_level(base, stack, pyramid, below - 1 + i, pixel, mode);
    return sum;
}

// L'_sc + L'_ssc at one pixel. The level comes from W, blurred once more at the level that W itself asks for (sec. 4.3,
// "Blurring"; the paper blurs P and takes W of that, but P has no bound in a sky). The level of the separated light comes
// from the luminance-weighted W at the fixed level k_ssc.
PURE vec3 gathered(sampler2D radiance, sampler2D radiance_stack, sampler2D spread_stack, sampler2D separated,
              sampler2D separated_stack, IN(Pyramid) pyramid, IN(Filter) f, vec2 pixel, float spread)
{
    float top = float(pyramid.top);
    float level = spread_level(spread, f.scale, top);
    if (f.density_blurring != 0)
        level = spread_level(fetch_spread(radiance, spread_stack, pyramid, f.fetch, pixel, level), f.scale, top);
    vec3 sum = vec3(fetch_pyramid(radiance, radiance_stack, pyramid, f.fetch, pixel, level));
    if (f.separation != 0) {
        float w = fetch_pyramid(separated, separated_stack, pyramid, f.fetch, pixel, f.separation_level).w;
        float l = spread_level(w, f.scale, top);
        sum += vec3(fetch_pyramid(separated, separated_stack, pyramid, f.fetch, pixel, l));
    }
    return sum;
}
