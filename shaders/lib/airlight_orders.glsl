// What lamps' light that has been scattered before scatters toward the camera: the orders of two and more.
// Needs airlight_parts.glsl, lamp_field.glsl, surroundings.glsl.

// How the fluence changes beside a plane that takes what falls on it; extinction: sigma_t r.
PURE float beside_planes(IN(Rescattered) light, float extinction)
{
    return exp(R(0.54) * log(max(extinction, R(1e-30)) / max(light.reduced, R(1e-30))));
}

// What a black plane leaves of that fluence, by the lamp's image in a plane below it. distance, lamp, point: of the two from each
// other and from the plane; beside: beside_planes(). What the plane gives back is the picture's light.
PURE float left_by_plane(IN(Rescattered) light, float beside, float distance, float lamp, float point)
{
    float per_length = light.reduced / max(distance, R(1e-20));
    float x = beside * (light.reduced + R(1.65) * per_length * (lamp + point));
    float below = R(0.72) * x / ((x + R(0.9)) * max(per_length, R(1e-20)));
    float aside = max(distance * distance - (lamp - point) * (lamp - point), R(0.0));
    float up = lamp + point + R(2.0) * below;
    float ratio = sqrt(aside + up * up) / max(distance, R(1e-20));
    if (!(ratio < R(1e15)))
        return R(1.0);
    return clamp(R(1.0) - exp(-light.kappa * max(ratio - R(1.0), R(0.0))) / max(ratio, R(1.0)), R(0.0), R(1.0));
}

// What all planes leave. Their logarithms add as squares, within a tenth for tunnels, rooms and cubes (lamp_calibration): light that one
// plane took no other can take. way: of the point from the lamp, in world axes.
PURE float left_by_planes(IN(Rescattered) light, float extinction, float distance, IN(Surroundings) around, vec3 way)
{
    float beside = beside_planes(light, extinction);
    float squares = R(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (around.low_weight[axis] > R(0.0)) {
            float left = left_by_plane(light, beside, distance, around.low[axis], max(around.low[axis] + way[axis], R(0.0)));
            float taken = around.low_weight[axis] * log(max(left, R(1e-12)));
            squares += taken * taken;
        }
        if (around.high_weight[axis] > R(0.0)) {
            float left = left_by_plane(light, beside, distance, around.high[axis], max(around.high[axis] - way[axis], R(0.0)));
            float taken = around.high_weight[axis] * log(max(left, R(1e-12)));
            squares += taken * taken;
        }
    }
    return exp(-sqrt(squares));
}

// Share of the scattered light, per steradian, that one more scattering turns into a direction at this cosine from the way from
// the lamp. With the weight and the g that light arrives with, its mean cosine is kept and the next moment is near.
PURE float turned_again(float asymmetry, float mean_cosine, float cosine)
{
    float k = sqrt(mean_cosine);
    return k * henyey_greenstein(asymmetry * k, cosine) + (R(1.0) - k) / (R(4.0) * pi);
}

// What a spot's scattered light has of its intensity at this cosine from its axis: part keeps to the cone, part spreads from its
// axis; as much in all as it emits. mean_cosine as above: where it is 0 the cone is forgotten.
PURE float spot_spread(IN(Light) light, float mean_cosine, float cosine)
{
    float rim = R(0.5) * (light.cos_inner + light.cos_outer);
    float kept = mean_cosine > R(0.0) ? exp(R(1.7) * log(mean_cosine)) : R(0.0);
    float lobe = R(0.5) * (R(1.0) + rim) * mean_cosine / (R(1.0) + mean_cosine);
    return kept * spot_factor(light, cosine) +
           (R(1.0) - kept) * R(0.5) * (R(1.0) - rim) * R(4.0) * pi * henyey_greenstein(lobe, cosine);
}

// int rho dt straight down from a point to the ground; huge where nobody knows of one beneath terms, and 0 beneath Gaussians alone.
// around: of a sun, which counts as standing where the camera is.
PURE float density_below(IN(Medium) medium, IN(Camera) camera, IN(Surroundings) around, vec3 point, vec3 up)
{
    if (medium.constant <= R(0.0) && medium.term_count == 0)
        return R(0.0);
    float distance = far_away;
    if (any_plane(around)) {
        vec3 up_in_world = in_world(camera, up);
        vec3 steep = abs(up_in_world);
        int axis = steep.x >= max(steep.y, steep.z) ? 0 : steep.y >= steep.z ? 1 : 2;
        bool low = up_in_world[axis] > R(0.0);
        float weight = low ? around.low_weight[axis] : around.high_weight[axis];
        float place = in_world(camera, point)[axis];
        float height = low ? around.low[axis] + place : around.high[axis] - place;
        // What covers little is as far away.
        distance = min(max(height, R(0.0)) / max(steep[axis] * weight, R(1e-6)), far_away);
    }
    return density_between(medium, point, -up, distance, distance);
}

