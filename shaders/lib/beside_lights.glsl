// Beside an effect that adds what the lights scatter once, which must not be counted twice. Needs data.glsl, pixel.glsl.

// Whether the pixel shows one of the lights, to within its own width. spheres: of product "visible_lights".
PURE bool shows_light(sampler2D spheres, int count, IN(Camera) camera, vec2 pixel, float distance)
{
    vec3 through = ray_through(camera, pixel);
    vec3 direction = through / length(through);
    float width = R(0.7) * max(abs(camera.tangent_scale.x), abs(camera.tangent_scale.y));
    for (int i = 0; i < count; ++i) {
        vec4 sphere = data_texel(spheres, i);
        vec3 center = vec3(sphere);
        float reach = sphere.w + width * length(center);
        if (abs(distance - dot(center, direction)) <= reach && length(cross(center, direction)) <= reach)
            return true;
    }
    return false;
}

// The share of a source's scattered light that is no other effect's: of listed lights the first scattering is, or (all_orders) all
// that they scatter.
PURE vec3 shown_share(sampler2D spheres, int count, int all_orders, IN(Medium) medium, IN(Camera) camera, vec2 pixel, IN(Pixel) p)
{
    if (count == 0 || !shows_light(spheres, count, camera, pixel, p.distance))
        return vec3(R(1.0));
    if (all_orders != 0)
        return vec3(R(0.0));
    return rescattered_share(medium, p.density) / max(scattered_share(medium, p.density), vec3(R(1e-30)));
}

// L_sc / L of kernel `paper` beside such an effect.
PURE vec3 share_beside_lights(sampler2D spheres, int count, int all_orders, IN(Medium) medium, IN(Camera) camera, vec2 pixel,
                              IN(Pixel) p)
{
    if (count == 0 || !shows_light(spheres, count, camera, pixel, p.distance))
        return p.share;
    return all_orders != 0 ? vec3(R(0.0)) : rescattered_share(medium, p.density);
}
