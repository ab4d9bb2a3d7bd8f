// How much of a pixel's value each of the four around it has, where they were evaluated for squares of pixels.

PURE float apart(float one, float other)
{
    return abs(one - other) / max(one + other, R(1e-30));
}

// Close to a Gaussian of the ratio's logarithm, without transcendental functions.
PURE float alike(float apart)
{
    float fall = R(1.0) / (R(1.0) + R(300.0) * apart * apart);
    return (fall * fall) * (fall * fall);
}

// Bilinear, and by how near each one's distance is to the pixel's, so that a representative of another surface has no say. If
// all four are of other surfaces, the one nearest in distance has.
PURE vec4 corner_weights(vec2 fraction, vec4 distances, float distance)
{
    float x = fraction.x;
    float y = fraction.y;
    vec4 gaps = vec4(apart(distances.x, distance), apart(distances.y, distance), apart(distances.z, distance),
                     apart(distances.w, distance));
    vec4 weights = vec4((R(1.0) - x) * (R(1.0) - y) * alike(gaps.x), x * (R(1.0) - y) * alike(gaps.y),
                        (R(1.0) - x) * y * alike(gaps.z), x * y * alike(gaps.w));
    float sum = weights.x + weights.y + weights.z + weights.w;
    float least = min(min(gaps.x, gaps.y), min(gaps.z, gaps.w));
    float first = choose(gaps.x <= least, R(1.0), R(0.0));
    float second = choose(gaps.y <= least, R(1.0) - first, R(0.0));
    float third = choose(gaps.z <= least, R(1.0) - first - second, R(0.0));
    Bool some = sum > R(1e-3);
    float scale = R(1.0) / max(sum, R(1e-3));
    return vec4(choose(some, weights.x * scale, first), choose(some, weights.y * scale, second),
                choose(some, weights.z * scale, third), choose(some, weights.w * scale, R(1.0) - first - second - third));
}
