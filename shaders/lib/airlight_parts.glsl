// The tier `nodes` where few Gaussians lie along the ray: Gauss-Legendre panels with exact optical depths at each node.
// Needs airlight.glsl.

// The part of the integral that a panel is of.
const int part_terms = -1;  // constant and exponential terms; 0 and up: that entry of the tile's list

// Substitution of the ray parameter t by z in [0, 1] that flattens the integrand.
const int path_angle = 0;   // t = foot + height tan(from + span y(z)): 1/d^2 is constant in it
const int path_decay = 1;   // t = foot - height log(1 - span z): parallel light
const int path_bell = 2;    // t = foot + height sinh(from + span z): a Gaussian
const int path_peak = 3;    // t = foot + height (u - 1/u) / 2, u = tan(turn / 2) = width sinh(from + span z): the peak of a
                            // phase function about light that is hardly turned

struct Path {
    int kind;
    float foot;
    float height;
    float from;
    float span;
    float width;
    int crowded;    // path_angle: where the nodes are to crowd: nowhere, at the far end, at both
};

// Nothing farther is integrated: squares of distances stay finite in 32 bits.
const float quadrature_limit = R(1e15);  // [m]

struct Panel {
    vec3 sum;
    float error;  // estimate for the mean of the sum's colours
    float doubt;  // the same without trust in a fast convergence
};

const int panel_nodes = 8;
const float panel_node[4] = {R(0.183434642495650), R(0.525532409916329), R(0.796666477413627), R(0.960289856497536)};
const float panel_weight[4] = {R(0.181341891689181), R(0.156853322938944), R(0.111190517226687), R(0.0506142681451881)};

// t and dt/dz.
PURE vec2 on_path(IN(Path) path, float z)
{
    if (path.kind == path_decay) {
        float rest = R(1.0) - path.span * z;
        return vec2(path.foot - path.height * log(rest), path.height * path.span / rest);
    }
    if (path.kind == path_bell) {
        float e = exp(path.from + path.span * z);
        return vec2(path.foot + R(0.5) * path.height * (e - R(1.0) / e), R(0.5) * path.height * (e + R(1.0) / e) * path.span);
    }
    if (path.kind == path_peak) {
        float e = exp(path.from + path.span * z);
        float u = max(R(0.5) * path.width * (e - R(1.0) / e), R(1e-18));
        float slope = R(0.5) * path.width * (e + R(1.0) / e) * path.span;
        return vec2(path.foot + R(0.5) * path.height * (u - R(1.0) / u), R(0.5) * path.height * (R(1.0) + R(1.0) / (u * u)) * slope);
    }
    float y = z;
    float slope = path.span;
    if (path.crowded == 1) {
        y = z * (R(2.0) - z);
        slope *= R(2.0) - R(2.0) * z;
    } else if (path.crowded == 2) {
        y = z * z * (R(3.0) - R(2.0) * z);
        slope *= R(6.0) * z * (R(1.0) - z);
    }
    float c = cos(path.from + path.span * y);
    return vec2(path.foot + path.height * tan(path.from + path.span * y), slope * path.height / (c * c));
}

PURE Path angle_path(IN(Light) light, IN(Aspect) aspect, float from, float to, int crowded)
{
    float h = max(aspect.height, light.radius);
    float a = from - aspect.foot;
    float b = to - aspect.foot;
    return Path(path_angle, aspect.foot, h, atan(a, h), atan(h * (to - from), h * h + a * b), R(0.0), crowded);
}

PURE float asinh_of(float x)
{
    float y = abs(x);
    float s = y < R(1e9) ? log(y + sqrt(y * y + R(1.0))) : log(y) + R(0.69314718056);
    return x < R(0.0) ? -s : s;
}

PURE Path bell_path(float middle, float width, float from, float to)
{
    float a = asinh_of((from - middle) / width);
    return Path(path_bell, middle, width, a, asinh_of((to - middle) / width) - a, R(0.0), 0);
}

// tan(turn / 2) at x from the foot: (x + sqrt(x^2 + h^2)) / h.
PURE float half_turn_tangent(float x, float h)
{
    float d = sqrt(x * x + h * h);
    return x < R(0.0) ? h / (d - x) : (d + x) / h;
}

// How fast an integrand's Legendre coefficients 4 to 7 fall off tells how large those from 16 on are that the nodes cannot see:
// x the larger of the last two, y their ratio to the two before.
PURE vec2 panel_rest(float value[8])
{
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
    return vec2(upper, min(upper / max(lower, R(1e-37)), R(1.0)));
}

