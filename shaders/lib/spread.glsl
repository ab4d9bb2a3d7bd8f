// Deviation of the spatial spread of scattered light (Iser eq. 1 and 3, after Premoze et al. 2004). Needs scene.glsl.

// Widest deviation that is told apart [px]; far wider than any image.
const float spread_limit = R(1e6);

// W(P) / D, the angle under which the deviation at the source appears. Eq. 1 with s = P, rearranged to
// W = s sqrt(x / (8 + 4/3 sigma_a s x)), x = sigma_s (1 - g) s, which neither divides by zero (sigma_s = 0, g = 1, P = 0)
// nor overflows. Cross-sections of coloured media enter by their luminance.
PURE float spread_angle(Medium medium, float p, float distance)
{
    if (p <= R(0.0) || distance <= R(0.0))
        return R(0.0);
    float s = min(p, R(1e15));
    float x = dot(medium.luminance, medium.scattering) * (R(1.0) - medium.asymmetry) * s;
    float a = dot(medium.luminance, medium.absorption) * s;
    float mean_density = p / max(distance, R(1e-18) * p);
    return mean_density * sqrt(max(x, R(0.0)) / (R(8.0) + R(4.0) / R(3.0) * a * x));
}

// The same in pixels, W_px = f_px W / D, which makes the look independent of resolution and field of view.
PURE float spread_pixels(Medium medium, Camera camera, float p, float distance)
{
    float focal = sqrt(camera.focal.x * camera.focal.y);
    return min(focal * spread_angle(medium, p, distance), spread_limit);
}
