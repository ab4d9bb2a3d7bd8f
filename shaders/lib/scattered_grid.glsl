// The texels of airlight_scattered.glsl's grid.

PURE vec4 scattered_texel(IN(Medium) medium, IN(Camera) camera, IN(ScatteredSettings) s, sampler2D distances, sampler2D lights,
                          sampler2D surroundings, sampler2D light_gaussians, ivec2 light_range, vec2 corner, int slice)
{
    vec3 through = ray_through(camera, corner * s.cell);
    vec3 direction = through / length(through);
    float t = data_texel(distances, slice).x;
    vec3 point = t * direction;
    float peaks = data_texel(distances, s.slices + 1).x;
    vec3 sum = vec3(R(0.0));
    for (int l = 0; l < s.lights; ++l) {
        Light light = light_at(lights, l);
        Aspect aspect = aspect_of(light, direction);
        peaks += data_texel(distances, s.slices + 2 + l).x / peak_distance(light, aspect, t);
        if (l < light_range.x || l >= light_range.y)
            continue;
        float depth = terms_to_light(medium, light, point);
        if (s.gaussians > 0)
            depth += shadow_density(light_gaussians, camera, l, light, point);
        sum += rescattered_strength(medium, camera, light, aspect, surroundings_of(surroundings, l), direction, t,
                                    clamp(depth, R(0.0), density_limit));
    }
    return vec4(min(min(sum, vec3(radiance_limit)) / max(peaks, R(1e-30)), vec3(radiance_limit)), R(0.0));
}
