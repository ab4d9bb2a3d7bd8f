// The method `maps`: a pixel's airlight from the grid. Needs airlight_step.glsl, grid_lights.glsl, grid_fetch.glsl, and the macros of
// airlight_mapped.glsl.
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

// The share of a step's mass that lies in the first `part` of its width: a cubic through what is summed up to its ends, with slopes from
// the steps around it and none that would turn it, as attenuation_density() has. Of each of the three: its mass over its width.
PURE float mass_before(float part, float before, float here, float behind, float width_before, float width, float width_behind)
{
    float from = min((before * width + here * width_before) / (width + width_before), R(3.0) * min(before, here));
    float to = min((behind * width + here * width_behind) / (width + width_behind), R(3.0) * min(behind, here));
    return choose(here > R(0.0), clamp(risen(part, here, from, to) / max(here, R(1e-30)), R(0.0), R(1.0)), part);
}

// The same of the step [from, next] of the grid's Gaussians, of which `slope_before` came before, since `earlier`.
PURE float mass_of_part(IN(GridSettings) s, int stride, sampler2D slices, sampler2D grid_density, int slice, vec2 place, float slope_before,
                        float earlier, float from, float next, vec4 density, vec4 next_density, float part)
{
    int behind = min(slice + stride, s.slices);
    float last = data_texel(slices, behind).x;
    float width = next - from;
    float here = max(next_density.x - density.x, R(0.0)) / width;
    float slope_behind =
        max(grid_between(grid_density, s, stride, behind, place).x - next_density.x, R(0.0)) / max(last - next, R(1e-30));
    return mass_before(part, some(from > R(0.0)) ? slope_before : here, here, behind > slice ? slope_behind : here, from - earlier, width,
                       last - next);
}

// What the lights [first, last), four at most, whose depths the grid has, add to a pixel; place: in cells. stride: 1, or 2 for half the grid each way, which
// tells how far off the whole is.
PURE vec3 lit_by_grid(IN(Medium) medium, IN(Camera) camera, IN(GridSettings) s, int stride, sampler2D slices, sampler2D grid_density,
                      sampler2D grid_lights, sampler2D lights, MAPPED_IMAGES, int first, int last, vec2 place, vec3 direction, float distance)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float most = max(max(extinction.x, extinction.y), extinction.z);
    Light light[grid_lights_at_once];
    Aspect aspect[grid_lights_at_once];
    float height[grid_lights_at_once];
    Cones cones[grid_lights_at_once];
    MAPPED_STATES
    int count = min(last - first, grid_lights_at_once);
    for (int i = 0; i < count; ++i) {
        light[i] = light_at(lights, first + i);
        aspect[i] = aspect_to(light[i], direction);
        height[i] = height_of(light[i], aspect[i]);
        cones[i] = cones_of(light[i], aspect[i], direction);
        MAPPED_BEGIN(i)
    }
    vec3 total = vec3(R(0.0));
    float from = R(0.0);
    float earlier = R(0.0);
    float slope = R(0.0);
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
        vec4 step = max(next_density - density, vec4(R(0.0)));
        if (some(to < next))
            step = step * choose(to < next, mass_of_part(s, stride, slices, grid_density, slice, place, slope, earlier, from, next, density,
                                                         next_density, share), R(1.0));
        float mass = step.x + of_terms;
        if (some(mass > R(0.0))) {
            float before = density.x + terms;
            vec3 scattering =
                min(medium.scattering * ((vec3(step.y, step.z, step.w) + vec3(of_terms)) / max(width, R(1e-30))), vec3(radiance_limit));
            vec3 seen = grid_transmittance(medium, s, before);
            vec3 whole = scattering * seen * grid_mean_exponential(s, extinction * mass);
            for (int i = 0; i < count; ++i) {
                float density_a = of_lights[i];
                float density_b = mix(density_a, next_lights[i], share);
                StepNodes nodes = step_nodes(s, light[i], aspect[i].foot, height[i], cones[i], from, to, most, mass, density_a, density_b);
                for (int j = 0; j < 1 << nodes.most_halvings; ++j) {
                    StepNode node = step_node(nodes, aspect[i].foot, from, to, j);
                    float depth = depth_to_node(medium, light[i], direction, density_a, density_b, node);
                    float part = MAPPED_SHARE(i, node.low + aspect[i].foot, node.high + aspect[i].foot);
                    vec3 arriving = light_at_node(medium, s, light[i], aspect[i], direction, node.t, depth, part);
                    MAPPED_ORDERS(i, node.t, depth)
                    // Of halved steps each part has its own transmittance to the camera.
                    vec3 source = whole;
                    if (nodes.most_halvings > 0) {
                        vec3 there = scattering * grid_transmittance(medium, s, before + mass * node.along);
                        source = choose(nodes.count > R(1.0), there, whole);
                    }
                    vec3 amount = min(source * node.weight, vec3(radiance_limit));
                    total += min(arriving * amount, vec3(radiance_limit));
                }
            }
        }
        earlier = from;
        slope = max(next_density.x - density.x, R(0.0)) / (next - from);
        from = next;
        density = next_density;
        of_lights = next_lights;
        terms = next_terms;
    }
    return min(total, vec3(radiance_limit));
}

