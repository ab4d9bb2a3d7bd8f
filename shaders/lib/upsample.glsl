// Results of one evaluation per square of pixels, brought to every pixel (Fogshop sec. 5.4). Needs corners.glsl.

PURE ivec2 reduced_size(ivec2 size, int reduction)
{
    return (size + reduction - 1) / reduction;
}

// The pixel that stands for the square of `reduction` pixels a side.
PURE ivec2 representative(ivec2 texel, int reduction, ivec2 size)
{
    return min(texel * reduction + reduction / 2, size - 1);
}

// The four representatives around a pixel.
struct Corners {
    ivec2 first;
    ivec2 last;     // of all
    vec2 fraction;  // of the pixel between them
};

PURE Corners corners_around(ivec2 pixel, int reduction, ivec2 size)
{
    vec2 position = (vec2(pixel) - vec2(float(reduction / 2))) / float(reduction);
    ivec2 first = ivec2(floor(position));
    return Corners(first, reduced_size(size, reduction) - 1, position - vec2(first));
}

PURE ivec2 corner_texel(IN(Corners) c, int i)
{
    return clamp(c.first + ivec2(i & 1, i >> 1), ivec2(0), c.last);
}

PURE vec4 upsampled(sampler2D reduced, sampler2D distances, int reduction, ivec2 size, ivec2 pixel, float distance)
{
    Corners c = corners_around(pixel, reduction, size);
    vec4 around;
    for (int i = 0; i < 4; ++i)
        around[i] = texelFetch(distances, corner_texel(c, i), 0).x;
    vec4 weights = corner_weights(c.fraction, around, distance);
    vec4 sum = vec4(R(0.0));
    for (int i = 0; i < 4; ++i)
        sum += weights[i] * texelFetch(reduced, corner_texel(c, i), 0);
    return sum;
}
