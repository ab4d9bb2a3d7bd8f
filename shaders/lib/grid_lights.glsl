// The lights at the grid's points. Needs attenuation.glsl, airlight_step.glsl.

// Where the grid has their depths and not their sum.
const int grid_lights_at_once = 4;

// The grid's texel of lights [first, last): their depths.
PURE vec4 grid_depths(IN(GridSettings) s, sampler2D attenuation, sampler2D attenuation_frames, sampler2D lights, int first, int last,
                      vec3 direction, float distance)
{
    vec4 densities = vec4(R(0.0));
    vec3 point = distance * direction;
    for (int i = 0; i < last - first; ++i) {
        Light light = light_at(lights, first + i);
        densities[i] = attenuation_density(attenuation_frame(attenuation_frames, first + i), attenuation, s.side, s.nodes,
                                           first + i - s.mapped, light, point);
    }
    return densities;
}

// Which lights a sum leaves out is told of so many; where it would be another's turn, it is all of them.
const int most_told_apart = 22;
const float all_apart = R(4194304.0);  // 2^most_told_apart

// What is black; its exponential is nothing in 32 bits.
const float black_logarithm = R(-200.0);

// How a lobe's logarithm bends with the angle by which light is turned, of which `cosine` is: first and second derivative, at most.
PURE vec2 lobe_bend(float asymmetry, float cosine)
{
    float g = clamp(abs(asymmetry), R(0.0), largest_asymmetry);
    float toward = choose(asymmetry < R(0.0), -cosine, cosine);
    float s = (R(1.0) - g) * (R(1.0) - g) + R(2.0) * g * (R(1.0) - toward);
    float turning = R(3.0) * g * sqrt(max(R(1.0) - toward * toward, R(0.0))) / s;
    return vec2(turning, R(3.0) * g / s + R(2.0 / 3.0) * turning * turning);
}

// The same of the whole phase function, second derivative alone; two lobes bend where they cross.
PURE float phase_bend(IN(Medium) medium, float cosine)
{
    vec2 first = lobe_bend(medium.phase.x, cosine);
    float bend = first.y;
    if (some(medium.phase.w > R(0.0))) {
        vec2 second = lobe_bend(medium.phase.y, cosine);
        float apart = first.x + second.x;
        bend = max(bend, second.y) + R(0.25) * apart * apart + R(2.0) * min(medium.phase.z, R(1.0));
    }
    return bend;
}

// Whether the logarithm of the light of a step is nearly straight from one corner to the next.
PURE Bool smooth_across(IN(Medium) medium, IN(Camera) camera, IN(GridSettings) s, IN(Light) light, IN(Aspect) aspect, vec3 direction,
                        float from, float to)
{
    float cell = float(s.cell) / min(camera.focal.x, camera.focal.y);
    if (light.type == light_directional)
        return cell * cell * phase_bend(medium, -dot(light.direction, direction)) < s.bend;
    float h = height_of(light, aspect);
    float a = from - aspect.foot;
    float b = to - aspect.foot;
    float nearest = clamp(R(0.0), a, b);
    float turn = to * cell / sqrt(h * h + nearest * nearest);
    // Of 1 / d^2 it is 2. Light is turned least at the step's beginning, and most at its end; across the cell by as much as that turns.
    Bool back = medium.asymmetry < R(0.0);
    float x = choose(back, b, a);
    float d = sqrt(h * h + x * x);
    float side = choose(back, -R(1.0), R(1.0));
    float cosine = clamp(-x / d + side * turn * h / d, -R(1.0), R(1.0));
    Bool even = turn * turn * (R(2.0) + phase_bend(medium, cosine)) < s.bend;
    if (light.type == light_spot) {
        // Nothing between here and the next corners, nor along the step, is farther from its middle as seen from the light.
        float reach = min(turn + R(0.5) * angle_of(h, a, b), R(1.0));
        float turned = sqrt(R(1.0) - reach * reach);
        vec3 way = (aspect.foot + halfway(h, a, b)) * direction - light.position;
        float cosine_of_way = clamp(dot(way, light.direction) / max(length(way), R(1e-20)), -R(1.0), R(1.0));
        float sine = sqrt(R(1.0) - cosine_of_way * cosine_of_way);
        Bool outside = cosine_of_way < turned && cosine_of_way * turned + sine * reach < light.cos_outer;
        Bool inside = cosine_of_way > -turned && cosine_of_way * turned - sine * reach > light.cos_inner;
        even = even && (outside || inside);
    }
    return even;
}

PURE float light_logarithm(float light)
{
    return choose(light > R(1e-36), log(max(light, R(1e-36))), black_logarithm);
}

// Lights of a step so far: the sum of those that are smooth across, and which are not.
struct GridSum {
    vec3 light;
    float apart;
};

// One light more, the i'th.
PURE GridSum with_light(GridSum sum, int i, vec3 light, Bool is_smooth)
{
    sum.light += choose(is_smooth, light, vec3(R(0.0)));
    float apart = i < most_told_apart ? sum.apart + float(1 << min(i, most_told_apart)) : all_apart;
    sum.apart = choose(is_smooth, sum.apart, apart);
    return sum;
}

// Whether the i'th light is looked up by itself.
PURE Bool is_apart(float apart, int i)
{
    float above = floor(apart / float(1 << min(i, most_told_apart)));
    return apart >= all_apart || above - R(2.0) * floor(R(0.5) * above) > R(0.5);
}

// The grid's texel.
PURE vec4 grid_sum(IN(GridSum) sum)
{
    vec3 light = min(sum.light, vec3(radiance_limit));
    return vec4(light_logarithm(light.x), light_logarithm(light.y), light_logarithm(light.z), sum.apart);
}
