// What a light sends along a step of a view's ray, for the method `maps`. Needs radiance.glsl, lit.glsl, light_cone.glsl, grid_settings.glsl.

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

PURE vec3 choose(Bool which, vec3 a, vec3 b)
{
    return vec3(choose(which, a.x, b.x), choose(which, a.y, b.y), choose(which, a.z, b.z));
}

PURE vec4 choose(Bool which, vec4 a, vec4 b)
{
    return vec4(choose(which, a.x, b.x), choose(which, a.y, b.y), choose(which, a.z, b.z), choose(which, a.w, b.w));
}

PURE Aspect aspect_to(IN(Light) light, vec3 direction)
{
    Aspect aspect = aspect_of(light, direction);
    if (light.type == light_directional)
        aspect.foot = R(0.0);
    return aspect;
}

PURE float height_of(IN(Light) light, IN(Aspect) aspect)
{
    return light.type == light_directional ? parallel_height : min(max(aspect.height, light.radius), farthest_light);
}

// Where a ray is in a spot's cones, from the light's foot.
struct Cones {
    vec2 outer;
    vec2 inner;
    float penumbra;  // between them [rad]
};

PURE Cones cones_of(IN(Light) light, IN(Aspect) aspect, vec3 direction)
{
    vec2 all = vec2(-far_away, far_away);
    if (light.type != light_spot)
        return Cones(all, all, R(1.0));
    vec3 foot = aspect.foot * direction - light.position;
    float middle = R(0.5) * (light.cos_inner + light.cos_outer);
    float sine = sqrt(max(R(1.0) - middle * middle, R(1e-12)));
    return Cones(line_in_cone(foot, direction, light.direction, light.cos_outer),
                 line_in_cone(foot, direction, light.direction, light.cos_inner), (light.cos_inner - light.cos_outer) / sine);
}

// Of a spot's penumbra that one value may stand for.
const float penumbra_share = R(0.4);

// Where a light is looked up in a step: in the middle, or in those of 2, 4, 8 or 16 parts, all seen from the light in the same angle.
struct StepNodes {
    float height;  // of the light above the ray
    float low;     // the lit part's ends, from the light's foot
    float high;
    float angle;
    float halvings;
    float count;
    int most_halvings;  // of pixels side by side
};

struct StepNode {
    float low;  // the part's ends, from the light's foot
    float high;
    float t;
    float weight;  // [m]
    float along;   // t as a share of the step
};

// density_a, density_b: at the step's ends, as attenuation_density() has them.
PURE StepNodes step_nodes(IN(GridSettings) s, IN(Light) light, float foot, float height, IN(Cones) cones, float from, float to,
                          float extinction, float mass, float density_a, float density_b)
{
    float a = clamp(from - foot, -farthest_light, farthest_light);
    float b = clamp(to - foot, -farthest_light, farthest_light);
    float h = height;
    float d = light.type == light_directional ? R(1.0) : sqrt(h * h + a * a);
    float e = light.type == light_directional ? R(1.0) : sqrt(h * h + b * b);
    float turns = max(extinction * mass, extinction * abs(density_b * e - density_a * d)) / s.depth;
    if (light.type == light_spot) {
        a = max(a, cones.outer.x);
        b = max(min(b, cones.outer.y), a);
    }
    float angle = angle_of(h, a, b);
    if (light.type != light_directional)
        turns = max(turns, angle / s.angle);
    if (light.type == light_spot) {
        Bool even = a >= cones.inner.x && b <= cones.inner.y;
        turns = max(turns, choose(even, R(0.0), angle / max(penumbra_share * cones.penumbra, R(1e-6))));
    }
    // Pixels side by side go as far as any of them needs; each takes its own steps, so that none depends on the others.
    StepNodes nodes = StepNodes(h, a, b, angle, R(0.0), R(1.0), 0);
    for (int n = 1; n <= grid_halvings && some(turns > nodes.count); ++n) {
        Bool more = turns > nodes.count;
        nodes.halvings += choose(more, R(1.0), R(0.0));
        nodes.count *= choose(more, R(2.0), R(1.0));
        nodes.most_halvings = n;
    }
    return nodes;
}

PURE StepNode step_node(IN(StepNodes) nodes, float foot, float from, float to, int j)
{
    float h = nodes.height;
    float low = nodes.low;
    float high = nodes.high;
    float middle = halfway(h, low, high);
    for (int n = nodes.most_halvings - 1; n >= 0; --n) {
        Bool halved = float(n) < nodes.halvings;
        bool upper = ((j >> n) & 1) == 1;
        low = choose(halved, upper ? middle : low, low);
        high = choose(halved, upper ? high : middle, high);
        middle = halfway(h, low, high);
    }
    float t = clamp(foot + middle, from, to);
    float x = t - foot;
    float width = to - from;
    float lit = nodes.high - nodes.low;
    // dt of the node's part of the angle.
    float weight = or_zero(min((h * h + x * x) / h * (nodes.angle / nodes.count), lit));
    return StepNode(low, high, t, choose(float(j) < nodes.count, weight, R(0.0)), (t - from) / max(width, R(1e-30)));
}

PURE float depth_to_node(IN(Medium) medium, IN(Light) light, vec3 direction, float density_a, float density_b, IN(StepNode) node)
{
    vec3 point = node.t * direction;
    float far = light.type == light_directional ? R(1.0) : length(point - light.position);
    float gaussians = or_zero(mix(density_a, density_b, node.along) * far);
    return clamp(gaussians + terms_to_light(medium, light, point), R(0.0), density_limit);
}

// share: of the node's part that is lit.
PURE vec3 light_at_node(IN(Medium) medium, IN(GridSettings) s, IN(Light) light, IN(Aspect) aspect, vec3 direction, float t, float depth,
                        float share)
{
    float strength = or_zero(lit_strength(medium, light, aspect, direction, t)) * share;
    return min(strength * light.intensity, vec3(radiance_limit)) * grid_transmittance(medium, s, depth);
}

// The mean over a step of the light that its points would scatter to the camera, weighted by what is between them and the step's begin.
PURE vec3 light_of_step(IN(Medium) medium, IN(GridSettings) s, IN(Light) light, IN(Aspect) aspect, vec3 direction, float from, float to,
                        float mass, float density_a, float density_b)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float most = max(max(extinction.x, extinction.y), extinction.z);
    StepNodes nodes = step_nodes(s, light, aspect.foot, height_of(light, aspect), cones_of(light, aspect, direction), from, to, most, mass,
                                 density_a, density_b);
    float width = max(to - from, R(1e-30));
    vec3 whole = vec3(R(1.0));
    if (nodes.most_halvings > 0)
        whole = max(grid_mean_exponential(s, extinction * mass), vec3(R(1e-30)));
    vec3 sum = vec3(R(0.0));
    for (int j = 0; j < 1 << nodes.most_halvings; ++j) {
        StepNode node = step_node(nodes, aspect.foot, from, to, j);
        float depth = depth_to_node(medium, light, direction, density_a, density_b, node);
        vec3 arriving = light_at_node(medium, s, light, aspect, direction, node.t, depth, R(1.0)) * (node.weight / width);
        if (nodes.most_halvings > 0)
            arriving = arriving * choose(nodes.count > R(1.0), grid_transmittance(medium, s, mass * node.along) / whole, vec3(R(1.0)));
        sum += min(arriving, vec3(radiance_limit));
    }
    return min(sum, vec3(radiance_limit));
}
