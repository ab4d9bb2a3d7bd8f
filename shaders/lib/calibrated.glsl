// The hierarchical filter, kernel `calibrated`: how far light spreads is decided by the pixel that it comes from.
//
// Of a pixel's light, arrived_share() reaches the camera scattered. A table made from Monte Carlo says how much of that
// appears at which angle from the pixel, octave by octave: the share of level k stays there on the way down the pyramid, the
// rest goes on to the coarser levels. A pixel then collects what all levels have at its place, as far as it was scattered in
// front of what the pixel shows. What the medium scatters toward it from where the image has nothing comes from `ambient`.
// The same sums over the shares alone (`coverage`) tell how much that is, so that a uniform image stays as it is (the white
// furnace). Needs radiance.glsl, pyramid.glsl, data.glsl.
//
// At reduced resolution all of it works on squares of pixels, of which one stands for the depth of all (the brightest where
// light leaves, one in the middle where it arrives), but for what stays in a pixel of its own light.

struct Calibrated {
    int top;             // K, the coarsest level
    int step;            // light stays at every step-th level, counted from the coarsest
    int coverage;        // channels that coverage has: 1 in grey media
    int lights;          // those that can be seen and whose scattering another effect adds: once,
    int all_orders;      // or all of it
    int sky;             // 1 where an environment, which `sky` has (sky.glsl), surrounds the image; 0 where the image says what does
    float first_sky;     // log2 of P at its first depth
    float first_place;   // log2 of P at place 0 of the table
    float per_reach;     // 1 / P there
    vec3 detour;         // y / P^1.2 of arrived()
};

// The table: per level spread_places values of the share that stays there to what goes on (level 0: that stays to all; the
// coarsest: 1), over P in steps of half an octave; then visible_places values of visible_share(), over the ratio of P to the
// receiver to P to the source, 0 to 1.
const int spread_places = 32;
const int visible_places = 17;
const int spread_row = 49;

// Light stays at every second level, counted from the coarsest: deviations a factor of 4 apart add up to the cusp and the
// tails of what single Gaussians cannot follow, and cost half as much as all levels.
// (What level 1 would hold is as good as not spread.)
PURE bool collects(IN(Calibrated) f, int level)
{
    return level == f.top || ((f.top - level) % f.step == 0 && level >= f.step);
}

// Luminances of light that is as good as none and as good as infinite.
const float least_light = R(1e-20);
const float most_light = R(1e30);

PURE float staying(sampler2D table, int level, float place)
{
    return data_between(table, level * spread_row, spread_places, place);
}

PURE float visible_share(sampler2D table, int level, float ratio)
{
    return data_between(table, level * spread_row + spread_places, visible_places, ratio * float(visible_places - 1));
}

// P as a place in the table. octaves: log2 of P.
PURE float spread_place(IN(Calibrated) f, float octaves)
{
    return clamp(R(2.0) * (octaves - f.first_place), R(0.0), float(spread_places - 1));
}

// 2^(place / 2).
PURE float reach_of(IN(Calibrated) f, float p)
{
    return clamp(p * f.per_reach, R(1.0), R(46340.95));
}

PURE float octaves_of(float p)
{
    return log2(max(p, R(1e-30)));
}

// The share of a source's light that reaches the camera scattered: T_tot - e^-tau, where T_tot = 1 / (1 + y),
// y = .45 ((1 - g) tau)^1.2, by Monte Carlo, tau that of scattering. share: scattered_share(), which is 1 - e^-tau.
PURE vec3 arrived_share(IN(Medium) medium, IN(Calibrated) f, float p, float octaves, vec3 share)
{
    vec3 y = min(f.detour * exp2(R(1.2) * octaves), vec3(R(1e30)));
    vec3 lost = y / (R(1.0) + y);
    if (medium.absorption != vec3(R(0.0)))
        lost *= exp(-medium.absorption * p);
    // Never quite nothing: where no light arrives, what the image shows there still counts as surroundings.
    return max(share - lost, R(1e-4) * share);
}

// Texels of coverage hold one value for all channels in grey media.
PURE vec3 coverage_of(IN(Calibrated) f, vec4 texel)
{
    return f.coverage == 1 ? vec3(texel.x) : vec3(texel);
}

// What a pixel or texel passes on to coarser levels. Of sources at different P it is the mean of 1 / P that counts, so that the
// near ones decide: what is behind them is lit by all.
struct Spreading {
    vec4 radiance;  // RGB, and its luminance times 2^(-place / 2), which is 1 / P in the table's units
    vec3 coverage;  // the shares by which the radiance was multiplied
};

PURE float spreading_luminance(IN(Medium) medium, vec3 radiance)
{
    return clamp(luminance(medium.luminance, radiance), least_light, most_light);
}

PURE Spreading passed_on(IN(Medium) medium, vec3 radiance, vec3 coverage, float nearness, float share)
{
    vec3 rest = share * radiance;
    return Spreading(vec4(rest, spreading_luminance(medium, rest) * nearness), share * coverage);
}

// The mean of 2^(-place / 2).
PURE float nearness_of(IN(Medium) medium, vec4 radiance)
{
    return clamp(radiance.w / spreading_luminance(medium, vec3(radiance)), R(2e-5), R(1.0));
}

