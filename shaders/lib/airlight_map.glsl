// Making the attenuation maps and the density of the view's grid. Needs attenuation.glsl, shadow.glsl,
// noise.glsl, tiles.glsl.

// Interpolation between points `spacing` apart widens a Gaussian by a variance of spacing^2 / 6 in the mean along each axis across
// the ray, so what is sampled there is narrower by that, down to where half is left.
PURE Gaussian narrowed(Gaussian g, float spacing)
{
    float less = R(1.0) - min(spacing * spacing * g.scale * g.scale / R(3.0), R(0.5));
    g.scale /= sqrt(less);
    g.amplitude /= less;
    return g;
}

// The profile of a narrowed Gaussian, along the ray as wide as before.
PURE Profile widened_along(Profile p, float scale)
{
    p.scale = scale;
    return p;
}

PURE float attenuation_distance(IN(AttenuationFrame) frame, int nodes, int node)
{
    return mix(frame.near, frame.far, float(node) / float(nodes - 1));
}

// A ray of a map, and what it may meet: listed_gaussian(first, 0 to count - 1).
struct AttenuationRay {
    vec3 origin;
    vec3 direction;
    float start;    // far before it where the light is directional
    float spacing;  // from its neighbours: per metre, or directional: [m]
    int first;
    int count;
};

PURE AttenuationRay attenuation_ray(IN(Camera) camera, IN(AttenuationFrame) frame, IN(Light) light,
                                    sampler2D light_gaussians, int index, int side, ivec2 texel)
{
    vec2 square = vec2(texel) / float(side - 1);
    AttenuationRay ray;
    ray.origin = light.position;
    ray.direction = light.direction;
    if (light.type == light_directional) {
        // The point of the plane through the camera whose place is `square`.
        vec3 u = vec3(frame.u);
        vec3 v = vec3(frame.v);
        float across = dot(u, u);
        float along = dot(v, v);
        ray.origin = u * ((square.x - frame.u.w) / across) + v * ((square.y - frame.v.w) / along);
        ray.start = -far_away;
        ray.spacing = R(1.0) / (float(side - 1) * sqrt(sqrt(across * along)));
        vec4 across_lists = shadow_origin(light_gaussians, 1 + index, 0);
        vec4 along_lists = shadow_origin(light_gaussians, 1 + index, 1);
        square = vec2(dot(vec3(across_lists), ray.origin) + across_lists.w, dot(vec3(along_lists), ray.origin) + along_lists.w);
    } else {
        vec3 u = vec3(frame.u);
        vec3 v = vec3(frame.v);
        vec3 d = octahedral_direction(vec2(frame.u.w + square.x * frame.size.x, frame.v.w + square.y * frame.size.y));
        ray.direction = u * d.x + v * d.y + cross(u, v) * d.z;
        ray.start = R(0.0);
        float stretch = abs(d.x) + abs(d.y) + abs(d.z);
        ray.spacing = R(2.0) * sqrt(frame.size.x * frame.size.y) * stretch * sqrt(stretch) / float(side - 1);
        square = octahedral(in_world(camera, ray.direction));
    }
    vec4 grid = shadow_origin(light_gaussians, 1 + index, 2);
    vec4 list = data_texel(light_gaussians, int(grid.x) + cell_of(square, int(grid.y)));
    ray.first = int(list.x);
    ray.count = int(list.y);
    return ray;
}

PURE Profile attenuation_profile(IN(AttenuationRay) ray, IN(Light) light, IN(Gaussian) g)
{
    float spacing = light.type == light_directional ? ray.spacing : ray.spacing * length(g.center - ray.origin);
    return widened_along(profile_along(narrowed(g, spacing), ray.origin, ray.direction), g.scale);
}

// A corner's list: that of the tile it is in.
PURE ivec2 grid_tile(sampler2D tiles, IN(GridSettings) s, ivec2 corner)
{
    return s.gaussians > 0 ? tile_range(tiles, s.size.x, min(corner * s.cell, s.size - 1)) : ivec2(0);
}

PURE Profile grid_profile(IN(Medium) medium, IN(Camera) camera, IN(Gaussian) g, int cell, vec3 direction)
{
    // Corners lie closer off the axis: by its cosine across the way to it, and by the square along that.
    float cosine = max(-direction.z, R(0.05));
    // Pixels that are no squares: the mean of the squares of their sides.
    vec2 side = R(1.0) / camera.focal;
    float spacing = length(g.center) * sqrt(R(0.5) * dot(side, side)) * cosine * sqrt(cosine);
    // Pixels are read at their centres, of few in a cell farther from its corners than in the mean.
    spacing *= sqrt(float(cell) * float(cell) + R(0.5));
    return widened_along(sight_profile(medium, camera, narrowed(g, spacing), direction), g.scale);
}
