// Another renderer's fog in place of the scene's density (Iser 2018 sec. 6.2: the filter takes any integrated density).
// Needs scene.glsl, ray.glsl, density.glsl.

// What is not a number is clear air.
//
// P as each colour of the medium has it, and their mean by luminance, of another renderer's fog. mode: 1 optical depth, 2
// transmittance. Colours that the medium does not have cannot be told apart from clear air.
PURE float layer_depth(int mode, float value)
{
    float x = choose(is_finite(value), value, choose(value > R(0.0), R(1e30), choose(value < R(0.0) || mode == 1, R(0.0), R(1.0))));
    return mode == 1 ? clamp(x, R(0.0), R(1e30)) : -log(clamp(x, R(1e-30), R(1.0)));
}

PURE vec4 layer_density(IN(Medium) medium, IN(Ray) ray, int mode, vec3 value)
{
    vec3 extinction = medium.scattering + medium.absorption;
    vec3 tau = vec3(layer_depth(mode, value.x), layer_depth(mode, value.y), layer_depth(mode, value.z));
    vec3 p = vec3(choose(extinction.x > R(0.0), tau.x / extinction.x, R(0.0)),
                  choose(extinction.y > R(0.0), tau.y / extinction.y, R(0.0)),
                  choose(extinction.z > R(0.0), tau.z / extinction.z, R(0.0)));
    p = min(p, vec3(density_limit));
    vec3 weights = medium.luminance * extinction;
    float sum = weights.x + weights.y + weights.z;
    float mean = choose(sum > R(0.0), dot(weights, p) / sum, R(0.0));
    Bool keep = ray.keep;
    return vec4(choose(keep, R(0.0), p.x), choose(keep, R(0.0), p.y), choose(keep, R(0.0), p.z), choose(keep, R(0.0), mean));
}
