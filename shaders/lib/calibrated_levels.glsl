// Kernel `calibrated`: the texels of its levels, and its squares of pixels at reduced resolution. Needs calibrated.glsl,
// pyramid.glsl, upsample.glsl.

// What is beyond the picture's edges, where nobody knows: its mirror image at this brightness.
const float beyond_edges = R(0.5);

// A level in its image. Where the picture ends within its last texels, these hold the mean of what they have of it.
struct Level {
    ivec2 size;
    vec2 extent;  // of the picture, in texels
    int row;      // first one
};

// One axis of a texel beyond an edge of the picture, where this is mirrored, so that no light is lost and sizes that are no
// power of two show as much of it as others. Its mirror image may lie between two texels.
struct Tap {
    int first;
    int second;
    float toward;  // the second
    float weight;
};

PURE Tap mirrored_tap(int i, int size, float extent, float beyond)
{
    if (i >= 0 && i < size)
        return Tap(i, i, R(0.0), R(1.0));
    float place = max(i < 0 ? -R(1.0) - float(i) : R(2.0) * extent - R(1.0) - float(i), R(0.0));
    int first = min(int(place), size - 1);
    return Tap(first, min(first + 1, size - 1), place - float(first), beyond);
}

// within: whether the texel is known to lie within the level, as nearly all do.
PURE vec4 level_texel(sampler2D image, IN(Level) level, ivec2 texel, float beyond, bool within)
{
    if (within)
        return texelFetch(image, ivec2(texel.x, texel.y + level.row), 0);
    Tap x = mirrored_tap(texel.x, level.size.x, level.extent.x, beyond);
    Tap y = mirrored_tap(texel.y, level.size.y, level.extent.y, beyond);
    vec4 v = texelFetch(image, ivec2(x.first, y.first + level.row), 0);
    if (x.toward > R(0.0))
        v = mix(v, texelFetch(image, ivec2(x.second, y.first + level.row), 0), x.toward);
    if (y.toward > R(0.0)) {
        vec4 w = texelFetch(image, ivec2(x.first, y.second + level.row), 0);
        if (x.toward > R(0.0))
            w = mix(w, texelFetch(image, ivec2(x.second, y.second + level.row), 0), x.toward);
        v = mix(v, w, y.toward);
    }
    return x.weight * y.weight * v;
}

PURE bool lies_within(IN(Level) level, ivec2 first, ivec2 last)
{
    return first.x >= 0 && first.y >= 0 && last.x < level.size.x && last.y < level.size.y;
}

struct LevelSum {
    vec4 radiance;
    vec4 coverage;
};

PURE LevelSum finer_sum(sampler2D radiance, sampler2D coverage, IN(Level) finer, ivec2 first, bool within)
{
    LevelSum sum = LevelSum(vec4(R(0.0)), vec4(R(0.0)));
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            float weight = kernel_weight(4, i) * kernel_weight(4, j);
            sum.radiance += weight * level_texel(radiance, finer, first + ivec2(i, j), beyond_edges, within);
            sum.coverage += weight * level_texel(coverage, finer, first + ivec2(i, j), beyond_edges, within);
        }
    return sum;
}

// One texel of level `level` from the finer one.
PURE Spreading spreading_texel(IN(Medium) medium, IN(Calibrated) f, sampler2D table, sampler2D radiance, sampler2D coverage,
                               IN(Level) finer, ivec2 texel, int level)
{
    ivec2 first = texel * 2 - 1;
    LevelSum sum;
    if (lies_within(finer, first, first + 3))
        sum = finer_sum(radiance, coverage, finer, first, true);
    else
        sum = finer_sum(radiance, coverage, finer, first, false);
    return going_on(medium, f, table, sum.radiance, sum.coverage, level);
}

