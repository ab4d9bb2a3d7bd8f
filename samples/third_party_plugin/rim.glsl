// Light from behind that grazes surfaces, as GLSL and as C++. Needs scene.glsl, ray.glsl, density.glsl, radiance.glsl.

// What a surface shows of it through the medium. normal: of the surface, any length; direction: of the pixel's ray, in the
// normal's axes; density: what product "density" has of the pixel.
PURE vec3 rim_light(IN(Medium) medium, vec3 normal, vec3 direction, float density, float strength, float sharpness)
{
    float size = length(normal);
    Bool known = is_finite(size) && size > R(0.0);
    float facing = choose(known, min(abs(dot(normal, direction)) / max(size, R(1e-30)), R(1.0)), R(1.0));
    float edge = choose(facing < R(1.0), exp(sharpness * log(max(R(1.0) - facing, R(1e-30)))), R(0.0));
    return strength * edge * transmittance(medium, density);
}
