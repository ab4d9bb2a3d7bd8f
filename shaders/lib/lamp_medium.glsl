// What arrives of a lamp's light in an endless medium, however often it was scattered. Needs radiance.glsl, phase.glsl.
//
// In an endless medium of s' = sigma_a + (1 - g) sigma_s, with x = s' r and a = sigma_a / s', a lamp's fluence is I T / r^2 and its
// net flux 4 pi I F,
//   T = C x e^(-kappa x) + e^(-b x),   F = 1 - a int_0^x T dx = (1 - a/b) (1 + kappa x) e^(-kappa x) + a/b e^(-b x),
// kappa^2 = 3 a s, C = 3 s (1 - a/b): diffusion from afar, and no energy lost for any b and s, which are fitted to paths
// (lamp_calibration says how well). What is not e^(-sigma_t r) of T has been scattered, F by T is the mean cosine of its way,
// and a lobe of Henyey-Greenstein over nothing but even light comes near the rest. Lengths along the lamp's ray count in optical
// depths, which is all that is known of media that vary. Phase functions count by their mean cosine.

// How a lamp's scattered light arrives.
struct Rescattered {
    float fluence;  // times r^2 / I: T - e^(-sigma_t r)
    float cosine;   // mean, of its way and that from the lamp
    float kappa;    // kappa x
    float reduced;  // x
};

const float orders_depth_limit = R(1e9);

// What of all this the depths' ratio and the phase function settle, for one colour.
struct LampMedium {
    float reduced;     // x of the depths that it is made of
    float extinction;  // their sigma_t r / x
    float a;
    float slowing;     // s
    float near;        // b
    float far;         // 1 - a / b
    float kappa;
};

// scattering, absorption: optical depths, or coefficients.
PURE LampMedium lamp_medium(float scattering, float absorption, float asymmetry)
{
    float x = absorption + (R(1.0) - asymmetry) * scattering;
    float a = absorption / max(x, R(1e-30));
    float g = max(asymmetry, R(0.0));
    float slowing = R(1.0) - a * (R(0.6) - R(0.126) * g * (R(1.0) - a));
    float b = a + (R(1.0) - a) * (R(1.455) + g * (R(1.277) - R(0.468) * g) - a * (R(0.568) - R(0.853) * g));
    return LampMedium(x, (scattering + absorption) / max(x, R(1e-30)), a, slowing, b, R(1.0) - a / b, sqrt(R(3.0) * a * slowing));
}

// depth: sigma_t r.
PURE Rescattered rescattered_in(IN(LampMedium) medium, float x, float depth)
{
    float far = medium.far;
    float kx = medium.kappa * x;
    vec2 diffuse = parted(kx);
    vec2 near = parted(medium.near * x);
    vec2 straight = parted(depth);
    // Shallow, differences of what is gone, deep, of what is left: each is as small as they are.
    Bool shallow = depth < R(1.0);
    float fluence = R(3.0) * medium.slowing * far * x * diffuse.x + choose(shallow, straight.y - near.y, near.x - straight.x);
    float flux = choose(shallow, straight.y - far * (diffuse.y - kx * diffuse.x) - (R(1.0) - far) * near.y,
                        far * (R(1.0) + kx) * diffuse.x + (R(1.0) - far) * near.x - straight.x);
    return Rescattered(max(fluence, R(0.0)), clamp(flux / max(fluence, R(1e-30)), R(0.0), R(1.0)), kx, x);
}

// Optical depths of scattering and of absorption between the lamp and the point.
PURE Rescattered rescattered(float scattering, float absorption, float asymmetry)
{
    float s = min(scattering, orders_depth_limit);
    float d = min(absorption, orders_depth_limit);
    LampMedium medium = lamp_medium(s, d, asymmetry);
    return rescattered_in(medium, medium.reduced, s + d);
}

// Net flux of all that arrives, away from the lamp: times r^2 / I. What comes straight is the least of it, below which F falls
// where light is thrown back, and else by no more than 1e-13.
PURE float net_flux(IN(LampMedium) medium, float asymmetry, float x)
{
    if (!some(medium.a > R(0.0)))
        return R(1.0);
    float kx = medium.kappa * x;
    float net = medium.far * (R(1.0) + kx) * parted(kx).x + (R(1.0) - medium.far) * parted(medium.near * x).x;
    if (some(asymmetry < R(0.0)))
        net = max(net, exp(-medium.extinction * x));
    return net;
}