#define GRID_IMAGES sampler2D slices, sampler2D grid_density, sampler2D grid_lights, sampler2D attenuation, \
                    sampler2D attenuation_frames, sampler2D lights
#define GRID_PASSED slices, grid_density, grid_lights, attenuation, attenuation_frames, lights

// The grid's sum along the part of a step that a ray ends in, from that along the step and the ones before and behind it: a parabola
// through their logarithms, where that is nearly straight. w: as the grid has it; where the three differ, or it is not, all_apart.
PURE vec4 light_of_end(IN(GridSettings) s, vec4 before, vec4 here, vec4 behind, float first, float from, float to, float next, float last)
{
    float middle = R(0.5) * (from + next);
    float earlier = R(0.5) * (first + from);
    float later = R(0.5) * (next + last);
    float x = R(0.5) * (from + to);
    vec3 rise = (vec3(here) - vec3(before)) / (middle - earlier);
    vec3 bend = ((vec3(behind) - vec3(here)) / (later - middle) - rise) / (later - earlier);
    float bent = max(max(abs(bend.x), abs(bend.y)), abs(bend.z)) * (next - from) * (next - from);
    Bool straight = here.w == before.w && here.w == behind.w && bent < s.bend;
    vec3 light = vec3(here) + (x - middle) * (rise + (x - earlier) * bend);
    return vec4(light.x, light.y, light.z, choose(straight, here.w, all_apart));
}

// The same of any lights, of whose light the grid has the sum, of the whole grid. Those that are not smooth are looked up by themselves.
PURE vec3 lit_by_sums(IN(Medium) medium, IN(Camera) camera, IN(GridSettings) s, GRID_IMAGES, int first, int last, vec2 place,
                      vec3 direction, float distance)
{
    ivec2 size = ivec2(s.columns, s.rows);
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 total = vec3(R(0.0));
    float from = R(0.0);
    float earlier = R(0.0);
    float slope = R(0.0);
    vec4 density = vec4(R(0.0));
    float terms = R(0.0);
    vec4 last_given = vec4(R(0.0), R(0.0), R(0.0), all_apart);
    for (int k = 0; k < s.slices; ++k) {
        if (!some(from < distance))
            break;
        float next = data_texel(slices, k + 1).x;
        float to = max(min(next, distance), from);
        float share = (to - from) / (next - from);
        vec4 next_density = grid_fetch(grid_density, grid_corner(s, k + 1), size, place);
        float next_terms = density_integral(medium, direction, to);
        float of_terms = max(next_terms - terms, R(0.0));
        vec4 step = max(next_density - density, vec4(R(0.0)));
        if (some(to < next))
            step = step * choose(to < next, mass_of_part(s, 1, slices, grid_density, k + 1, place, slope, earlier, from, next, density,
                                                         next_density, share), R(1.0));
        // Of pixels side by side some have ended before.
        float mass = choose(from < distance, step.x + of_terms, R(0.0));
        vec4 given = vec4(R(0.0), R(0.0), R(0.0), all_apart);
        if (some(mass > R(0.0))) {
            vec3 scattered = min(medium.scattering * (vec3(step.y, step.z, step.w) + vec3(of_terms)), vec3(radiance_limit)) *
                             grid_mean_exponential(s, extinction * mass);
            float before = clamp(density.x + terms, R(0.0), density_limit);
            given = grid_fetch_agreed(grid_lights, grid_corner(s, k), size, place, all_apart);
            vec4 sums = given;
            if (some(to < next)) {
                int behind = min(k + 1, s.slices - 1);
                vec4 ended = light_of_end(s, last_given, given, grid_fetch_agreed(grid_lights, grid_corner(s, behind), size, place, all_apart),
                                          earlier, from, to, next, data_texel(slices, behind + 1).x);
                sums = choose(to < next, ended, given);
            }
            vec3 arriving = exp(vec3(sums) - optical_depth(medium, before));
            float apart = choose(mass > R(0.0), sums.w, R(0.0));
            if (some(apart > R(0.0))) {
                vec3 sum = vec3(R(0.0));
                for (int i = first; i < last; ++i) {
                    Bool by_itself = is_apart(apart, i - first);
                    if (!some(by_itself))
                        continue;
                    Light light = light_at(lights, i);
                    AttenuationFrame frame = attenuation_frame(attenuation_frames, i);
                    Aspect aspect = aspect_to(light, direction);
                    float density_a = attenuation_density(frame, attenuation, s.side, s.nodes, i - s.mapped, light, from * direction);
                    float density_b = attenuation_density(frame, attenuation, s.side, s.nodes, i - s.mapped, light, to * direction);
                    sum += choose(by_itself, light_of_step(medium, s, light, aspect, direction, from, to, mass, density_a, density_b),
                                  vec3(R(0.0)));
                }
                vec3 of_sum = choose(apart < all_apart, arriving, vec3(R(0.0)));
                arriving = of_sum + min(sum, vec3(radiance_limit)) * grid_transmittance(medium, s, before);
            }
            total += choose(mass > R(0.0), min(arriving * scattered, vec3(radiance_limit)), vec3(R(0.0)));
        }
        earlier = from;
        slope = max(next_density.x - density.x, R(0.0)) / (next - from);
        from = next;
        last_given = given;
        density = next_density;
        terms = next_terms;
    }
    return min(total, vec3(radiance_limit));
}
