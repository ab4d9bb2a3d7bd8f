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

// The angle that a cell may have as seen from a light, as a share of a step's. Across it the logarithm of 1 / d^2 is then straight to a
// few thousandths at worst, less in the mean: what bends it outward from the light and what bends it around the light is alike.
const float smooth_angle = R(0.4);

// Less is between corners of which some are not smooth; interpolating ones rounds.
const float least_smooth = R(0.999);

// What is black; its exponential is nothing in 32 bits.
const float black_logarithm = R(-200.0);

// Whether the logarithm of the light of a step is nearly straight from one corner to the next.
PURE Bool smooth_across(IN(Camera) camera, IN(GridSettings) s, IN(Light) light, IN(Aspect) aspect, vec3 direction, float from, float to)
{
    float cell = float(s.cell) / camera.focal.x;
    float most = smooth_angle * s.angle;
    if (light.type == light_directional)
        return cell < most;
    float h = height_of(light, aspect);
    float a = from - aspect.foot;
    float b = to - aspect.foot;
    float nearest = clamp(R(0.0), a, b);
    float turn = to * cell / sqrt(h * h + nearest * nearest);
    Bool even = turn < most;
    if (light.type == light_spot) {
        // Nothing between here and the next corners, nor along the step, is farther from its middle as seen from the light.
        float reach = min(turn + R(0.5) * angle_of(h, a, b), R(1.0));
        float turned = sqrt(R(1.0) - reach * reach);
        vec3 way = (aspect.foot + halfway(h, a, b)) * direction - light.position;
        float cosine = clamp(dot(way, light.direction) / max(length(way), R(1e-20)), -R(1.0), R(1.0));
        float sine = sqrt(R(1.0) - cosine * cosine);
        Bool outside = cosine < turned && cosine * turned + sine * reach < light.cos_outer;
        Bool inside = cosine > -turned && cosine * turned - sine * reach > light.cos_inner;
        even = even && (outside || inside);
    }
    return even;
}

PURE float light_logarithm(float light)
{
    return choose(light > R(1e-36), log(max(light, R(1e-36))), black_logarithm);
}

// The grid's texel of lights that send so much altogether.
PURE vec4 grid_sum(vec3 light, Bool is_smooth)
{
    return vec4(light_logarithm(light.x), light_logarithm(light.y), light_logarithm(light.z), choose(is_smooth, R(1.0), R(0.0)));
}
