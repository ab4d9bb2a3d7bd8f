// The tier `nodes`: Gauss-Legendre panels with exact optical depths at each node. Needs airlight.glsl.

// The part of the integral that a panel is of.
const int part_terms = -1;  // constant and exponential terms; 0 and up: that entry of the tile's list

// Substitution of the ray parameter t by z in [0, 1] that flattens the integrand.
const int path_angle = 0;   // t = foot + height tan(from + span y(z)): 1/d^2 is constant in it
const int path_decay = 1;   // t = -height log(1 - span z): parallel light
const int path_bell = 2;    // t = foot + height sinh(from + span z): a Gaussian

struct Path {
    int kind;
    float foot;
    float height;
    float from;
    float span;
    float crowded;  // path_angle: 1 where the nodes are to crowd at the far end, y = 1 - (1 - z)^2
};

struct Panel {
    vec3 sum;
    float error;  // of the mean of the sum's colours
};

const int panel_nodes = 8;
const float panel_node[4] = {R(0.183434642495650), R(0.525532409916329), R(0.796666477413627), R(0.960289856497536)};
const float panel_weight[4] = {R(0.181341891689181), R(0.156853322938944), R(0.111190517226687), R(0.0506142681451881)};

// t and dt/dz.
PURE vec2 on_path(IN(Path) path, float z)
{
    if (path.kind == path_decay) {
        float rest = R(1.0) - path.span * z;
        return vec2(-path.height * log(rest), path.height * path.span / rest);
    }
    if (path.kind == path_bell) {
        float e = exp(path.from + path.span * z);
        return vec2(path.foot + R(0.5) * path.height * (e - R(1.0) / e), R(0.5) * path.height * (e + R(1.0) / e) * path.span);
    }
    float y = z;
    float slope = path.span;
    if (path.crowded > R(0.0)) {
        y = z * (R(2.0) - z);
        slope *= R(2.0) - R(2.0) * z;
    }
    float c = cos(path.from + path.span * y);
    return vec2(path.foot + path.height * tan(path.from + path.span * y), slope * path.height / (c * c));
}

PURE Path angle_path(IN(Light) light, IN(Aspect) aspect, float from, float to, bool crowded)
{
    float h = max(aspect.height, light.radius);
    float a = from - aspect.foot;
    float b = to - aspect.foot;
    return Path(path_angle, aspect.foot, h, atan(a, h), atan(h * (to - from), h * h + a * b), crowded ? R(1.0) : R(0.0));
}

PURE float asinh_of(float x)
{
    float y = abs(x);
    float s = log(y + sqrt(y * y + R(1.0)));
    return x < R(0.0) ? -s : s;
}

PURE Path bell_path(float middle, float width, float from, float to)
{
    float a = asinh_of((from - middle) / width);
    return Path(path_bell, middle, width, a, asinh_of((to - middle) / width) - a, R(0.0));
}

// The integral over z in [z, z + dz].
PURE Panel panel_of(IN(Medium) medium, IN(Camera) camera, SHADOW_IMAGES, sampler2D tile_gaussians, IN(Sight) sight, int index,
                    IN(Light) light, IN(Aspect) aspect, int part, IN(Path) path, float z, float dz)
{
    float t[8];
    float dt[8];
    float p[8];
    float rho[8];
    for (int k = 0; k < panel_nodes; ++k) {
        float x = k < 4 ? -panel_node[3 - k] : panel_node[k - 4];
        vec2 node = on_path(path, z + dz * (R(0.5) + R(0.5) * x));
        t[k] = clamp(node.x, R(0.0), sight.distance);
        dt[k] = node.y * dz;
        p[k] = density_integral(medium, sight.direction, t[k]);
        rho[k] = part == part_terms ? density_at(medium, t[k] * sight.direction) : R(0.0);
    }
    vec3 scattering = medium.scattering;
    for (int i = 0; i < sight.count; ++i) {
        Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, i);
        Profile profile = profile_along(g, vec3(R(0.0)), sight.direction);
        float before = erf(-profile.scale * profile.middle);
        float depth = R(0.886226925453) * profile.peak / profile.scale;
        for (int k = 0; k < panel_nodes; ++k)
            p[k] += depth * (erf(profile.scale * (t[k] - profile.middle)) - before);
        if (i == part) {
            scattering *= g.colour;
            for (int k = 0; k < panel_nodes; ++k)
                rho[k] = profile_density(profile, t[k]);
        }
    }
    vec3 sum = vec3(R(0.0));
    float value[8];
    for (int k = 0; k < panel_nodes; ++k) {
        vec3 f = vec3(R(0.0));
        float strength = rho[k] * lit_strength(medium, light, aspect, sight.direction, t[k]);
        if (strength > R(0.0)) {
            vec3 point = t[k] * sight.direction;
            float depth = p[k] + terms_to_light(medium, light, point) + shadow_density(SHADOW_PASSED, camera, index, light, point);
            f = min(strength * dt[k] * light.intensity, vec3(radiance_limit)) * scattering *
                transmittance(medium, clamp(depth, R(0.0), density_limit));
        }
        sum += panel_weight[k < 4 ? 3 - k : k - 4] * f;
        value[k] = (f.x + f.y + f.z) / R(3.0);
    }
    // How fast the integrand's Legendre coefficients 4 to 7 fall off tells how large those from 16 on are that the nodes
    // cannot see.
    float e0 = value[3] + value[4];
    float e1 = value[2] + value[5];
    float e2 = value[1] + value[6];
    float e3 = value[0] + value[7];
    float o0 = value[4] - value[3];
    float o1 = value[5] - value[2];
    float o2 = value[6] - value[1];
    float o3 = value[7] - value[0];
    float c4 = R(0.414176096737) * e0 - R(0.461585322597) * e1 - R(0.242896191478) * e2 + R(0.290305417338) * e3;
    float c5 = R(0.581608863449) * o0 + R(0.0535658110052) * o1 - R(0.493295376662) * o2 + R(0.268829358779) * o3;
    float c6 = -R(0.267389671426) * e0 + R(0.616604863503) * e1 - R(0.559107383143) * e2 + R(0.209892191067) * e3;
    float c7 = -R(0.784906557922) * o0 + R(0.631774553119) * o1 - R(0.377896937085) * o2 + R(0.117692456448) * o3;
    float lower = max(abs(c4), abs(c5));
    float upper = max(abs(c6), abs(c7));
    float fall = min(upper / max(lower, R(1e-37)), R(1.0));
    return Panel(sum, upper * fall * fall + R(2e-7) * (sum.x + sum.y + sum.z));
}

