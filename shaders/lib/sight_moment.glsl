// What a Gaussian adds along a pixel's ray. Needs tiles.glsl.

// The highest peak along a path that is passed_by() the Gaussian.
PURE float passed_peak(IN(Medium) medium, IN(Gaussian) g)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float most = max(max(extinction.x, extinction.y), extinction.z);
    return R(0.3) * reach_share * min(g.amplitude, g.scale / max(R(1.77245385091) * most, R(1e-30)));
}

// Beyond so many radii from its middle a Gaussian has nothing left that its integrals show in 32 bits.
const float whole_radii = R(4.2);

// profile_density_moment(). Most Gaussians lie wholly between the camera and what the pixel shows: their integrals are those of
// the whole line. radius: 1 / p.scale; nearness: 1 / distance.
PURE vec2 sight_moment(IN(Profile) p, float radius, float distance, float nearness)
{
    float behind = distance - p.middle;
    Bool whole = p.scale * min(p.middle, behind) > whole_radii;
    float area = min(R(1.77245385091) * p.peak * radius, density_limit);
    float share = behind * nearness;
    float spread = radius * nearness;
    vec2 sum = vec2(area, area * (share * share + R(0.5) * spread * spread));
    if (some(!whole)) {
        vec2 part = profile_density_moment(p, distance);
        sum = vec2(choose(whole, sum.x, part.x), choose(whole, sum.y, part.y));
    }
    return sum;
}