// From level 0 for level 1, from the surroundings of the finer level for others.
PURE vec4 ambient_texel(IN(Calibrated) f, sampler2D radiance, sampler2D coverage, sampler2D ambient, IN(Level) finer,
                        ivec2 texel, int level)
{
    vec4 sum = vec4(R(0.0));
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            ivec2 from = texel * 2 + ivec2(i, j);
            if (from.x >= finer.size.x || from.y >= finer.size.y)
                continue;
            from.y += finer.row;
            if (level > 1)
                sum += R(0.25) * texelFetch(ambient, from, 0);
            else
                sum += R(0.25) * ambient_source(vec3(texelFetch(radiance, from, 0)),
                                                coverage_of(f, texelFetch(coverage, from, 0)));
        }
    return sum;
}

// (1 4 6 4 1) / 16 for i from -2 to 2.
PURE float binomial_weight(int i)
{
    return i == 0 ? R(0.375) : abs(i) == 1 ? R(0.25) : R(0.0625);
}

PURE LevelSum smoothed_sum(sampler2D radiance, sampler2D coverage, IN(Level) own, ivec2 texel, bool within)
{
    LevelSum sum = LevelSum(vec4(R(0.0)), vec4(R(0.0)));
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            float weight = binomial_weight(i) * binomial_weight(j);
            sum.radiance += weight * level_texel(radiance, own, texel + ivec2(i, j), beyond_edges, within);
            sum.coverage += weight * level_texel(coverage, own, texel + ivec2(i, j), beyond_edges, within);
        }
    return sum;
}

// What stays at a texel, from what it passes on, smoothed by a 5 x 5 binomial: round, and its bilinear interpolation shows no
// creases.
PURE Spreading stayed(IN(Medium) medium, IN(Calibrated) f, sampler2D table, sampler2D radiance, sampler2D coverage,
                      IN(Level) own, ivec2 texel, int level)
{
    LevelSum sum;
    if (lies_within(own, texel - 2, texel + 2))
        sum = smoothed_sum(radiance, coverage, own, texel, true);
    else
        sum = smoothed_sum(radiance, coverage, own, texel, false);
    return staying_of(medium, f, table, sum.radiance, sum.coverage, level);
}

// A square of pixels, of which the picture may have a part only. Pixels without medium in front (a sky that is kept) have no part in it.
struct Square {
    vec3 color;       // mean
    ivec2 brightest;  // the pixel that the light is taken to come from, so that lamps keep their depth wherever in it they are
    float share;      // of its pixels, that color is of
};

PURE Square square_of(IN(Medium) medium, sampler2D color, sampler2D density, ivec2 texel, int reduction, ivec2 size)
{
    ivec2 first = texel * reduction;
    ivec2 count = min(ivec2(reduction), size - first);
    vec3 sum = vec3(R(0.0));
    ivec2 brightest = first;
    float most = R(-1.0);
    float fogged = R(0.0);
    for (int j = 0; j < count.y; ++j)
        for (int i = 0; i < count.x; ++i) {
            ivec2 at = first + ivec2(i, j);
            if (!(texelFetch(density, at, 0).x > R(0.0)))
                continue;
            vec3 l = finite_or_zero(vec3(texelFetch(color, at, 0)));
            float y = luminance(medium.luminance, l);
            brightest = y > most ? at : brightest;
            most = max(y, most);
            sum += l;
            fogged += R(1.0);
        }
    return Square(sum / max(fogged, R(1.0)), brightest, fogged / float(count.x * count.y));
}

// The same from where it was collected for a pixel of each square. distances: in the fourth channel of the radiance.
PURE Collected upsampled_collected(IN(Calibrated) f, sampler2D radiance, sampler2D coverage, int reduction, ivec2 size,
                                   ivec2 pixel, float distance)
{
    Corners c = corners_around(pixel, reduction, size);
    vec4 around[4];
    vec4 distances;
    for (int i = 0; i < 4; ++i) {
        around[i] = texelFetch(radiance, corner_texel(c, i), 0);
        distances[i] = around[i].w;
    }
    vec4 weights = corner_weights(c.fraction, distances, distance);
    Collected sum = Collected(vec3(R(0.0)), vec3(R(0.0)));
    for (int i = 0; i < 4; ++i) {
        sum.radiance += weights[i] * vec3(around[i]);
        sum.coverage += weights[i] * coverage_of(f, texelFetch(coverage, corner_texel(c, i), 0));
    }
    return sum;
}