// What a sun's light does that has been scattered before: slab_field() above a black ground, whose own light is the picture's, and
// of the forward peak what does not come straight.
PURE vec3 rescattered_sun(IN(Medium) medium, IN(Camera) camera, IN(Light) light, IN(Surroundings) around, vec3 direction, float t,
                          float depth)
{
    vec3 point = t * direction;
    SunSlant slant = sun_slant(medium, light.direction, point);
    float above = depth * slant.cosine;
    vec2 p = min(vec2(above, above + density_below(medium, camera, around, point, slant.up)), vec2(density_limit));
    float g = medium.asymmetry;
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && medium.scattering[c] == medium.scattering[c - 1] && medium.absorption[c] == medium.absorption[c - 1]) {
            sum[c] = sum[c - 1];
            continue;
        }
        SlabField field = slab_field(medium.scattering[c] * p, medium.absorption[c] * p, g, R(1.0), slant.cosine, R(0.0));
        float straight = exp(-min((medium.scattering[c] + medium.absorption[c]) * depth, orders_depth_limit));
        sum[c] = slab_source(field, g, straight, -dot(light.direction, direction), dot(direction, slant.up));
    }
    return min(min(sum, vec3(radiance_limit)) * light.intensity, vec3(radiance_limit));
}

// The source toward the camera at t over sigma_s. depth: int rho dt between light and point.
PURE vec3 rescattered_strength(IN(Medium) medium, IN(Camera) camera, IN(Light) light, IN(Aspect) aspect, IN(Surroundings) around,
                               vec3 direction, float t, float depth)
{
    if (light.type == light_directional)
        return rescattered_sun(medium, camera, light, around, direction, t, depth);
    vec3 from = t * direction - light.position;
    float x = t - aspect.foot;
    float d = sqrt(aspect.height * aspect.height + x * x);
    float strength = fluence(d, light.radius);
    float off_axis = dot(from, light.direction) / max(length(from), R(1e-20));
    bool enclosed = any_plane(around);
    vec3 way = enclosed ? in_world(camera, from) : vec3(R(0.0));
    vec3 sum = vec3(R(0.0));
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && medium.scattering[c] == medium.scattering[c - 1] && medium.absorption[c] == medium.absorption[c - 1]) {
            sum[c] = sum[c - 1];
            continue;
        }
        float scattering = min(medium.scattering[c] * depth, orders_depth_limit);
        float absorption = min(medium.absorption[c] * depth, orders_depth_limit);
        Rescattered r = rescattered(scattering, absorption, medium.asymmetry);
        float share = R(1.0);
        float cosine = r.cosine;
        if (enclosed) {
            share = left_by_planes(r, scattering + absorption, d, around, way);
            // They take first what goes far aside.
            cosine = min(cosine / max(sqrt(share), R(1e-6)), R(1.0));
        }
        sum[c] = r.fluence * share * turned_again(medium.asymmetry, cosine, -x / d);
        if (light.type == light_spot)
            sum[c] *= spot_spread(light, r.cosine, off_axis);
    }
    return min(min(strength * sum, vec3(radiance_limit)) * light.intensity, vec3(radiance_limit));
}

