// What the medium does to one pixel (Iser 2018 sec. 4.1). Needs scene.glsl, ray.glsl, density.glsl, radiance.glsl, spread.glsl.

struct Pixel {
    float distance;      // [m]
    float density;       // P
    float spread;        // W [px]
    vec3 transmittance;
    vec3 share;          // L_sc / L
    vec3 emitted;
};

// gaussians: their part of P.
PURE Pixel pixel_in_medium(IN(Medium) medium, IN(Camera) camera, vec2 pixel, float raw_depth, float gaussians)
{
    Ray ray = pixel_ray(camera, pixel, raw_depth);
    float p = density_to(medium, ray, gaussians);
    Shares shares = shares_of(medium, p);
    return Pixel(ray.distance, p, spread_pixels(medium, camera, p), shares.straight, shares.scattered, emitted(medium, p));
}