// The part of the ray where the constant and exponential terms scatter: from where P is a share of what it comes to before
// all is extinct to where it is nearly all of that.
PURE vec2 terms_range(IN(Medium) medium, IN(Sight) sight, vec2 lit)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float least = min(extinction.x > R(0.0) ? extinction.x : density_limit,
                      min(extinction.y > R(0.0) ? extinction.y : density_limit, extinction.z > R(0.0) ? extinction.z : density_limit));
    float opaque = R(18.0) / least;
    float end = min(lit.y, R(1e15));
    if (medium.term_count == 0)
        return vec2(lit.x, min(end, opaque / max(medium.constant, R(1e-30))));
    float whole = min(density_integral(medium, sight.direction, end), opaque);
    float far_low = lit.x;
    float far_high = end;
    float near_low = lit.x;
    float near_high = end;
    for (int i = 0; i < 12; ++i) {
        float m = far_high > R(4.0) * far_low + R(1e-3) ? sqrt(max(far_low, R(1e-3)) * far_high) : R(0.5) * (far_low + far_high);
        if (density_integral(medium, sight.direction, m) < R(0.999999) * whole)
            far_low = m;
        else
            far_high = m;
        m = near_high > R(4.0) * near_low + R(1e-3) ? sqrt(max(near_low, R(1e-3)) * near_high) : R(0.5) * (near_low + near_high);
        if (density_integral(medium, sight.direction, m) < R(1e-6) * whole)
            near_low = m;
        else
            near_high = m;
    }
    return vec2(near_low > R(0.1) * far_high ? near_low : lit.x, far_high);
}

PURE Airlight airlight_by_nodes(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                                IN(Sight) sight, int first_light, int last_light)
{
    Airlight total = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    bool terms = medium.constant > R(0.0) || medium.term_count > 0;
    for (int l = first_light; l < last_light; ++l) {
        Light light = light_at(lights, l);
        Aspect aspect = aspect_of(light, sight.direction);
        vec2 lit = lit_interval(light, sight.direction, sight.distance, light.cos_outer);
        for (int part = terms ? part_terms : 0; part < sight.count; ++part) {
            vec2 range = lit;
            Path path;
            if (part == part_terms) {
                range = terms_range(medium, sight, lit);
                if (range.x >= range.y)
                    continue;
                float h = max(aspect.height, light.radius);
                path = angle_path(light, aspect, range.x, range.y, range.y - max(aspect.foot, range.x) > h);
                if (light.type == light_directional) {
                    float scale = R(0.2) * range.y;
                    path = Path(path_decay, R(0.0), scale, R(0.0), one_minus_exp(range.y / scale), R(0.0));
                }
            } else {
                Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, part);
                float middle = dot(g.center, sight.direction);
                float reach = R(3.3) / g.scale;
                range = vec2(max(lit.x, middle - reach), min(lit.y, middle + reach));
                if (range.x >= range.y)
                    continue;
                // A light within the bell needs the angle.
                float x = max(abs(aspect.foot - middle) - reach, R(0.0));
                float near = max(aspect.height, x);
                if (light.type == light_directional || near * g.scale > settings.near_radii)
                    path = bell_path(middle, R(1.2) / g.scale, range.x, range.y);
                else
                    path = angle_path(light, aspect, range.x, range.y, false);
            }
            float z = R(0.0);
            float dz = R(1.0);
            int panels = settings.dense_nodes;
            while (z < R(1.0)) {
                Panel panel = panel_of(medium, camera, SHADOW_PASSED, tile_gaussians, sight, l, light, aspect, part, path, z, dz);
                --panels;
                float scale = (total.radiance.x + total.radiance.y + total.radiance.z + panel.sum.x + panel.sum.y + panel.sum.z) / R(3.0);
                if (panel.error > settings.near_radii * R(0.001) * scale && panels > 0) {
                    dz *= R(0.5);
                    continue;
                }
                total.radiance += panel.sum;
                total.error += vec3(panel.error);
                z += dz;
                dz = min(R(2.0) * dz, R(1.0) - z);
                if (panels <= 1)
                    dz = R(1.0) - z;
            }
        }
    }
    return Airlight(min(total.radiance, vec3(radiance_limit)), min(total.error, vec3(radiance_limit)));
}
