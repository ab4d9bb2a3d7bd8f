// Shadows on surfaces by the lights' maps. Needs shadow_map.glsl.

// Of each map, 1 where its light reaches what the pixel shows. shadowed: as AirlightSettings has it.
PURE vec4 lit_by_maps(IN(Camera) camera, ivec4 shadowed, SHADOW_MAP_IMAGES, IN(Ray) ray)
{
    vec4 lit = vec4(R(1.0));
    for (int slot = 0; slot < 4; ++slot) {
        int light = shadowed[slot] - 1;
        if (light < 0 || ray.distance >= farthest_surface)
            continue;
        ShadowRay seen = shadow_ray(camera, SHADOW_MAP_PASSED, slot, light, ray.direction, R(1.01) * ray.distance);
        if (seen.slot >= 0 && !is_lit(SHADOW_MAP_PASSED, seen, ray.distance))
            lit[slot] = R(0.0);
    }
    return lit;
}
