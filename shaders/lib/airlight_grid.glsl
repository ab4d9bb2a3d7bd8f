// The method `maps`: a pixel's airlight from the grid. Needs lit.glsl, radiance.glsl, grid_lights.glsl, grid_fetch.glsl, and the
// macros of airlight_mapped.glsl.
//
// A step between two slices takes two fetches, however many Gaussians there are. Its mass is exact for them all; 1 / d^2 is
// integrated in closed form, and steps that the lights' angle or depth changes much over are halved.

// A slice at a place, between every `stride`th corner, 1 or 2.
PURE vec4 grid_between(sampler2D image, IN(GridSettings) s, int stride, int slice, vec2 place)
{
    ivec2 corner = grid_corner(s, slice);
    ivec2 size = ivec2(s.columns, s.rows);
    if (stride == 1)
        return grid_fetch(image, corner, size, place);
    vec2 first = vec2(floor(place.x * R(0.5)) * R(2.0), floor(place.y * R(0.5)) * R(2.0));
    vec2 f = R(0.5) * (place - first);
    vec2 right = vec2(R(2.0), R(0.0));
    vec2 down = vec2(R(0.0), R(2.0));
    vec4 top = grid_fetch(image, corner, size, first) * (R(1.0) - f.x) + grid_fetch(image, corner, size, first + right) * f.x;
    vec4 bottom = grid_fetch(image, corner, size, first + down) * (R(1.0) - f.x) +
                  grid_fetch(image, corner, size, first + down + right) * f.x;
    return top * (R(1.0) - f.y) + bottom * f.y;
}

const int grid_halvings = 4;

// Nodes at equal angles from a light at height h above the ray's point `foot`: which x between a and b halves the angle.
PURE float halfway(float h, float a, float b)
{
    float da = sqrt(h * h + a * a);
    float db = sqrt(h * h + b * b);
    return (a * db + b * da) / (da + db);
}

// atan(q) for 0 <= q <= 1, to 1e-7 of itself.
PURE float small_atan(float q)
{
    // Halved once more: the series is that of [0, .415].
    float x = q / (R(1.0) + sqrt(R(1.0) + q * q));
    float y = x * x;
    return R(2.0) * x *
           (R(1.0) + y * (-R(1.0 / 3.0) + y * (R(0.2) + y * (-R(1.0 / 7.0) + y * (R(1.0 / 9.0) + y * (-R(0.0881) + y * R(0.0573)))))));
}

// The angle in which [a, b] is seen from the light.
PURE float angle_of(float h, float a, float b)
{
    float r = sqrt(h * h + a * a) * sqrt(h * h + b * b);
    float y = h * (b - a);
    float q = y / max(r + h * h + a * b, R(1e-30));
    return R(4.0) * small_atan(q / (R(1.0) + sqrt(R(1.0) + q * q)));
}

PURE vec3 grid_transmittance(IN(Medium) medium, IN(GridSettings) s, float density)
{
    float p = clamp(density, R(0.0), density_limit);
    if (s.grey == 1)
        return vec3(exp(-min((medium.scattering.x + medium.absorption.x) * p, optical_depth_limit)));
    return transmittance(medium, p);
}

PURE vec3 grid_mean_exponential(IN(GridSettings) s, vec3 tau)
{
    if (s.grey == 1)
        return vec3(mean_exponential(tau.x));
    return vec3(mean_exponential(tau.x), mean_exponential(tau.y), mean_exponential(tau.z));
}

// Beyond this no light shows.
const float farthest_light = R(1e15);

// Parallel light is as if it came from so far.
const float parallel_height = R(1e9);