// A panel of these nodes' sum and values, and of the rounding errors that they come to.
PURE Panel finished_panel(IN(Path) path, float dz, vec3 sum, float value[8], float noise)
{
    vec2 rest = panel_rest(value);
    float upper = rest.x;
    float fall = rest.y;
    float error = upper * fall * fall * fall;
    if (path.kind == path_bell)
        error = dz == R(1.0) ? R(0.04) * upper * fall : R(0.5) * error * fall;
    else if (path.crowded == 2)
        error = dz == R(1.0) ? R(0.35) * upper * fall : R(0.7) * error * fall;
    else if (path.crowded == 0)
        error *= R(2.0) * fall;
    return Panel(sum, error + R(9e-8) * noise, upper * fall * fall);
}

// The integral over z in [z, z + dz].
PURE Panel panel_of(IN(Medium) medium, IN(Camera) camera, SHADOW_IMAGES, sampler2D tile_gaussians, IN(Sight) sight, int index,
                    IN(Light) light, IN(Aspect) aspect, IN(TermEnds) ends, int part, IN(Path) path, float z, float dz)
{
    float t[8];
    float dt[8];
    float p[8];
    float rho[8];
    float to_light[8];
    for (int k = 0; k < panel_nodes; ++k) {
        float x = k < 4 ? -panel_node[3 - k] : panel_node[k - 4];
        vec2 node = on_path(path, z + dz * (R(0.5) + R(0.5) * x));
        t[k] = clamp(node.x, R(0.0), sight.distance);
        dt[k] = node.y * dz;
        TermsAt terms = terms_at(medium, ends, light, sight.direction, t[k]);
        p[k] = terms.from_camera;
        to_light[k] = terms.from_light;
        rho[k] = part == part_terms ? terms.density : R(0.0);
    }
    vec3 scattering = medium.scattering;
    for (int i = 0; i < sight.count; ++i) {
        Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, i);
        Profile profile = sight_profile(medium, camera, g, sight.direction);
        float before = erf(-profile.scale * profile.middle);
        float depth = R(0.886226925453) * profile_length(profile);
        for (int k = 0; k < panel_nodes; ++k)
            p[k] += depth * (erf(profile.scale * (t[k] - profile.middle)) - before);
        if (i == part) {
            scattering *= g.color;
            for (int k = 0; k < panel_nodes; ++k)
                rho[k] = profile_density(profile, t[k]);
        }
    }
    vec3 sum = vec3(R(0.0));
    // Rounding: exponents lose as many digits as they have before the point, and so do narrow angles and penumbras.
    float noise = R(0.0);
    float digits = R(6.0);
    if (light.type != light_directional)
        digits += R(0.1) * length(light.position) / aspect.height;
    if (light.type == light_spot)
        digits += R(0.7) / max(light.cos_inner - light.cos_outer, R(1e-4));
    float value[8];
    for (int k = 0; k < panel_nodes; ++k) {
        vec3 f = vec3(R(0.0));
        float depth = R(0.0);
        float strength = min(rho[k] * lit_strength(medium, light, aspect, sight.direction, t[k]), radiance_limit);
        if (strength > R(0.0)) {
            vec3 point = t[k] * sight.direction;
            float p_all = p[k] + to_light[k] + shadow_density(light_gaussians, camera, index, light, point);
            vec3 tau = optical_depth(medium, clamp(p_all, R(0.0), density_limit));
            f = min(min(strength * dt[k], radiance_limit) * light.intensity, vec3(radiance_limit)) * exp(-tau);
            f = min(f * scattering, vec3(radiance_limit));
            depth = min(tau.y, R(100.0));
        }
        value[k] = (f.x + f.y + f.z) / R(3.0);
        float weight = panel_weight[k < 4 ? 3 - k : k - 4];
        sum += weight * f;
        noise += weight * value[k] * (digits + depth);
    }
    return finished_panel(path, dz, sum, value, noise);
}

// What is sought to tell where the constant and exponential terms scatter.
struct TermsSought {
    float end;
    float least;  // extinction of a colour
    float whole;  // P at the end, or where all is extinct
    vec3 share;   // of P, where their place is sought
};

PURE TermsSought terms_sought(IN(Medium) medium, IN(Sight) sight)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float least = density_limit;
    for (int c = 0; c < 3; ++c)
        if (extinction[c] > R(0.0))
            least = min(least, extinction[c]);
    float end = min(sight.distance, quadrature_limit);
    float whole = medium.term_count == 0 ? R(0.0) : min(density_integral(medium, sight.direction, end), R(18.0) / least);
    return TermsSought(end, least, whole, vec3(R(1e-6) * whole, R(0.999999) * whole, min(R(0.63) * whole, R(1.0) / least)));
}

