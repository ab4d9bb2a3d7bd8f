// Optical depth of the Gaussians between an origin and a point, by lists. Needs scene.glsl, gaussian.glsl, light.glsl,
// octahedral.glsl.
//
// Origin 0 is the camera, origin 1 + l is light l. Around each, directions fall into grid x grid cells, and each cell lists
// the Gaussians that a ray of such a direction may meet:
//   shadow_origins  3 texels per origin:
//     0, 1  directional lights: the axes of the grid, a plane across the light. The cell's coordinates are
//           dot(xyz, point) + w, 0 to 1 across the grid; points outside of it meet no Gaussian. Unused otherwise.
//     2     x the index of its first cell in `cells`, y its grid
//   cells           1 texel per cell, row by row: x the first and y the number of its entries in cell_gaussians
//   cell_gaussians  one channel: indices of Gaussians
// Cells of the camera, of points and of spots are those of octahedral() of the direction from the origin in world axes, so
// that lights' lists outlive a turn of the camera.
#define SHADOW_IMAGES sampler2D gaussians, sampler2D cells, sampler2D cell_gaussians, sampler2D shadow_origins
#define SHADOW_PASSED gaussians, cells, cell_gaussians, shadow_origins

PURE int cell_of(vec2 square, int grid)
{
    int x = clamp(int(square.x * float(grid)), 0, grid - 1);
    int y = clamp(int(square.y * float(grid)), 0, grid - 1);
    return y * grid + x;
}

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
            if (i + k < count && g.scale * g.scale * dot(aside, aside) < R(14.0) && g.scale * beyond < R(3.5))
                sum += profile_depth(profile_along(g, point, direction), R(0.0), distance);
        }
    return min(sum, density_limit);
}

// From the point toward the origin, since what stands near the point is what must be placed precisely.
PURE float density_from(SHADOW_IMAGES, IN(Camera) camera, int origin, vec3 position, vec3 point)
{
    vec4 grid = data_texel(shadow_origins, 3 * origin + 2);
    vec3 d = position - point;
    float distance = length(d);
    int cell = int(grid.x) + cell_of(octahedral(in_world(camera, -d)), int(grid.y));
    return listed_density(gaussians, cells, cell_gaussians, cell, point, d / max(distance, R(1e-20)), distance);
}

PURE float density_in_parallel_light(SHADOW_IMAGES, int origin, vec3 direction, vec3 point)
{
    vec4 u = data_texel(shadow_origins, 3 * origin);
    vec4 v = data_texel(shadow_origins, 3 * origin + 1);
    vec4 grid = data_texel(shadow_origins, 3 * origin + 2);
    vec2 square = vec2(dot(vec3(u.x, u.y, u.z), point) + u.w, dot(vec3(v.x, v.y, v.z), point) + v.w);
    if (square.x < R(0.0) || square.x > R(1.0) || square.y < R(0.0) || square.y > R(1.0))
        return R(0.0);
    int cell = int(grid.x) + cell_of(square, int(grid.y));
    return listed_density(gaussians, cells, cell_gaussians, cell, point, -direction, far_away);
}

// int rho dt of all Gaussians between the camera and a point.
PURE float camera_density(SHADOW_IMAGES, IN(Camera) camera, vec3 point)
{
    return density_from(SHADOW_PASSED, camera, 0, vec3(R(0.0)), point);
}

// int rho dt of all Gaussians between light `index`, which is `light`, and a point.
PURE float shadow_density(SHADOW_IMAGES, IN(Camera) camera, int index, IN(Light) light, vec3 point)
{
    if (light.type == light_directional)
        return density_in_parallel_light(SHADOW_PASSED, 1 + index, light.direction, point);
    return density_from(SHADOW_PASSED, camera, 1 + index, light.position, point);
}
