// The tier `nodes` where many Gaussians lie along the ray: their summed density in cells. Needs airlight_orders.glsl, tiles.glsl.
//
// Between two edges the mass, its centroid and the transmittance to the camera are exact (erf and exp of each Gaussian at the
// edges), whatever the density does there, and only the light is taken as it is at the centroid. That is of second order, but
// costs (edges + cells) per Gaussian where parts cost Gaussians squared, and what depends on the view serves all lights.
// Where the light varies too much from cell to cell, a second round moves the edges to there, and a third takes as many cells
// as the second's error asks for, so many at a time.

const int max_cells = 32;  // at a time
const int coarse_cells = 16;
const int most_batches = 32;

// Edge k of `count` + 1 over the ray: most within the Gaussians, a few before and behind in growing steps.
PURE float coarse_edge(vec2 blobs, float end, int k)
{
    if (k == 0)
        return R(0.0);
    if (k == 1)
        return R(0.5) * blobs.x;
    if (k <= coarse_cells - 2)
        return mix(blobs.x, blobs.y, float(k - 2) / float(coarse_cells - 4));
    return k == coarse_cells - 1 ? blobs.y + R(0.2) * (end - blobs.y) : end;
}

// A light's mean over a cell, and where of the cell that comes from.
struct CellLight {
    float strength;
    float place;
};

// center: of the cell's mass, where its light is taken unless a spot's rim crosses it. There the pieces between the edges of its cones are
// integrated by themselves, the density rising or falling evenly to that center: a beam may be much narrower than a cell.
PURE CellLight light_of_cell(IN(Medium) medium, IN(Light) light, IN(Aspect) aspect, vec3 direction, vec2 outer, vec2 inner, float from,
                             float to, float center)
{
    if (light.type != light_spot || (from >= inner.x && to <= inner.y))
        return CellLight(lit_strength(medium, light, aspect, direction, center), center);
    float width = max(to - from, R(1e-20));
    float middle = R(0.5) * (from + to);
    float tilt = clamp(R(12.0) * (center - middle) / width, R(-2.0), R(2.0)) / width;
    float sum = R(0.0);
    float arm = R(0.0);
    for (int piece = 0; piece < 3; ++piece) {
        float a = max(from, piece == 0 ? outer.x : piece == 1 ? inner.x : inner.y);
        float b = min(to, piece == 0 ? inner.x : piece == 1 ? inner.y : outer.y);
        for (int k = -1; k <= 1 && a < b; ++k) {
            float t = R(0.5) * (a + b) + R(0.387298334621) * float(k) * (b - a);
            float mass = (b - a) * (k == 0 ? R(8.0 / 18.0) : R(5.0 / 18.0)) * (R(1.0) + tilt * (t - middle));
            float part = mass * lit_strength(medium, light, aspect, direction, t);
            sum += part;
            arm += part * (t - from);
        }
    }
    return CellLight(sum / width, sum > R(0.0) ? from + arm / sum : center);
}

