// What the medium does to one pixel (Iser 2018 sec. 4.1). Needs scene.glsl, ray.glsl, density.glsl, radiance.glsl, spread.glsl.

// A texel of product "density": P, and the distance to what the pixel shows, negative where no medium is to be in front of it.
PURE vec2 density_texel(IN(Ray) ray, float p)
{
    return vec2(p, choose(ray.keep, -ray.distance, ray.distance));
}

struct Pixel {
    float distance;      // [m]
    float density;       // P
    float spread;        // W [px]
    vec3 transmittance;
    vec3 share;          // L_sc / L
    vec3 emitted;
};

// texel: of product "density".
PURE Pixel pixel_in_medium(IN(Medium) medium, IN(Camera) camera, vec2 texel)
{
    float p = texel.x;
    Shares shares = shares_of(medium, p);
    return Pixel(abs(texel.y), p, spread_pixels(medium, camera, p), shares.straight, shares.scattered, emitted(medium, p));
}

// The same where each colour has a density of its own: product "density_rgb".
PURE Pixel pixel_in_layer(IN(Medium) medium, IN(Camera) camera, vec2 texel, vec3 p)
{
    Shares shares = shares_of(medium, p);
    return Pixel(abs(texel.y), texel.x, spread_pixels(medium, camera, texel.x), shares.straight, shares.scattered,
                 emitted(medium, p));
}