// Logarithms of distances, which range from millimetres to the sky: places are sought in fifths of fifths of fifths of them.
const float log_nearest = R(-6.90775527898);  // of a millimetre
const int terms_fifths = 3;

// low: logarithms of places of the shares, each within a width.
PURE vec3 terms_found(IN(Medium) medium, IN(TermsSought) sought, vec3 low, float width)
{
    if (medium.term_count == 0) {
        float length = R(1.0) / max(sought.least * medium.constant, R(1e-30));
        return vec3(R(0.0), min(sought.end, R(18.0) * length), min(sought.end, length));
    }
    float first = exp(low.x);
    float last = exp(low.y + width);
    // Light that comes through the dense part may come alive only where that share is spent.
    float reach = sought.whole * sought.least < R(18.0) ? R(2.0) * last : last;
    return vec3(first > R(0.1) * last ? first : R(0.0), min(reach, sought.end), min(exp(low.z + width), sought.end));
}

// The part of the ray where the constant and exponential terms scatter: x, y from where P is a share of what it comes to
// before all is extinct to where it is nearly all of that; z the length over which that falls off.
PURE vec3 terms_range(IN(Medium) medium, IN(Sight) sight)
{
    TermsSought sought = terms_sought(medium, sight);
    vec3 low = vec3(log_nearest);
    float width = max(log(max(sought.end, R(1e-3))) - log_nearest, R(0.0));
    for (int level = 0; level < terms_fifths && medium.term_count > 0; ++level) {
        width *= R(0.2);
        for (int i = 0; i < 3; ++i) {
            float from = low[i];
            for (int k = 1; k < 5; ++k)
                if (density_integral(medium, sight.direction, exp(from + float(k) * width)) < sought.share[i])
                    low[i] = from + float(k) * width;
        }
    }
    return terms_found(medium, sought, low, width);
}

// The path over [range.x, range.y] for a part that falls off over `decay`.
PURE Path terms_path(IN(Medium) medium, IN(Light) light, IN(Aspect) aspect, vec2 range, float decay)
{
    float length = range.y - range.x;
    float x = max(max(range.x - aspect.foot, aspect.foot - range.y), R(0.0));
    if (light.type == light_directional || max(aspect.height, x) > length) {
        // The logarithm of what floats leave of 1 - z reaches no farther than 18 lengths.
        float scale = max(decay, length / R(18.0));
        return Path(path_decay, range.x, scale, R(0.0), one_minus_exp(length / scale), R(0.0), 0);
    }
    float h = max(aspect.height, light.radius);
    float g = min(medium.phase.x, largest_asymmetry);
    float first = half_turn_tangent(range.x - aspect.foot, h);
    float width = R(0.5) * (R(1.0) - g) / sqrt(max(g, R(0.1)));
    if (g > R(0.4) && first < R(4.0) * width) {
        float a = asinh_of(first / width);
        return Path(path_peak, aspect.foot, h, a, asinh_of(half_turn_tangent(range.y - aspect.foot, h) / width) - a, width, 0);
    }
    bool passes = range.y - max(aspect.foot, range.x) > h;
    return angle_path(light, aspect, range.x, range.y, passes ? 1 : 0);
}

// The path over a Gaussian. A light within it needs the angle, and nodes at both ends of what then is a plateau.
PURE Path blob_path(IN(Light) light, IN(Aspect) aspect, float middle, float radius, vec2 range, float near_radii)
{
    float x = max(max(range.x - aspect.foot, aspect.foot - range.y), R(0.0));
    if (light.type == light_directional || max(aspect.height, x) > near_radii * radius)
        return bell_path(middle, R(1.2) * radius, range.x, range.y);
    return angle_path(light, aspect, range.x, range.y, 2);
}

// In how many parts a ray is integrated, for what a light sends has kinks: at the edges of a spot's cones and of a lamp's ball.
PURE int lit_pieces(IN(Light) light, IN(Aspect) aspect)
{
    return light.type == light_spot || (light.type == light_point && aspect.height < light.radius) ? 3 : 1;
}

PURE vec2 lit_piece(IN(Light) light, IN(Aspect) aspect, vec3 direction, float distance, int piece)
{
    vec2 outer = lit_interval(light, direction, distance, light.cos_outer);
    vec2 inner = vec2(R(1.0), R(0.0));
    if (light.type == light_spot) {
        inner = lit_interval(light, direction, distance, light.cos_inner);
    } else if (lit_pieces(light, aspect) > 1) {
        float half_chord = sqrt((light.radius - aspect.height) * (light.radius + aspect.height));
        inner = clamp(vec2(aspect.foot - half_chord, aspect.foot + half_chord), R(0.0), distance);
    }
    if (inner.x >= inner.y)
        return piece == 0 ? outer : vec2(R(1.0), R(0.0));
    inner = clamp(inner, vec2(outer.x), vec2(outer.y));
    return piece == 0 ? vec2(outer.x, inner.x) : piece == 1 ? inner : vec2(inner.y, outer.y);
}

