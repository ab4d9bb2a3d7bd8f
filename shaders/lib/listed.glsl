// The Gaussians of one list. Needs data.glsl, gaussian.glsl. Pixels side by side share the list.
//   cells           1 texel per list: x the first and y the number of its entries in cell_gaussians
//   cell_gaussians  one channel: indices of Gaussians

PURE float listed_density(sampler2D gaussians, sampler2D cells, sampler2D cell_gaussians, int cell, vec3 point,
                          vec3 direction, float distance)
{
    vec4 list = data_texel(cells, cell);
    int first = int(list.x);
    int count = int(list.y);
    float sum = R(0.0);
    // Four at a time: Mesa's software GL ends all loops of an invocation after 65,535 turns.
    for (int i = 0; i < count; i += 4)
        for (int k = 0; k < 4; ++k) {
            int entry = first + min(i + k, count - 1);
            Gaussian g = gaussian_at(gaussians, int(data_texel(cell_gaussians, entry).x));
            // Most of a list is passed at a distance: a millionth of a Gaussian's depth is beyond.
            vec3 b = g.center - point;
            float middle = dot(b, direction);
            float beyond = max(max(middle - distance, -middle), R(0.0));
            vec3 aside = cross(direction, b);
            Bool shows = g.scale * g.scale * dot(aside, aside) < R(14.0) && g.scale * beyond < R(3.5);
            if (i + k < count && some(shows))
                sum += choose(shows, profile_depth(profile_along(g, point, direction), R(0.0), distance), R(0.0));
        }
    return min(sum, density_limit);
}
