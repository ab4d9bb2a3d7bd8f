// The order in which a tile of the screen takes its lights: by a bound on what each sends to any of its pixels, greatest first, with what
// all from there on come to. A pixel ends where that is too little beside what it has: lights cost what matters in a tile.
// Needs lamp_bound.glsl, tiles.glsl, airlight_parts.glsl.
//
// One bound for a tile's rays and not one for each pixel: eight parts of a ray, which is what makes a bound that is near enough, cost as
// much as the nodes of a panel do, and so as the light that they may spare.

// first: its pixel nearest to the images' origin; size: of the images.
PURE TileRays tile_rays(IN(Camera) camera, sampler2D depth, ivec2 first, ivec2 size)
{
    ivec2 last = ivec2(min(first.x + tile_size, size.x), min(first.y + tile_size, size.y));
    vec3 axis = ray_through(camera, R(0.5) * vec2(first + last));
    TileRays rays = TileRays(axis / length(axis), R(1.0), R(0.0), R(0.0), R(0.0));
    float stretch = R(1.0);
    for (int i = 0; i < 4; ++i) {
        vec3 corner = ray_through(camera, vec2(float((i & 1) == 0 ? first.x : last.x), float(i < 2 ? first.y : last.y)));
        stretch = max(stretch, length(corner));
        corner = corner / length(corner);
        rays.cosine = min(rays.cosine, dot(corner, rays.axis));
        rays.sine = max(rays.sine, length(cross(corner, rays.axis)));
        rays.spread = max(rays.spread, length(corner - rays.axis));
    }
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) {
            float d = ray_distance(camera, texelFetch(depth, ivec2(x, y), 0).x, stretch);
            if (d >= far_away && camera.sky != sky_fog)
                d = camera.sky == sky_clamp ? camera.sky_distance : R(0.0);
            rays.distance = max(rays.distance, d);
        }
    rays.distance = min(rays.distance, quadrature_limit);
    // What rounding may take away. Where the rays go every way, any is as good as opposite.
    rays.sine = R(1.0001) * rays.sine + R(1e-6);
    if (rays.cosine < R(0.1)) {
        rays.cosine = -R(1.0);
        rays.sine = R(0.0);
    }
    return rays;
}

// Parts of a tile's rays, which grow with their distance. The last one has all that is behind where nearly all light is extinct.
const int tile_pieces = 8;
const float piece_edge[8] = {R(0.0), R(0.0174852), R(0.04721), R(0.0977422), R(0.183647), R(0.3296851), R(0.5779499), R(1.0)};

PURE float tile_reach(IN(Medium) medium, IN(TileRays) rays)
{
    return medium.constant > R(0.0) || medium.term_count > 0 ? terms_range(medium, Sight(rays.axis, rays.distance, 0, 0)).y : R(0.0);
}

PURE float piece_end(IN(TileRays) rays, float reach, int i)
{
    return i == tile_pieces ? rays.distance : reach * piece_edge[i];
}

// A light's place in a tile's order, and what it and all behind it come to at most. bounds: texels [first, first + count).
PURE vec2 lamp_place(sampler2D bounds, int first, int count, int light)
{
    float own = data_texel(bounds, first + light).x;
    float place = R(0.0);
    float rest = own;
    for (int i = 0; i < count; ++i) {
        float other = data_texel(bounds, first + i).x;
        bool ahead = other > own || (other == own && i < light);
        place += ahead ? R(1.0) : R(0.0);
        rest += ahead || i == light ? R(0.0) : other;
    }
    return vec2(place, rest);
}
