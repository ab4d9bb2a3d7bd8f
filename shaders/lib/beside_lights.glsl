// Beside an effect that adds what the lights scatter once, which must not be counted twice. Needs data.glsl, pixel.glsl.

// Whether the pixel shows one of the lights, to within its own width. Needs their spheres: point lights are not seen.
PURE bool shows_light(sampler2D lights, int count, IN(Camera) camera, IN(Ray) ray)
{
    float pixel = R(0.7) * max(abs(camera.tangent_scale.x), abs(camera.tangent_scale.y));
    for (int i = 0; i < count; ++i) {
        vec4 sphere = data_texel(lights, 4 * i);
        vec3 center = vec3(sphere);
        float reach = sphere.w + pixel * length(center);
        if (sphere.w > R(0.0) && abs(ray.distance - dot(center, ray.direction)) <= reach &&
            length(cross(center, ray.direction)) <= reach)
            return true;
    }
    return false;
}

// L_sc / L beside an effect that adds what the lights scatter once: of pixels that show such a light only what is scattered
// more than once, or its first scattering would be counted twice.
PURE vec3 share_beside_lights(sampler2D lights, int count, IN(Medium) medium, IN(Camera) camera, vec2 pixel, float raw_depth,
                              IN(Pixel) p)
{
    if (count > 0 && shows_light(lights, count, camera, pixel_ray(camera, pixel, raw_depth)))
        return rescattered_share(medium, p.density);
    return p.share;
}

// The same beside an effect that adds all that the lights scatter: of pixels that show such a light nothing is left, else it would
// be counted twice.
PURE vec3 share_beside_all_orders(sampler2D lights, int count, IN(Camera) camera, vec2 pixel, float raw_depth, IN(Pixel) p)
{
    return count > 0 && shows_light(lights, count, camera, pixel_ray(camera, pixel, raw_depth)) ? vec3(R(0.0)) : p.share;
}

// The share of a source's scattered light that is no other effect's: of listed lights the first scattering is.
PURE vec3 shown_share(sampler2D lights, int count, IN(Medium) medium, IN(Camera) camera, vec2 pixel, float raw_depth, float p)
{
    if (count == 0 || !shows_light(lights, count, camera, pixel_ray(camera, pixel, raw_depth)))
        return vec3(R(1.0));
    return rescattered_share(medium, p) / max(scattered_share(medium, p), vec3(R(1e-30)));
}
