// The host's lists of the Gaussians that matter in a tile of the screen (product "gaussians").
// Needs noise.glsl, data.glsl.

const int tile_size = 16;  // BRUME_TILE_SIZE

// Lists leave a Gaussian out where a path stays farther than this from its centre [m]: the path's integral through it is then
// below reach_share of that through the centre, and below an optical depth of reach_share.
const float reach_share = R(1e-4);

PURE float gaussian_reach(IN(Medium) medium, IN(Gaussian) g)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float most = max(max(extinction.x, extinction.y), extinction.z);
    float depth = most * g.amplitude * R(1.77245385091) / g.scale;
    // Noise shifts rays by up to its strength along each axis.
    return (sqrt(log(clamp(depth, R(1.0), R(1e30)) / reach_share)) + R(1.74) * medium.noise.x) / g.scale;
}

// Much of a list is passed at a distance: whether a path that meets it so is as good as without this Gaussian.
PURE Bool passed_by(IN(Medium) medium, IN(Gaussian) g, IN(Profile) along)
{
    vec3 extinction = medium.scattering + medium.absorption;
    float most = max(max(extinction.x, extinction.y), extinction.z);
    float share = R(0.3) * reach_share;
    return along.peak <= share * g.amplitude && R(1.77245385091) * most * along.peak <= share * g.scale;
}

PURE int tile_index(int width, ivec2 pixel)
{
    int columns = (width + tile_size - 1) / tile_size;
    return (pixel.y / tile_size) * columns + pixel.x / tile_size;
}

// First entry of the pixel's list and their number.
PURE ivec2 tile_range(sampler2D tiles, int width, ivec2 pixel)
{
    vec4 range = data_texel(tiles, tile_index(width, pixel));
    return ivec2(int(range.x), int(range.y));
}

// Of the Gaussians tile_gaussians[range.x .. range.x + range.y) along a ray.
PURE vec2 listed_moment(IN(Medium) medium, IN(Camera) camera, sampler2D gaussians, sampler2D tile_gaussians, ivec2 range, IN(Ray) ray)
{
    vec2 sum = vec2(R(0.0));
    if (some(!ray.keep))
        for (int i = 0; i < range.y; ++i) {
            Gaussian g = gaussian_at(gaussians, int(data_texel(tile_gaussians, range.x + i).x));
            Profile p = sight_profile(medium, camera, g, ray.direction);
            Bool passed = ray.keep || passed_by(medium, g, p);
            if (some(!passed)) {
                vec2 moment = profile_density_moment(p, ray.distance);
                sum += vec2(choose(passed, R(0.0), moment.x), choose(passed, R(0.0), moment.y));
            }
        }
    return sum;
}
