// Kernel `calibrated`: the texels of its levels, and its squares of pixels at reduced resolution. Needs calibrated.glsl,
// pyramid.glsl, upsample.glsl.

// One texel of level `level` from the finer level, whose first row in its images is finer_row.
PURE Spreading spreading_texel(IN(Medium) medium, IN(Calibrated) f, sampler2D table, sampler2D finer, sampler2D finer_coverage,
                               ivec2 finer_size, int finer_row, ivec2 texel, int level)
{
    vec4 sum = vec4(R(0.0));
    vec4 coverage = vec4(R(0.0));
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            ivec2 from = finer_texel(texel, 4, i, j, finer_size, finer_row);
            float weight = kernel_weight(4, i) * kernel_weight(4, j);
            sum += weight * texelFetch(finer, from, 0);
            coverage += weight * texelFetch(finer_coverage, from, 0);
        }
    return going_on(medium, f, table, sum, coverage, level);
}

// From level 0 for level 1, from the surroundings of the finer level for others.
PURE vec4 ambient_texel(IN(Calibrated) f, sampler2D finer, sampler2D finer_coverage, sampler2D finer_ambient, ivec2 finer_size,
                        int finer_row, ivec2 texel, int level)
{
    vec4 sum = vec4(R(0.0));
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            ivec2 from = finer_texel(texel, 2, i, j, finer_size, finer_row);
            if (level > 1) {
                sum += R(0.25) * texelFetch(finer_ambient, from, 0);
            } else {
                sum += R(0.25) * ambient_source(vec3(texelFetch(finer, from, 0)),
                                                coverage_of(f, texelFetch(finer_coverage, from, 0)));
            }
        }
    return sum;
}

// Beyond an edge the level is mirrored, which loses no light.
PURE int mirrored(int i, int size)
{
    return clamp(i < 0 ? -1 - i : i >= size ? 2 * size - 1 - i : i, 0, size - 1);
}

// (1 4 6 4 1) / 16 for i from -2 to 2.
PURE float binomial_weight(int i)
{
    return i == 0 ? R(0.375) : abs(i) == 1 ? R(0.25) : R(0.0625);
}

// What stays at a texel, from what it passes on, smoothed by a 5 x 5 binomial: round, and its bilinear interpolation shows no
// creases.
PURE Spreading stayed(IN(Medium) medium, IN(Calibrated) f, sampler2D table, sampler2D stack, sampler2D coverage_stack, ivec2 size,
                      int row, ivec2 texel, int level)
{
    vec4 sum = vec4(R(0.0));
    vec4 coverage = vec4(R(0.0));
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
            ivec2 t = ivec2(mirrored(texel.x + i, size.x), mirrored(texel.y + j, size.y));
            float weight = binomial_weight(i) * binomial_weight(j);
            sum += weight * texelFetch(stack, ivec2(t.x, t.y + row), 0);
            coverage += weight * texelFetch(coverage_stack, ivec2(t.x, t.y + row), 0);
        }
    return staying_of(medium, f, table, sum, coverage, level);
}

// The light of a square of pixels.
PURE vec3 mean_of_square(sampler2D color, ivec2 texel, int reduction, ivec2 size)
{
    vec3 sum = vec3(R(0.0));
    for (int j = 0; j < reduction; ++j)
        for (int i = 0; i < reduction; ++i)
            sum += finite_or_zero(vec3(texelFetch(color, min(texel * reduction + ivec2(i, j), size - 1), 0)));
    return sum / float(reduction * reduction);
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
