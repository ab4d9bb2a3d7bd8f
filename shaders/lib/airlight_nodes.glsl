// The tier `nodes`: quadrature with exact optical depths at each node. Needs airlight.glsl, quadrature.glsl.

PURE Airlight airlight_by_nodes(IN(Medium) medium, IN(Camera) camera, IN(AirlightSettings) settings, AIRLIGHT_IMAGES,
                                IN(Sight) sight, int first_light, int last_light)
{
    vec3 sum = vec3(R(0.0));
    for (int l = first_light; l < last_light; ++l) {
        Light light = light_at(lights, l);
        vec2 lit = lit_interval(light, sight.direction, sight.distance, light.cos_outer);
        if (lit.x >= lit.y)
            continue;
        // Equiangular: t = t0 + h tan(angle).
        float t0 = dot(light.position, sight.direction);
        float h = max(length(cross(sight.direction, light.position)), apparent_radius(light));
        float from = atan(lit.x - t0, h);
        float span = atan(h * (lit.y - lit.x), h * h + (lit.x - t0) * (lit.y - t0));
        int n = quadrature_nodes(settings.smooth_nodes);
        for (int k = 0; k < n; ++k) {
            vec2 node = gauss_legendre(n, k);
            float a = from + span * node.x;
            float t = clamp(t0 + h * tan(a), lit.x, lit.y);
            float dt = span * h / (cos(a) * cos(a));
            float rho = density_at(medium, t * sight.direction);
            float p = sight_density(medium, gaussians, tile_gaussians, sight, t);
            sum += node.y * dt * rho * medium.scattering * turned_light(medium, camera, SHADOW_PASSED, sight, l, light, t, p);
        }
    }
    return Airlight(min(sum, vec3(radiance_limit)), vec3(R(0.0)));
}
