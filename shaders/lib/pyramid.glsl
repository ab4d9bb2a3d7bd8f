// The image pyramid of the hierarchical filter (Iser 2018 sec. 4.2-4.3). Pure index and weight arithmetic.
//
// Level k has ceil(n / 2^k) texels a side and covers the pixels [0, size_k 2^k): texel i of level k lies over texels 2i
// and 2i + 1 of level k - 1 at any size, odd ones included, so nothing drifts; what reaches beyond the image repeats its
// edge. Level 0 has an image of its own; the others share one, stacked downwards.

PURE ivec2 level_size(ivec2 base, int level)
{
    return ivec2(((base.x - 1) >> level) + 1, ((base.y - 1) >> level) + 1);
}

// A level's place in its image; positions are texels of the level, where texel i has its centre at i.
struct Region {
    ivec2 size;
    int row;
};

// First row of a level in the shared image.
PURE int level_row(ivec2 base, int level)
{
    int row = 0;
    for (int k = 1; k < level; ++k)
        row += ((base.y - 1) >> k) + 1;
    return row;
}

// Weight of tap i in [0, n) of the n-tap kernel: the binomials, and for n = 4 the paper's {.13, .37, .37, .13}.
PURE float kernel_weight(int n, int i)
{
    int from_edge = min(i, n - 1 - i);
    if (n == 2)
        return R(0.5);
    if (n == 4)
        return from_edge == 0 ? R(0.13) : R(0.37);
    return from_edge == 0 ? R(0.03125) : (from_edge == 1 ? R(0.15625) : R(0.3125));
}

// k = clamp(log2(W / c), 0, K).
PURE float spread_level(float spread, float c, float top)
{
    return clamp(log2(max(spread / c, R(1e-6))), R(0.0), top);
}

// M[k] = smoothstep(T, (1 + eps) T, W[k-1]), T = c 2^(k-1): keeps light that spreads too little out of level k.
PURE float leak_mask(float spread, float c, float epsilon, int level)
{
    float t = R(0.5) * c * float(1 << level);
    float x = clamp((spread - t) / max(epsilon * t, R(1e-6)), R(0.0), R(1.0));
    return x * x * (R(3.0) - R(2.0) * x);
}

// Uniform cubic B-spline weights of the four samples around fraction f in [0, 1].
PURE vec4 cubic_weights(float f)
{
    float g = R(1.0) - f;
    return vec4(g * g * g, R(4.0) - R(3.0) * f * f * (R(2.0) - f), R(4.0) - R(3.0) * g * g * (R(2.0) - g), f * f * f) /
           R(6.0);
}

// Centre of a base-level pixel in texel coordinates of a level, where texel i has its centre at i.
PURE vec2 level_position(vec2 pixel, int level)
{
    return pixel / float(1 << level) - R(0.5);
}

// smoothstep(edge, edge + width, x) that is a step for width 0.
PURE float soft_step(float edge, float width, float x)
{
    float t = clamp((x - edge) / max(width, R(1e-20)), R(0.0), R(1.0));
    return t * t * (R(3.0) - R(2.0) * t);
}

struct Pyramid {
    ivec2 size;  // of level 0
    int top;
};

PURE Region level_region(IN(Pyramid) pyramid, int level)
{
    return level <= 0 ? Region(pyramid.size, 0) : Region(level_size(pyramid.size, level), level_row(pyramid.size, level));
}

// A tap of the kernel that makes a level from the finer one, whose first row in its image is finer_row.
PURE ivec2 finer_texel(ivec2 texel, int taps, int i, int j, ivec2 finer_size, int finer_row)
{
    ivec2 t = clamp(texel * 2 + ivec2(i, j) - (taps / 2 - 1), ivec2(0), finer_size - 1);
    return ivec2(t.x, t.y + finer_row);
}
