// What lights' light that has been scattered before scatters toward the camera, from a grid over the view. Needs airlight_orders.glsl,
// grid_settings.glsl, grid_fetch.glsl; in C++ scattered/maths.h.
//
// Beyond the first order light is smooth but for its peaks of 1 / d at lamps in the medium. So the grid has its ratio to
// W = w_0 + sum_l w_l / d_l, which is smooth there too, and along a ray W is integrated in closed form. Its points lie on the corners of
// squares of `cell` pixels, at distances from the camera that all rays share:
//   distances  data: texel k has the distance k, the first is 0, and of tier `maps` the slice before it and its place between that and
//              the next; texel slices + 1 has w_0, slices + 2 + l w_l of light l
//   scattered  slice k has its columns x rows texels from (k % across, k / across) times that on

const int most_scattered_steps = 64;

// What the estimate of the error adds for the grid, of what comes from it.
const float scattered_doubt = R(0.02);

struct ScatteredSettings {
    ivec2 size;      // of the pixels' image
    int columns;
    int rows;
    int slices;      // steps; there is one distance more
    int across;
    int lights;
    int gaussians;
    int mapped;      // tier `maps`: the density is that of its grid
    float cell;      // [px]
};

PURE ivec2 scattered_corner(IN(ScatteredSettings) s, int slice)
{
    int down = slice / s.across;
    return ivec2((slice - down * s.across) * s.columns, down * s.rows);
}

const float farthest_peak = R(1e15);

// From a light's peak, which is so round that through its middle there is as much as of fluence() d.
PURE float peak_distance(IN(Light) light, IN(Aspect) aspect, float t)
{
    float x = clamp(t - aspect.foot, -farthest_peak, farthest_peak);
    float h = min(aspect.height, farthest_peak);
    float r = clamp(R(0.6065) * light.radius, smallest_light, farthest_peak);
    return sqrt(h * h + x * x + r * r);
}

// The mean of 1 / d between two points at a and b from the peak.
PURE float mean_peak(float a, float b, float width)
{
    float s = max(a + b, R(1e-20));
    float q = clamp(width / s, R(0.0), R(1.0) - R(1e-6));
    float y = q * q;
    float series = R(1.0) + y * (R(1.0 / 3.0) + y * (R(0.2) + y * (R(1.0 / 7.0) + y * R(1.0 / 9.0))));
    float whole = log((R(1.0) + q) / (R(1.0) - q)) / max(R(2.0) * q, R(1e-20));
    return R(2.0) / s * choose(q < R(0.25), series, whole);
}

#define SCATTERED_IMAGES sampler2D distances, sampler2D scattered, sampler2D lights, sampler2D gaussians, sampler2D tile_gaussians, \
                         sampler2D grid_density
#define SCATTERED_PASSED distances, scattered, lights, gaussians, tile_gaussians, grid_density