// Level 0. shown: what of the light is not another effect's.
PURE Spreading spreading_source(IN(Medium) medium, IN(Calibrated) f, sampler2D table, float p, vec3 scattered, vec3 color,
                                vec3 shown)
{
    float octaves = octaves_of(p);
    vec3 share = arrived_share(medium, f, p, octaves, scattered);
    float place = spread_place(f, octaves);
    return passed_on(medium, share * shown * finite_or_zero(color), share, R(1.0) / reach_of(f, p),
                     R(1.0) - staying(table, 0, place));
}

// What a texel passes on, by what reached it from the finer level.
PURE Spreading going_on(IN(Medium) medium, IN(Calibrated) f, sampler2D table, vec4 reached, vec4 coverage, int level)
{
    float nearness = nearness_of(medium, reached);
    float share = R(1.0);
    if (level != f.top && collects(f, level))
        share = R(1.0) / (R(1.0) + staying(table, level, -R(2.0) * log2(nearness)));
    return passed_on(medium, vec3(reached), coverage_of(f, coverage), nearness, share);
}

// What stays at a texel, by what it passes on.
PURE Spreading staying_of(IN(Medium) medium, IN(Calibrated) f, sampler2D table, vec4 passed, vec4 coverage, int level)
{
    float nearness = nearness_of(medium, passed);
    float share = R(1.0);
    if (level != f.top)
        share = staying(table, level, -R(2.0) * log2(nearness));
    return passed_on(medium, vec3(passed), coverage_of(f, coverage), nearness, share);
}

// Fourth roots: a lamp counts for little in what the surroundings are taken to be, whose light it adds to by itself. W counts.
PURE vec4 ambient_source(vec3 radiance, vec3 coverage)
{
    float counts = choose(coverage.x + coverage.y + coverage.z > R(1e-30), R(1.0), R(0.0));
    vec3 mean = max(radiance / max(coverage, vec3(R(1e-35))), vec3(R(0.0)));
    return vec4(counts * sqrt(sqrt(min(mean, vec3(most_light)))), counts);
}

// Of the coarsest level, which is a single texel unless the pyramid was told to stop before.
PURE vec3 ambient_radiance(sampler2D stack, IN(Pyramid) pyramid, vec2 pixel)
{
    Region region = level_region(pyramid, pyramid.top);
    vec4 sum = region.size.x * region.size.y == 1 ? texelFetch(stack, ivec2(0, region.row), 0)
                                                  : fetch_linear(stack, region, level_position(pixel, pyramid.top));
    vec3 root = vec3(sum) / max(sum.w, R(1e-30));
    return root * root * root * root;
}

PURE vec3 coverage_at(sampler2D stack, IN(Calibrated) f, IN(Region) region, vec2 position)
{
    if (f.coverage == 1)
        return vec3(fetch_linear_channel(stack, region, position, 0));
    return vec3(fetch_linear(stack, region, position));
}

// What the levels have for a pixel, as far as it is scattered in front of what the pixel shows.
struct Collected {
    vec3 radiance;
    vec3 coverage;
};

// position: in pixels of the pyramid's level 0.
PURE Collected collected(IN(Medium) medium, IN(Calibrated) f, sampler2D table, sampler2D stack, sampler2D coverage_stack,
                         IN(Pyramid) pyramid, vec2 position, float p)
{
    float reach = reach_of(f, p);
    Collected sum = Collected(vec3(R(0.0)), vec3(R(0.0)));
    int row = level_row(pyramid.size, f.top);
    for (int k = f.top; k >= min(f.step, f.top); k -= f.step) {
        Region region = Region(level_size(pyramid.size, k), row);
        for (int finer = k - 1; finer >= max(k - f.step, 1); --finer)
            row -= level_size(pyramid.size, finer).y;
        vec2 at = level_position(position, k);
        vec4 v = fetch_linear(stack, region, at);
        vec3 covered = coverage_at(coverage_stack, f, region, at);
        float ratio = reach * nearness_of(medium, v);
        float visible = choose(ratio < R(1.0), visible_share(table, k, ratio), R(1.0));
        sum.radiance += visible * vec3(v);
        sum.coverage += visible * covered;
    }
    return sum;
}

// All that the medium scatters toward the camera in front of what a pixel shows. share: the pixel's
// scattered_share(). The pixel's own light does not come from the levels. around: what comes from where the image has nothing.
PURE vec3 scattered_light(IN(Medium) medium, IN(Calibrated) f, sampler2D table, float p, vec3 share, vec3 color, vec3 shown,
                          vec3 around, IN(Collected) levels)
{
    float octaves = octaves_of(p);
    vec3 own = staying(table, 0, spread_place(f, octaves)) * arrived_share(medium, f, p, octaves, share);
    vec3 coverage = own + levels.coverage;
    vec3 light = own * shown * finite_or_zero(color) + levels.radiance;
    // Beside a lamp the levels take what lies far behind it for as near as the lamp, and can have more than there is room for.
    // What is too much is as bright as the surroundings; to take it in proportion would take it from the lamp. That is done in
    // front of things so near that there is room for next to nothing, where too much is what lamps behind them shine through.
    vec3 kept = min(share / max(coverage, vec3(R(1e-35))), vec3(R(1.0)));
    vec3 least = kept * light + max(share - coverage, vec3(R(0.0))) * around;
    return least + min(R(32.0) * share, vec3(R(1.0))) * max(light + (share - coverage) * around - least, vec3(R(0.0)));
}
