// Image reads over plain memory, the C++ counterpart of lib/fetch.glsl; included once per precision by maths_types.inc.

// An image of 1, 2 or 4 channels.
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
    if (image.channels == 4)
        return four(p);
    return vec4(p[0], image.channels == 2 ? p[1] : real(0), real(0), real(1));
}

PURE ivec2 textureSize(sampler2D image, int /*lod*/)
{
    return ivec2(image.width, image.height);
}

// Four channels that the compiler keeps in one register, where it takes glm's vec4 apart; by reference throughout, since
// the double one has no calling convention without AVX.
using Four = real __attribute__((vector_size(4 * sizeof(real))));

struct AllChannels {
    using Value = Four;
    PURE void add(Four &sum, const real *texel, real weight) const
    {
        Four v;
        __builtin_memcpy(&v, texel, sizeof v);
        sum += v * weight;
    }
};

struct OneChannel {
    using Value = real;
    int channel;
    PURE void add(real &sum, const real *texel, real weight) const { sum += texel[channel] * weight; }
};

// Sums weight times texel over the n x n texels around a position, of which the first is at `first`; the edge repeats.
template <int n, class Weights, class Channels>
PURE void weighted_texels(sampler2D image, IN(Region) region, ivec2 first, const Weights &wx, const Weights &wy,
                          const Channels &channels, typename Channels::Value &sum)
{
    int64_t columns[n];
    for (int i = 0; i < n; ++i)
        columns[i] = int64_t(clamp(first.x + i, 0, region.size.x - 1)) * image.channels;
    for (int j = 0; j < n; ++j) {
        const real *row = image.data + (clamp(first.y + j, 0, region.size.y - 1) + region.row) * image.row_stride;
        typename Channels::Value across{};
        for (int i = 0; i < n; ++i)
            channels.add(across, row + columns[i], wx[i]);
        sum += across * wy[j];
    }
}

// floor() of positions above -1, which all are, without the call it is before SSE 4.1.
PURE ivec2 texel_below(vec2 position)
{
    return ivec2(position + real(1)) - 1;
}

template <class Channels>
PURE void linear_texels(sampler2D image, IN(Region) region, vec2 position, const Channels &channels,
                        typename Channels::Value &sum)
{
    ivec2 origin = texel_below(position);
    vec2 f = position - vec2(origin);
    weighted_texels<2>(image, region, origin, vec2(real(1) - f.x, f.x), vec2(real(1) - f.y, f.y), channels, sum);
}

template <class Channels>
PURE void bicubic_texels(sampler2D image, IN(Region) region, vec2 position, const Channels &channels,
                         typename Channels::Value &sum)
{
    ivec2 origin = texel_below(position);
    vec2 f = position - vec2(origin);
    weighted_texels<4>(image, region, origin - 1, cubic_weights(f.x), cubic_weights(f.y), channels, sum);
}

PURE vec4 fetch_linear(sampler2D image, IN(Region) region, vec2 position)
{
    Four v{};
    linear_texels(image, region, position, AllChannels{}, v);
    return vec4(v[0], v[1], v[2], v[3]);
}

PURE vec4 fetch_bicubic(sampler2D image, IN(Region) region, vec2 position)
{
    Four v{};
    bicubic_texels(image, region, position, AllChannels{}, v);
    return vec4(v[0], v[1], v[2], v[3]);
}

PURE real fetch_linear_channel(sampler2D image, IN(Region) region, vec2 position, int channel)
{
    real v{};
    linear_texels(image, region, position, OneChannel{channel}, v);
    return v;
}

PURE real fetch_bicubic_channel(sampler2D image, IN(Region) region, vec2 position, int channel)
{
    real v{};
    bicubic_texels(image, region, position, OneChannel{channel}, v);
    return v;
}

// lib/grid_fetch.glsl.
PURE vec4 grid_fetch(sampler2D image, ivec2 corner, ivec2 size, vec2 position)
{
    Texture part = image;
    part.data = texel_at(image, corner.x, corner.y);
    return fetch_linear(part, Region{size, 0}, clamp(position, vec2(real(0)), vec2(size - 1)));
}

PURE vec4 grid_fetch_agreed(sampler2D image, ivec2 corner, ivec2 size, vec2 position, real otherwise)
{
    vec4 v = grid_fetch(image, corner, size, position);
    const ivec2 first = texel_below(clamp(position, vec2(real(0)), vec2(size - 1)));
    auto around = [&](int i, int j) {
        const ivec2 texel = corner + min(first + ivec2(i, j), size - 1);
        return texel_at(image, texel.x, texel.y)[3];
    };
    v.w = around(0, 0);
    if (around(1, 0) != v.w || around(0, 1) != v.w || around(1, 1) != v.w)
        v.w = otherwise;
    return v;
}