PURE Airlight airlight_by_cells(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                                IN(Sight) sight, int first_light, int last_light)
{
    bool has_terms = medium.constant > R(0.0) || medium.term_count > 0;
    vec3 extinction = medium.scattering + medium.absorption;
    // In short lists the tails that a ray passes are what dim pixels have.
    bool abridged = sight.count > 64;

    vec2 blobs = vec2(far_away, R(0.0));
    for (int i = 0; i < sight.count; ++i) {
        Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, i);
        Profile profile = sight_profile(medium, camera, g, sight.direction);
        if (abridged && passed_by(medium, g, profile))
            continue;
        float middle = profile.middle;
        blobs = vec2(min(blobs.x, middle - R(3.0) / g.scale), max(blobs.y, middle + R(3.0) / g.scale));
    }
    float end = min(min(sight.distance, quadrature_limit), max(has_terms ? terms_range(medium, sight).y : R(0.0), blobs.y));
    blobs = blobs.x < blobs.y ? clamp(blobs, vec2(R(0.0)), vec2(end)) : vec2(R(0.0), end);

    // The first round's knots, and what the cells between them matter: half their visible mass, half that times the light.
    float knot[max_cells + 1];
    float weight[max_cells];
    float p[coarse_cells + 1];
    for (int k = 0; k <= coarse_cells; ++k) {
        knot[k] = coarse_edge(blobs, end, k);
        p[k] = density_integral(medium, sight.direction, knot[k]);
    }
    for (int i = 0; i < sight.count; ++i) {
        Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, i);
        Profile profile = sight_profile(medium, camera, g, sight.direction);
        if (abridged && passed_by(medium, g, profile))
            continue;
        float before = erf(-profile.scale * profile.middle);
        float depth = R(0.886226925453) * profile_length(profile);
        for (int k = 0; k <= coarse_cells; ++k)
            p[k] += depth * (erf(profile.scale * (knot[k] - profile.middle)) - before);
    }
    float mass[coarse_cells];
    float lit[coarse_cells];
    float all_mass = R(1e-30);
    float all_lit = R(1e-30);
    for (int k = 0; k < coarse_cells; ++k) {
        // Differences of erf times a dense Gaussian may round below nothing.
        float dp = min(max(p[k + 1] - p[k], R(0.0)), density_limit);
        vec3 tau = extinction * dp;
        vec3 seen = dp * transmittance(medium, clamp(p[k], R(0.0), density_limit)) * medium.scattering *
                    vec3(mean_exponential(tau.x), mean_exponential(tau.y), mean_exponential(tau.z));
        mass[k] = min(seen.x + seen.y + seen.z, radiance_limit);
        lit[k] = R(0.0);
        all_mass += mass[k];
    }
    for (int l = first_light; l < last_light; ++l) {
        Light light = light_at(lights, l);
        if (light.type == light_directional)
            continue;
        Aspect aspect = aspect_of(light, sight.direction);
        float h = max(aspect.height, light.radius);
        vec2 cone = lit_interval(light, sight.direction, end, light.cos_outer);
        for (int k = 0; k < coarse_cells; ++k) {
            float from = max(knot[k], cone.x);
            float to = min(knot[k + 1], cone.y);
            if (from >= to)
                continue;
            float angle = atan(h * (to - from), h * h + (from - aspect.foot) * (to - aspect.foot));
            float share = mass[k] * angle / (h * max(knot[k + 1] - knot[k], R(1e-20)));
            lit[k] += share;
            all_lit += share;
        }
    }
    for (int k = 0; k < coarse_cells; ++k)
        weight[k] = all_lit > R(1e-29) ? mass[k] / all_mass + lit[k] / all_lit : mass[k];

    Airlight total = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    int knots = coarse_cells;
    int steps = clamp(settings.cells, 1, max_cells);
    int batches = 1;
    for (int round = 0; round < 3; ++round) {
        float whole = R(1e-30);
        for (int k = 0; k < knots; ++k)
            whole += weight[k];
        float edge[max_cells + 1];
        float error_of[max_cells];
        int k = 0;
        float passed = R(0.0);
        total = Airlight(vec3(R(0.0)), vec3(R(0.0)));
        for (int batch = 0; batch < batches; ++batch) {
            float to[max_cells + 1];       // P there
            float moment[max_cells + 1];   // int rho (t - blobs.x) dt
            vec3 coloured[max_cells + 1];  // int colour rho dt
            for (int j = 0; j <= steps; ++j) {
                if (j == 0 && batch > 0) {
                    edge[0] = edge[steps];
                } else {
                    float target = whole * float(batch * steps + j) / float(batches * steps);
                    while (k < knots - 1 && passed + weight[k] < target) {
                        passed += weight[k];
                        ++k;
                    }
                    edge[j] = mix(knot[k], knot[k + 1], clamp((target - passed) / max(weight[k], R(1e-30)), R(0.0), R(1.0)));
                }
                if (j == steps && batch == batches - 1)
                    edge[j] = end;
                to[j] = density_integral(medium, sight.direction, edge[j]);
                moment[j] = R(0.0);
                coloured[j] = vec3(to[j]);
            }
            for (int i = 0; i < sight.count; ++i) {
                Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, i);
                Profile profile = sight_profile(medium, camera, g, sight.direction);
                if (abridged && passed_by(medium, g, profile))
                    continue;
                float before = erf(-profile.scale * profile.middle);
                float depth = R(0.886226925453) * profile_length(profile);
                float arm = profile.middle - blobs.x;
                for (int j = 0; j <= steps; ++j) {
                    float x = min(profile.scale * abs(edge[j] - profile.middle), gaussian_limit);
                    float part = depth * (erf(profile.scale * (edge[j] - profile.middle)) - before);
                    to[j] += part;
                    moment[j] += arm * part - R(0.5) * profile_length(profile) / profile.scale * exp(-x * x);
                    coloured[j] += g.color * part;
                }
            }
            // From here on: the centroid in `moment`, what is visible of the mass in `coloured`.
            for (int j = 0; j < steps; ++j) {
                float dp = max(to[j + 1] - to[j], R(0.0));
                float terms = density_integral(medium, sight.direction, edge[j + 1]) - density_integral(medium, sight.direction, edge[j]);
                // The terms' own centroid is near enough to the middle.
                float center = moment[j + 1] - moment[j] + terms * (R(0.5) * (edge[j] + edge[j + 1]) - blobs.x);
                float place = blobs.x + center / max(dp, R(1e-30));
                // The moments of Gaussians of 1e30 m overflow.
                moment[j] = clamp(is_finite(place) ? place : R(0.5) * (edge[j] + edge[j + 1]), edge[j], edge[j + 1]);
                vec3 tau = extinction * dp;
                // The cross-sections last: apart from what they attenuate they overflow.
                coloured[j] = max(coloured[j + 1] - coloured[j], R(-1e-5) * coloured[j]) *
                              vec3(mean_exponential(tau.x), mean_exponential(tau.y), mean_exponential(tau.z)) *
                              transmittance(medium, clamp(to[j], R(0.0), density_limit)) * medium.scattering;
                error_of[j] = R(0.0);
            }
            for (int l = first_light; l < last_light; ++l) {
                Light light = light_at(lights, l);
                Aspect aspect = aspect_of(light, sight.direction);
                Surroundings around = open_surroundings();
                if (settings.orders == orders_all)
                    around = surroundings_of(surroundings, l);
                ShadowRay ray = shadow_ray(camera, SHADOW_MAP_PASSED, settings.shadowed, l, sight.direction, end);
                vec2 outer = lit_interval(light, sight.direction, end, light.cos_outer);
                vec2 inner = lit_interval(light, sight.direction, end, light.cos_inner);
                if (inner.x >= inner.y)
                    inner = vec2(outer.y);
                inner = clamp(inner, vec2(outer.x), vec2(max(outer.x, outer.y)));
                vec3 before = vec3(R(0.0));
                vec3 last = vec3(R(0.0));
                for (int j = 0; j < steps; ++j) {
                    CellLight cell = light_of_cell(medium, light, aspect, sight.direction, outer, inner, edge[j], edge[j + 1], moment[j]);
                    float t = cell.place;
                    vec3 f = vec3(R(0.0));
                    float strength = cell.strength;
                    if (strength > R(0.0) && ray.kind != 0)
                        strength *= lit_share(shadow_maps, ray, edge[j], edge[j + 1]);
                    if (strength > R(0.0) || (settings.orders == orders_all && (light.type == light_spot || ray.kind != 0))) {
                        vec3 point = t * sight.direction;
                        float depth = terms_to_light(medium, light, point) + shadow_density(light_gaussians, camera, l, light, point);
                        f = min(strength * light.intensity, vec3(radiance_limit)) * transmittance(medium, min(depth, density_limit));
                        if (settings.orders == orders_all)
                            f += rescattered_strength(medium, camera, light, aspect, around, sight.direction, t,
                                                      clamp(depth, R(0.0), density_limit));
                    }
                    total.radiance += min(f * coloured[j], vec3(radiance_limit));
                    // The first and the last cell turn like their neighbours.
                    for (int c = j == 2 ? 0 : j - 1; c < (j == steps - 1 ? steps : j) && j > 1; ++c) {
                        vec3 error = min(abs((f - R(2.0) * last + before) * coloured[c]), vec3(radiance_limit)) / R(5.0);
                        total.error += R(1.2) * error;
                        error_of[c] += error.x + error.y + error.z;
                    }
                    before = last;
                    last = f;
                }
            }
        }
        // What rounding takes from an empty cell, the next one has too much; a light on one alone sends nothing.
        total.radiance = max(total.radiance, vec3(R(0.0)));
        float error = total.error.x + total.error.y + total.error.z;
        float allowed = R(1.8) * settings.tolerance * (total.radiance.x + total.radiance.y + total.radiance.z);
        if (error <= allowed || round == 2)
            return total;
        // Of second order: best with steps in the ratio of the cube roots of the cells' errors.
        knots = steps;
        for (int j = 0; j < steps; ++j) {
            float beside = max(error_of[max(j - 1, 0)], error_of[min(j + 1, steps - 1)]);
            float e = max(max(error_of[j], beside) / error, R(1e-3) / float(steps));
            knot[j] = edge[j];
            weight[j] = exp(log(e) / R(3.0));
        }
        knot[steps] = end;
        if (round == 1) {
            // Fewer where a driver would end loops. Lists of lights' cells of directions are a part as long as a tile's.
            float turns = float(max_cells + 1) * float(2 + sight.count) +
                          float(max_cells * (last_light - first_light)) * (R(2.0) + R(0.125) * float(sight.count));
            float most = clamp(float(most_turns) / turns - R(3.0), R(1.0), float(most_batches));
            batches = int(clamp(sqrt(error / max(allowed, R(1e-30))) + R(1.0), R(1.0), most));
        }
    }
    return total;
}
