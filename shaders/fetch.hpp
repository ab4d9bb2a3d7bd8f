// Image reads over plain memory, the C++ counterpart of lib/fetch.glsl; included once per precision by maths_types.inc.

// An image of 1 or 4 channels.
struct Texture {
    const real *data = nullptr;
    int64_t row_stride = 0;  // in reals
    int width = 0;
    int height = 0;
    int channels = 4;
};

using sampler2D = const Texture &;

PURE const real *texel_at(sampler2D image, int x, int y)
{
    return image.data + y * image.row_stride + int64_t(x) * image.channels;
}

PURE vec4 four(const real *p)
{
    return vec4(p[0], p[1], p[2], p[3]);
}

PURE vec4 texelFetch(sampler2D image, ivec2 texel, int /*lod*/)
{
    const real *p = texel_at(image, texel.x, texel.y);
    return image.channels == 4 ? four(p) : vec4(p[0], real(0), real(0), real(1));
}

// Calls sum(weight, texel) for the n x n texels around a position, whose first is at `first`, with its edge repeated.
template <int n, class Weights, class Sum>
PURE void weighted_texels(sampler2D image, Region region, ivec2 first, Weights wx, Weights wy, Sum sum)
{
    int64_t columns[n];
    for (int i = 0; i < n; ++i)
        columns[i] = int64_t(clamp(first.x + i, 0, region.size.x - 1)) * image.channels;
    for (int j = 0; j < n; ++j) {
        const real *row = image.data + (clamp(first.y + j, 0, region.size.y - 1) + region.row) * image.row_stride;
        for (int i = 0; i < n; ++i)
            sum(wx[i] * wy[j], row + columns[i]);
    }
}

template <class Sum> PURE void linear_texels(sampler2D image, Region region, vec2 position, Sum sum)
{
    vec2 origin = floor(position), f = position - origin;
    weighted_texels<2>(image, region, ivec2(origin), vec2(real(1) - f.x, f.x), vec2(real(1) - f.y, f.y), sum);
}

template <class Sum> PURE void bicubic_texels(sampler2D image, Region region, vec2 position, Sum sum)
{
    vec2 origin = floor(position), f = position - origin;
    weighted_texels<4>(image, region, ivec2(origin) - 1, cubic_weights(f.x), cubic_weights(f.y), sum);
}

PURE vec4 fetch_linear(sampler2D image, Region region, vec2 position)
{
    vec4 result(real(0));
    linear_texels(image, region, position, [&](real w, const real *p) { result += w * four(p); });
    return result;
}

PURE vec4 fetch_bicubic(sampler2D image, Region region, vec2 position)
{
    vec4 result(real(0));
    bicubic_texels(image, region, position, [&](real w, const real *p) { result += w * four(p); });
    return result;
}

PURE real fetch_linear_channel(sampler2D image, Region region, vec2 position, int channel)
{
    real result(0);
    linear_texels(image, region, position, [&](real w, const real *p) { result += w * p[channel]; });
    return result;
}

PURE real fetch_bicubic_channel(sampler2D image, Region region, vec2 position, int channel)
{
    real result(0);
    bicubic_texels(image, region, position, [&](real w, const real *p) { result += w * p[channel]; });
    return result;
}
