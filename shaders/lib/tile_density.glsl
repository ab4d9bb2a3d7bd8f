// A pixel's integrals over the medium's Gaussians. Needs tiles.glsl.

// Of all Gaussians along the pixel's ray: int rho dt to what it shows, and int rho (1 - t/D)^2 dt.
PURE vec2 tile_density(IN(Medium) medium, IN(Camera) camera, sampler2D gaussians, sampler2D tiles, sampler2D tile_gaussians,
                       int width, ivec2 pixel, float raw_depth)
{
    Ray ray = pixel_ray(camera, vec2(pixel) + R(0.5), raw_depth);
    return listed_moment(medium, camera, gaussians, tile_gaussians, tile_range(tiles, width, pixel), ray);
}
