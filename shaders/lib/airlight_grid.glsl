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
    MAPPED_STATES
    int count = min(last - first, grid_lights_at_once);
    for (int i = 0; i < count; ++i) {
        light[i] = light_at(lights, first + i);
        aspect[i] = aspect_to(light[i], direction);
        height[i] = height_of(light[i], aspect[i]);
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
                float density_a = of_lights[i];
                float density_b = mix(density_a, next_lights[i], share);
                StepNodes nodes = step_nodes(s, light[i], aspect[i].foot, height[i], from, to, most, mass, density_a, density_b);
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

// The same of any lights, of whose light the grid has the sum, of the whole grid. Those that are not smooth, and in the step that the
// ray ends in all, are looked up by themselves.
PURE vec3 lit_by_sums(IN(Medium) medium, IN(Camera) camera, IN(GridSettings) s, GRID_IMAGES, int first, int last, vec2 place,
                      vec3 direction, float distance)
{
    ivec2 size = ivec2(s.columns, s.rows);
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 total = vec3(R(0.0));
    float from = R(0.0);
    vec4 density = vec4(R(0.0));
    float terms = R(0.0);
    for (int k = 0; k < s.slices; ++k) {
        if (!some(from < distance))
            break;
        float next = data_texel(slices, k + 1).x;
        float to = max(min(next, distance), from);
        float share = (to - from) / (next - from);
        vec4 next_density = grid_fetch(grid_density, grid_corner(s, k + 1), size, place);
        float next_terms = density_integral(medium, direction, to);
        float of_terms = max(next_terms - terms, R(0.0));
        vec4 step = max(next_density - density, vec4(R(0.0))) * share;
        float mass = step.x + of_terms;
        if (some(mass > R(0.0))) {
            vec3 scattered = min(medium.scattering * (vec3(step.y, step.z, step.w) + vec3(of_terms)), vec3(radiance_limit)) *
                             grid_mean_exponential(s, extinction * mass);
            float before = clamp(density.x + terms, R(0.0), density_limit);
            vec4 given = grid_fetch_agreed(grid_lights, grid_corner(s, k), size, place, all_apart);
            vec3 arriving = exp(vec3(given) - optical_depth(medium, before));
            float apart = choose(mass > R(0.0), choose(to < next, all_apart, given.w), R(0.0));
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
            total += min(arriving * scattered, vec3(radiance_limit));
        }
        from = next;
        density = next_density;
        terms = next_terms;
    }
    return min(total, vec3(radiance_limit));
}