// What the lights [first, last), four at most, add to a pixel; place: in cells. stride: 1, or 2 for half the grid each way, which
// tells how far off the whole is.
PURE vec3 lit_by_grid(IN(Medium) medium, IN(Camera) camera, IN(GridSettings) s, int stride, sampler2D slices, sampler2D grid_density,
                      sampler2D grid_lights, sampler2D lights, MAPPED_IMAGES, int first, int last, vec2 place, vec3 direction, float distance)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float most = max(max(extinction.x, extinction.y), extinction.z);
    Light light[grid_lights_at_once];
    Aspect aspect[grid_lights_at_once];
    float height[grid_lights_at_once];
    MAPPED_STATES
    int count = min(last - first, grid_lights_at_once);
    for (int i = 0; i < count; ++i) {
        light[i] = light_at(lights, first + i);
        aspect[i] = aspect_of(light[i], direction);
        height[i] = min(max(aspect[i].height, light[i].radius), farthest_light);
        if (light[i].type == light_directional) {
            aspect[i].foot = R(0.0);
            height[i] = parallel_height;
        }
        MAPPED_BEGIN(i)
    }
    vec3 total = vec3(R(0.0));
    float from = R(0.0);
    vec4 density = vec4(R(0.0));
    float terms = R(0.0);
    vec4 of_lights = grid_between(grid_lights, s, stride, 0, place);
    for (int k = 0; k < s.slices; k += stride) {
        if (!some(from < distance))
            break;
        int slice = min(k + stride, s.slices);
        float next = data_texel(slices, slice).x;
        float to = max(min(next, distance), from);
        float width = to - from;
        float share = width / (next - from);
        vec4 next_density = grid_between(grid_density, s, stride, slice, place);
        vec4 next_lights = grid_between(grid_lights, s, stride, slice, place);
        float next_terms = density_integral(medium, direction, to);
        float of_terms = max(next_terms - terms, R(0.0));
        vec4 step = max(next_density - density, vec4(R(0.0))) * share;
        float mass = step.x + of_terms;
        if (some(mass > R(0.0))) {
            float before = density.x + terms;
            vec3 scattering =
                min(medium.scattering * ((vec3(step.y, step.z, step.w) + vec3(of_terms)) / max(width, R(1e-30))), vec3(radiance_limit));
            vec3 seen = grid_transmittance(medium, s, before);
            vec3 whole = scattering * seen * grid_mean_exponential(s, extinction * mass);
            for (int i = 0; i < count; ++i) {
                float a = clamp(from - aspect[i].foot, -farthest_light, farthest_light);
                float b = clamp(to - aspect[i].foot, -farthest_light, farthest_light);
                float h = height[i];
                float d = light[i].type == light_directional ? R(1.0) : sqrt(h * h + a * a);
                float e = light[i].type == light_directional ? R(1.0) : sqrt(h * h + b * b);
                float density_a = of_lights[i];
                float density_b = mix(density_a, next_lights[i], share);
                float angle = angle_of(h, a, b);
                float turns = max(max(angle / s.angle, most * mass / s.depth), most * abs(density_b * e - density_a * d) / s.depth);
                if (light[i].type == light_directional)
                    turns = max(most * mass / s.depth, most * abs(density_b - density_a) / s.depth);
                // Pixels side by side go as far as any of them needs; each takes its own steps, so that none depends on the others.
                float halvings = R(0.0);
                float nodes = R(1.0);
                int most_halvings = 0;
                for (int n = 1; n <= grid_halvings && some(turns > nodes); ++n) {
                    Bool more = turns > nodes;
                    halvings += choose(more, R(1.0), R(0.0));
                    nodes *= choose(more, R(2.0), R(1.0));
                    most_halvings = n;
                }
                float part = angle / nodes;
                for (int j = 0; j < 1 << most_halvings; ++j) {
                    float low = a;
                    float high = b;
                    float middle = halfway(h, low, high);
                    for (int n = most_halvings - 1; n >= 0; --n) {
                        Bool halved = float(n) < halvings;
                        bool upper = ((j >> n) & 1) == 1;
                        low = choose(halved, upper ? middle : low, low);
                        high = choose(halved, upper ? high : middle, high);
                        middle = halfway(h, low, high);
                    }
                    float t = clamp(aspect[i].foot + middle, from, to);
                    float x = t - aspect[i].foot;
                    // dt of the node's part of the angle.
                    float weight = choose(float(j) < nodes, or_zero(min((h * h + x * x) / h * part, width)), R(0.0));
                    float along = (t - from) / max(width, R(1e-30));
                    vec3 point = t * direction;
                    float far = light[i].type == light_directional ? R(1.0) : length(point - light[i].position);
                    float gaussians = or_zero(mix(density_a, density_b, along) * far);
                    float depth = clamp(gaussians + terms_to_light(medium, light[i], point), R(0.0), density_limit);
                    float strength = or_zero(lit_strength(medium, light[i], aspect[i], direction, t)) *
                                     MAPPED_SHARE(i, low + aspect[i].foot, high + aspect[i].foot);
                    vec3 arriving = min(strength * light[i].intensity, vec3(radiance_limit)) * grid_transmittance(medium, s, depth);
                    MAPPED_ORDERS(i, t, depth)
                    // Of halved steps each part has its own transmittance to the camera.
                    vec3 source = whole;
                    if (most_halvings > 0) {
                        vec3 there = scattering * grid_transmittance(medium, s, before + mass * along);
                        Bool halved = nodes > R(1.0);
                        source = vec3(choose(halved, there.x, whole.x), choose(halved, there.y, whole.y), choose(halved, there.z, whole.z));
                    }
                    vec3 amount = min(source * weight, vec3(radiance_limit));
                    total += min(arriving * amount, vec3(radiance_limit));
                }
            }
        }
        from = next;
        density = next_density;
        of_lights = next_lights;
        terms = next_terms;
    }
    return min(total, vec3(radiance_limit));
}