// The integral over a part of the medium along a path's z in [z, z + dz].
PURE Panel orders_panel(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, SHADOW_IMAGES, sampler2D tile_gaussians,
                        IN(Sight) sight, int index, IN(Light) light, IN(Surroundings) around, IN(Aspect) aspect, int part,
                        IN(Path) path, float z, float dz)
{
    float t[8];
    float p[8];
    float mass[8];
    for (int k = 0; k < panel_nodes; ++k) {
        float x = k < 4 ? -panel_node[3 - k] : panel_node[k - 4];
        vec2 node = on_path(path, z + dz * (R(0.5) + R(0.5) * x));
        t[k] = clamp(node.x, R(0.0), sight.distance);
        p[k] = density_integral(medium, sight.direction, t[k]);
        mass[k] = min(node.y * dz * (part == part_terms ? density_at(medium, t[k] * sight.direction) : R(1.0)), radiance_limit);
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
                mass[k] = min(mass[k] * profile_density(profile, t[k]), radiance_limit);
        }
    }
    vec3 sum = vec3(R(0.0));
    float value[8];
    for (int k = 0; k < panel_nodes; ++k) {
        vec3 f = vec3(R(0.0));
        if (mass[k] > R(0.0)) {
            vec3 point = t[k] * sight.direction;
            float depth = terms_to_light(medium, light, point) + shadow_density(light_gaussians, camera, index, light, point);
            f = rescattered_strength(medium, camera, light, aspect, around, sight.direction, t[k],
                                     clamp(depth, R(0.0), density_limit));
            f = min(min(f, vec3(radiance_limit)) * mass[k], vec3(radiance_limit)) *
                transmittance(medium, clamp(p[k], R(0.0), density_limit));
            f = min(f * scattering, vec3(radiance_limit));
        }
        value[k] = (f.x + f.y + f.z) / R(3.0);
        sum += panel_weight[k < 4 ? 3 - k : k - 4] * f;
    }
    vec2 rest = panel_rest(value);
    return Panel(sum, rest.x * rest.y, rest.x * rest.y * rest.y);
}

// All that a light's scattered light adds to the ray, beside what the ray has already. It falls off as 1 / r from a lamp, which
// t = foot + h sinh(z) flattens.
PURE Airlight lamp_orders(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, SHADOW_IMAGES,
                          sampler2D tile_gaussians, IN(Sight) sight, int index, IN(Light) light, IN(Surroundings) around, vec3 terms,
                          vec3 beside)
{
    Airlight sum = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    bool sun = light.type == light_directional;
    Aspect aspect = aspect_of(light, sight.direction);
    float h = max(aspect.height, light.radius);
    float others = (beside.x + beside.y + beside.z) / R(3.0);
    for (int part = part_terms; part < sight.count; ++part) {
        vec2 range = vec2(terms.x, terms.y);
        float middle = aspect.foot;
        float width = h;
        if (part != part_terms) {
            Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, part);
            float center = sight_profile(medium, camera, g, sight.direction).middle;
            float radius = R(1.0) / g.scale;
            range = vec2(max(center - R(4.0) * radius, R(0.0)), min(center + R(4.0) * radius, min(sight.distance, quadrature_limit)));
            float x = max(max(range.x - aspect.foot, aspect.foot - range.y), R(0.0));
            if (sun || max(h, x) > settings.near_radii * radius) {
                middle = center;
                width = R(1.2) * radius;
            }
        }
        if (range.x >= range.y)
            continue;
        // About a distant foot, floats keep of a short range little or nothing: in dense media, or before near surfaces.
        float away = max(aspect.height, max(range.x - aspect.foot, aspect.foot - range.y));
        bool fades = part == part_terms && (sun || away > R(100.0) * (range.y - range.x));
        Path path = fades ? terms_path(medium, light, aspect, range, terms.z) : bell_path(middle, width, range.x, range.y);
        int left = settings.panels;
        float z = R(0.0);
        float dz = R(1.0);
        while (z < R(1.0)) {
            Panel panel =
                orders_panel(medium, camera, settings, SHADOW_PASSED, tile_gaussians, sight, index, light, around, aspect, part, path,
                             z, dz);
            --left;
            vec3 so_far = sum.radiance + panel.sum;
            if (panel.doubt > settings.tolerance * (others + (so_far.x + so_far.y + so_far.z) / R(3.0)) && left > 0) {
                dz *= R(0.5);
                continue;
            }
            sum.radiance += panel.sum;
            sum.error += vec3(panel.error);
            z += dz;
            dz = left > 1 ? min(R(2.0) * dz, R(1.0) - z) : R(1.0) - z;
        }
    }
    return sum;
}

PURE Airlight orders_by_parts(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES, IN(Sight) sight,
                              int first_light, int last_light, vec3 single)
{
    vec3 terms = medium.constant > R(0.0) || medium.term_count > 0 ? terms_range(medium, sight) : vec3(R(0.0));
    Airlight sum = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    for (int l = first_light; l < last_light; ++l) {
        Airlight one = lamp_orders(medium, camera, settings, SHADOW_PASSED, tile_gaussians, sight, l, light_at(lights, l),
                                   surroundings_of(surroundings, l), terms, single + sum.radiance);
        sum.radiance += one.radiance;
        sum.error += one.error;
    }
    return sum;
}