// Where a term or Gaussian is integrated.
struct Span {
    bool empty;
    Path path;
};

PURE Span span_of(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, sampler2D gaussians,
                  sampler2D tile_gaussians, IN(Sight) sight, IN(Light) light, IN(Aspect) aspect, int part, vec3 terms, vec2 lit)
{
    if (part == part_terms) {
        vec2 range = vec2(max(lit.x, terms.x), min(lit.y, terms.y));
        return Span(range.x >= range.y, terms_path(medium, light, aspect, range, terms.z));
    }
    Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, part);
    float middle = sight_profile(medium, camera, g, sight.direction).middle;
    float radius = R(1.0) / g.scale;
    vec2 range = vec2(max(lit.x, middle - R(4.0) * radius), min(lit.y, middle + R(4.0) * radius));
    return Span(range.x >= range.y, blob_path(light, aspect, middle, radius, range, settings.near_radii));
}

// Adds what one light sends from a part of the ray that no map has in shadow: each term and Gaussian by itself, panel by panel,
// halving those whose error is too large for the whole.
PURE Airlight light_by_parts(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, SHADOW_IMAGES,
                             sampler2D tile_gaussians, IN(Sight) sight, int index, IN(Light) light, IN(Aspect) aspect, bool has_terms,
                             vec3 terms, vec2 within, Airlight total)
{
    TermEnds ends = term_ends(medium, light);
    for (int piece = 0; piece < lit_pieces(light, aspect); ++piece) {
        vec2 lit = lit_piece(light, aspect, sight.direction, min(sight.distance, quadrature_limit), piece);
        lit = vec2(max(lit.x, within.x), min(lit.y, within.y));
        if (lit.x >= lit.y)
            continue;
        for (int part = has_terms ? part_terms : 0; part < sight.count; ++part) {
            Span span = span_of(medium, camera, settings, gaussians, tile_gaussians, sight, light, aspect, part, terms, lit);
            if (span.empty)
                continue;
            int left = settings.panels;
            float z = R(0.0);
            float dz = span.path.crowded == 1 ? R(0.5) : R(1.0);
            while (z < R(1.0)) {
                Panel panel = panel_of(medium, camera, SHADOW_PASSED, tile_gaussians, sight, index, light, aspect, ends, part, span.path,
                                       z, dz);
                --left;
                vec3 so_far = total.radiance + panel.sum;
                if (panel.doubt > settings.tolerance * (so_far.x + so_far.y + so_far.z) / R(3.0) && left > 0) {
                    dz *= R(0.5);
                    continue;
                }
                total.radiance += panel.sum;
                total.error += vec3(panel.error);
                z += dz;
                dz = left > 1 ? min(R(2.0) * dz, R(1.0) - z) : R(1.0) - z;
            }
        }
    }
    return total;
}

// lamp_order, order: lamp_order.glsl; -1: the lights in their own order, all of them.
PURE Airlight airlight_by_parts(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                                IN(Sight) sight, sampler2D lamp_order, int order, int first_light, int last_light)
{
    Airlight total = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    bool has_terms = medium.constant > R(0.0) || medium.term_count > 0;
    vec3 terms = has_terms ? terms_range(medium, sight) : vec3(R(0.0));
    float end = min(sight.distance, quadrature_limit);
    float reach = sight.count > 0 ? end : terms.y;
    for (int i = first_light; i < last_light; ++i) {
        int l = i;
        if (order >= 0) {
            vec4 place = data_texel(lamp_order, order + i);
            if (place.y <= settings.spared * (total.radiance.x + total.radiance.y + total.radiance.z) / R(3.0)) {
                total.error += vec3(place.y);
                break;
            }
            l = int(place.x);
        }
        Light light = light_at(lights, l);
        Aspect aspect = aspect_of(light, sight.direction);
        ShadowRay ray = shadow_ray(camera, SHADOW_MAP_PASSED, settings.shadowed, l, sight.direction, reach);
        LitWalk walk = next_lit(shadow_maps, ray, lit_walk(R(0.0)), end);
        while (walk.part.x < walk.part.y) {
            total = light_by_parts(medium, camera, settings, SHADOW_PASSED, tile_gaussians, sight, l, light, aspect, has_terms, terms,
                                   walk.part, total);
            walk = next_lit(shadow_maps, ray, walk, end);
        }
    }
    return total;
}
