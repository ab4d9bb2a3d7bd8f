// Optical depth of the Gaussians between an origin and a point, by lists. Needs scene.glsl, gaussian.glsl, light.glsl,
// octahedral.glsl.
//
// Origin 0 is the camera, origin 1 + l is light l. Around each, directions fall into grid x grid cells, and each cell lists
// the Gaussians that a ray of such a direction may meet. One image, light_gaussians, has all:
//   3 texels per origin:
//     0, 1  directional lights: the axes of the grid, a plane across the light. The cell's coordinates are
//           dot(xyz, point) + w, 0 to 1 across the grid; points outside of it meet no Gaussian. Unused otherwise.
//     2     x the texel of its first cell, y its grid, z where the Gaussians are: gaussian_at() has the first at this index
//   1 texel per cell, row by row, as listed.glsl has it
//   2 texels per Gaussian, as product gaussians has them
//   the cells' entries: indices for gaussian_at() in this image, four in a texel
// Cells of the camera, of points and of spots are those of octahedral() of the direction from the origin in world axes, so
// that lights' lists outlive a turn of the camera.
#include "listed.glsl"

#define SHADOW_IMAGES sampler2D gaussians, sampler2D light_gaussians
#define SHADOW_PASSED gaussians, light_gaussians

PURE vec4 shadow_origin(sampler2D light_gaussians, int origin, int texel)
{
    return data_texel(light_gaussians, 3 * origin + texel);
}

PURE int cell_of(vec2 square, int grid)
{
    int x = clamp(int(square.x * float(grid)), 0, grid - 1);
    int y = clamp(int(square.y * float(grid)), 0, grid - 1);
    return y * grid + x;
}

// From the point toward the origin, since what stands near the point is what must be placed precisely.
PURE float density_from(sampler2D light_gaussians, IN(Camera) camera, int origin, vec3 position, vec3 point)
{
    vec4 grid = shadow_origin(light_gaussians, origin, 2);
    vec3 d = position - point;
    float distance = length(d);
    int cell = int(grid.x) + cell_of(octahedral(in_world(camera, -d)), int(grid.y));
    return listed_density(light_gaussians, cell, point, d / max(distance, R(1e-20)), distance);
}

PURE float density_in_parallel_light(sampler2D light_gaussians, int origin, vec3 direction, vec3 point)
{
    vec4 u = shadow_origin(light_gaussians, origin, 0);
    vec4 v = shadow_origin(light_gaussians, origin, 1);
    vec4 grid = shadow_origin(light_gaussians, origin, 2);
    vec2 square = vec2(dot(vec3(u.x, u.y, u.z), point) + u.w, dot(vec3(v.x, v.y, v.z), point) + v.w);
    if (square.x < R(0.0) || square.x > R(1.0) || square.y < R(0.0) || square.y > R(1.0))
        return R(0.0);
    int cell = int(grid.x) + cell_of(square, int(grid.y));
    return listed_density(light_gaussians, cell, point, -direction, far_away);
}

// int rho dt of all Gaussians between the camera and a point.
PURE float camera_density(sampler2D light_gaussians, IN(Camera) camera, vec3 point)
{
    return density_from(light_gaussians, camera, 0, vec3(R(0.0)), point);
}

// int rho dt of all Gaussians between light `index`, which is `light`, and a point.
PURE float shadow_density(sampler2D light_gaussians, IN(Camera) camera, int index, IN(Light) light, vec3 point)
{
    if (light.type == light_directional)
        return density_in_parallel_light(light_gaussians, 1 + index, light.direction, point);
    return density_from(light_gaussians, camera, 1 + index, light.position, point);
}
