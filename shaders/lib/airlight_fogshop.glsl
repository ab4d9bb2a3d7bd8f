// The tier `fogshop`: Zhou et al. 2007 eq. 11-17, as published: one sample per Gaussian, at the projection of its centre on
// the segment (eq. 10-13), and the homogeneous term of `sun` with one factor C_sv for all Gaussians (eq. 15-17).
// Needs airlight_sun.glsl, tiles.glsl.
//
// Measured (airlight_accuracy): 8 % off in the mean with lights 2 to 6 radii from a Gaussian, 24 % nearer, 9 % where a surface
// cuts one.
// Beyond the paper: absorption, phase functions, spots and directional lights, bounded d.

// int rho dt of one Gaussian between the light and a point.
PURE float own_density(IN(Gaussian) g, IN(Light) light, vec3 point)
{
    if (light.type == light_directional)
        return gaussian_integral(g, point, -light.direction, R(0.0), far_away);
    vec3 way = light.position - point;
    float d = length(way);
    return gaussian_integral(g, point, way / max(d, R(1e-20)), R(0.0), d);
}

// Texel i of blob_density: of eq. 13's T(v, b_i) and T(s, b_i) all but the Gaussian itself, whose part is that on the path to
// b_i^r instead (eq. 12).
PURE float blob_density_at(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, SHADOW_IMAGES, sampler2D lights,
                           int i)
{
    int origins = 1 + settings.light_count;
    Gaussian g = gaussian_at(gaussians, i / origins);
    int l = i % origins - 1;
    if (l < 0) {
        float distance = length(g.center);
        vec3 way = g.center / max(distance, R(1e-20));
        return camera_density(light_gaussians, camera, g.center) - gaussian_integral(g, vec3(R(0.0)), way, R(0.0), distance) +
               density_integral(medium, way, distance);
    }
    Light light = light_at(lights, l);
    return shadow_density(light_gaussians, camera, l, light, g.center) - own_density(g, light, g.center) +
           terms_to_light(medium, light, g.center);
}

PURE Airlight airlight_by_projection(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                                     IN(Sight) sight, int first_light, int last_light)
{
    Airlight sum = Airlight(vec3(R(0.0)), vec3(R(0.0)));
    // Eq. 14-17.
    for (int l = first_light; l < last_light; ++l) {
        Light light = light_at(lights, l);
        Airlight one = terms_by_table(medium, sun_table, light, sight);
        if (max(max(one.radiance.x, one.radiance.y), one.radiance.z) <= R(0.0))
            continue;
        vec3 c_sv = transmittance(medium, shadow_density(light_gaussians, camera, l, light, vec3(R(0.0))));
        sum.radiance += c_sv * one.radiance;
        sum.error += c_sv * one.error;
    }
    // Eq. 11-13.
    for (int i = 0; i < sight.count; ++i) {
        int index = int(data_texel(tile_gaussians, sight.first + i).x);
        Gaussian g = gaussian_at(gaussians, index);
        Profile along = sight_profile(medium, camera, g, sight.direction);
        if (passed_by(medium, g, along))
            continue;
        float share = profile_integral(along, R(0.0), sight.distance);
        float t = clamp(along.middle, R(0.0), sight.distance);
        vec3 point = t * sight.direction;
        int row = index * (1 + settings.light_count);
        float view = profile_depth(along, R(0.0), t) + data_texel(blob_density, row).x;
        for (int l = first_light; l < last_light; ++l) {
            Light light = light_at(lights, l);
            Aspect aspect = aspect_of(light, sight.direction);
            float strength = lit_strength(medium, light, aspect, sight.direction, t);
            // The exponents of f0 and f1 are added before the exp: apart they overflow.
            float depth = view + own_density(g, light, point) + data_texel(blob_density, row + 1 + l).x;
            vec3 scale = min(share * transmittance(medium, clamp(depth, R(0.0), density_limit)) * medium.scattering * g.color,
                             vec3(density_limit));
            sum.radiance += min(strength * light.intensity, vec3(radiance_limit)) * scale;
            // The sample against the two of Gauss-Hermite: how much the light varies over the Gaussian.
            float offset = R(0.707106781187) / g.scale;
            float mean = R(0.5) * (lit_strength(medium, light, aspect, sight.direction, clamp(t - offset, R(0.0), sight.distance)) +
                                   lit_strength(medium, light, aspect, sight.direction, clamp(t + offset, R(0.0), sight.distance)));
            sum.error += min(abs(mean - strength) * light.intensity, vec3(radiance_limit)) * scale;
        }
    }
    return Airlight(min(sum.radiance, vec3(radiance_limit)), min(sum.error, vec3(radiance_limit)));
}
