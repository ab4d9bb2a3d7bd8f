// The Gaussians of one list of product light_gaussians (shadow.glsl). Needs data.glsl, gaussian.glsl. Pixels side by side share the list.

// cell: the texel that has x the first texel of its entries, of which there are four in each, and y their number.
PURE float listed_density(sampler2D light_gaussians, int cell, vec3 point, vec3 direction, float distance)
{
    vec4 list = data_texel(light_gaussians, cell);
    int first = int(list.x);
    int count = int(list.y);
    float sum = R(0.0);
    // Four at a time: Mesa's software GL ends all loops of an invocation after 65,535 turns.
    for (int i = 0; i < count; i += 4) {
        vec4 entries = data_texel(light_gaussians, first + i / 4);
        for (int k = 0; k < 4; ++k) {
            Gaussian g = gaussian_at(light_gaussians, int(entries[k]));
            // Most of a list is passed at a distance: a millionth of a Gaussian's depth is beyond.
            vec3 b = g.center - point;
            float middle = dot(b, direction);
            float beyond = max(max(middle - distance, -middle), R(0.0));
            vec3 aside = cross(direction, b);
            Bool shows = g.scale * g.scale * dot(aside, aside) < R(14.0) && g.scale * beyond < R(3.5);
            if (i + k < count && some(shows))
                sum += choose(shows, profile_depth(profile_along(g, point, direction), R(0.0), distance), R(0.0));
        }
    }
    return min(sum, density_limit);
}

// Entry i of a list.
PURE Gaussian listed_gaussian(sampler2D light_gaussians, int first, int i)
{
    return gaussian_at(light_gaussians, int(data_texel(light_gaussians, first + i / 4)[i % 4]));
}

// What gaussian_at() has the first of all Gaussians at.
PURE int first_gaussian(sampler2D light_gaussians)
{
    return int(data_texel(light_gaussians, 2).z);
}
