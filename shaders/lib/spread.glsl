// Deviation of the spatial spread of scattered light (Iser eq. 1 and 3, after Premoze et al. 2004). Needs scene.glsl.

// Widest deviation that is told apart [px]; far wider than any image.
const float spread_limit = R(1e6);

// W(P) / P: the angle under which the deviation appears. The paper leaves W in metres and compares it with pixels. It sees
// the segment as a homogeneous one of length P (its eq. 2), and at that length W subtends W(P) / P. The true distance in
// place of P would give another blur to the same medium written as (2 rho, C / 2), and none at all to a sky behind fog.
// Eq. 1 with s = P, rearranged to W / s = sqrt(x / (8 + 4/3 sigma_a s x)), x = sigma_s (1 - g) s, which neither divides by
// zero (sigma_s = 0, g = 1, P = 0) nor overflows. Cross-sections of coloured media enter by their luminance.
PURE float spread_angle(IN(Medium) medium, float p)
{
    float s = min(p, R(1e15));
    float x = min(dot(medium.luminance, medium.scattering) * (R(1.0) - medium.asymmetry) * s, R(1e18));
    float a = min(dot(medium.luminance, medium.absorption) * s, R(1e18));
    return sqrt(max(x, R(0.0)) / (R(8.0) + R(4.0) / R(3.0) * a * x));
}

// sqrt(3 M2), M2 = int rho ((D - t)/D)^2 dt / P: what scatters close to the surface hardly shifts its light on the image,
// what scatters close to the camera shifts it most. 1 for homogeneous media, which W(P) takes for granted; 5.5 times less
// or more at the ends by Monte Carlo. moment: the integral above P.
PURE float placement(float moment, float p)
{
    return choose(p > R(0.0), sqrt(clamp(R(3.0) * moment / p, R(0.0), R(3.0))), R(1.0));
}

// The same in pixels, which makes the look independent of resolution and field of view.
PURE float spread_pixels(IN(Medium) medium, IN(Camera) camera, float p)
{
    return min(sqrt(camera.focal.x * camera.focal.y) * spread_angle(medium, p), spread_limit);
}
