// Results of one evaluation per square of pixels, brought to every pixel (Fogshop sec. 5.4). Needs ray.glsl.

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

// How much each has a say: bilinear, and by how near its distance is to the pixel's, so that a representative of another
// surface has none. If all four are of other surfaces, the one nearest in distance has. Close to a Gaussian of the ratio's
// logarithm, without transcendental functions.
PURE vec4 corner_weights(IN(Corners) c, vec4 distances, float distance)
{
    vec4 weights = vec4(R(0.0));
    int nearest = 0;
    float least = R(1e30);
    float sum = R(0.0);
    for (int i = 0; i < 4; ++i) {
        float apart = abs(distances[i] - distance) / max(distances[i] + distance, R(1e-30));
        float fall = R(1.0) / (R(1.0) + R(300.0) * apart * apart);
        weights[i] = ((i & 1) == 1 ? c.fraction.x : R(1.0) - c.fraction.x) *
                     ((i >> 1) == 1 ? c.fraction.y : R(1.0) - c.fraction.y) * fall * fall * fall * fall;
        sum += weights[i];
        if (apart < least) {
            least = apart;
            nearest = i;
        }
    }
    if (sum > R(1e-3))
        return weights / sum;
    return vec4(nearest == 0 ? R(1.0) : R(0.0), nearest == 1 ? R(1.0) : R(0.0), nearest == 2 ? R(1.0) : R(0.0),
                nearest == 3 ? R(1.0) : R(0.0));
}

PURE vec4 upsampled(sampler2D reduced, sampler2D distances, int reduction, ivec2 size, ivec2 pixel, float distance)
{
    Corners c = corners_around(pixel, reduction, size);
    vec4 around;
    for (int i = 0; i < 4; ++i)
        around[i] = texelFetch(distances, corner_texel(c, i), 0).x;
    vec4 weights = corner_weights(c, around, distance);
    vec4 sum = vec4(R(0.0));
    for (int i = 0; i < 4; ++i)
        sum += weights[i] * texelFetch(reduced, corner_texel(c, i), 0);
    return sum;
}