// What arrives at the pixel. range: of its tile's list. gaussian_part: their int rho dt up to `distance`; grid: of tier `maps`.
PURE vec3 scattered_along(IN(Medium) medium, IN(Camera) camera, IN(ScatteredSettings) s, IN(GridSettings) grid, SCATTERED_IMAGES,
                          ivec2 range, vec2 pixel, vec3 direction, float distance, float gaussian_part)
{
    float to[most_scattered_steps + 1];
    float passed[most_scattered_steps + 1];   // int rho dt of the Gaussians
    vec3 coloured[most_scattered_steps + 1];  // that of what scatters red, green and blue
    float peaks[most_scattered_steps + 1];    // the mean of W up to there from the distance before
    float background = data_texel(distances, s.slices + 1).x;
    int steps = 0;
    to[0] = R(0.0);
    passed[0] = R(0.0);
    coloured[0] = vec3(R(0.0));
    while (steps < s.slices && some(to[steps] < distance)) {
        ++steps;
        to[steps] = min(data_texel(distances, steps).x, distance);
        passed[steps] = R(0.0);
        coloured[steps] = vec3(R(0.0));
        peaks[steps] = background;
    }
    if (s.mapped == 1) {
        ivec2 size = ivec2(grid.columns, grid.rows);
        vec2 place = pixel / float(grid.cell);
        for (int k = 1; k <= steps; ++k) {
            vec4 at = data_texel(distances, k);
            int slice = int(at.y);
            vec4 low = grid_fetch(grid_density, grid_corner(grid, slice), size, place);
            vec4 high = grid_fetch(grid_density, grid_corner(grid, min(slice + 1, grid.slices)), size, place);
            vec4 there = max(low * (R(1.0) - at.z) + high * at.z, vec4(R(0.0)));
            float before = passed[k - 1];
            float whole = max(there.x - before, R(0.0));
            float up_to = choose(at.x <= distance, there.x, min(gaussian_part, there.x));
            passed[k] = max(up_to, before);
            coloured[k] = coloured[k - 1] + max(vec3(there.y, there.z, there.w) - coloured[k - 1], vec3(R(0.0))) *
                                                (min(passed[k] - before, whole) / max(whole, R(1e-30)));
        }
    } else {
        for (int i = 0; i < range.y; ++i) {
            Gaussian g = gaussian_at(gaussians, int(data_texel(tile_gaussians, range.x + i).x));
            Profile profile = sight_profile(medium, camera, g, direction);
            Bool by = passed_by(medium, g, profile);
            if (!some(!by))
                continue;
            float before = erf(-profile.scale * profile.middle);
            float depth = choose(by, R(0.0), R(0.886226925453) * profile_length(profile));
            for (int k = 1; k <= steps; ++k) {
                float part = column_part(depth, profile.scale, profile.middle, before, to[k]);
                passed[k] += part;
                coloured[k] += g.color * part;
            }
        }
    }
    for (int l = 0; l < s.lights; ++l) {
        float weight = data_texel(distances, s.slices + 2 + l).x;
        if (!some(weight > R(0.0)))
            continue;
        Light light = light_at(lights, l);
        Aspect aspect = aspect_of(light, direction);
        float before = peak_distance(light, aspect, R(0.0));
        for (int k = 1; k <= steps; ++k) {
            float there = peak_distance(light, aspect, to[k]);
            peaks[k] += weight * mean_peak(before, there, to[k] - to[k - 1]);
            before = there;
        }
    }
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 albedo = medium.scattering / max(extinction, vec3(R(1e-35)));
    vec2 place = pixel / s.cell;
    ivec2 size = ivec2(s.columns, s.rows);
    vec3 before = vec3(grid_fetch(scattered, scattered_corner(s, 0), size, place));
    vec3 left = vec3(R(1.0));
    float density = R(0.0);
    vec3 total = vec3(R(0.0));
    for (int k = 1; k <= steps; ++k) {
        vec3 there = vec3(grid_fetch(scattered, scattered_corner(s, k), size, place));
        float whole = data_texel(distances, k).x - data_texel(distances, k - 1).x;
        float half_way = R(0.5) * clamp((to[k] - to[k - 1]) / whole, R(0.0), R(1.0));
        vec3 source = (before * (R(1.0) - half_way) + there * half_way) * peaks[k];
        float terms = density_integral(medium, direction, to[k]);
        float next = max(min(terms + passed[k], density_limit), density);
        vec3 next_left = transmittance(medium, next);
        if (s.gaussians > 0) {
            // Of each colour what it has of the step's mass.
            float of_gaussians = max(passed[k] - passed[k - 1], R(0.0));
            float mass = max(next - density, R(1e-30));
            vec3 absorbed = max(vec3(of_gaussians) - (coloured[k] - coloured[k - 1]), vec3(R(0.0)));
            source *= max(vec3(R(1.0)) - min(absorbed / mass, vec3(R(1.0))), vec3(R(0.0)));
        }
        total += min(min(source, vec3(radiance_limit)) * (albedo * max(left - next_left, vec3(R(0.0)))), vec3(radiance_limit));
        before = there;
        left = next_left;
        density = next;
    }
    return min(total, vec3(radiance_limit));
}
