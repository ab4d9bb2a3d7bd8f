// Irregular media from few Gaussians: noise, anchored in the world, shifts the view ray before it meets a Gaussian (Zhou et al.
// 2007 sec. 5.5). Needs ray.glsl, gaussian.glsl.

// Each component in [-1, 1]: a hash of the lattice point, of period 256 (Jarzynski and Olano 2020, pcg3d).
PURE vec3 lattice_vector(ivec3 point, int seed)
{
    uint x = uint(point.x & 255) + uint(seed) * 2654435769u;
    uint y = uint(point.y & 255);
    uint z = uint(point.z & 255);
    x = x * 1664525u + 1013904223u;
    y = y * 1664525u + 1013904223u;
    z = z * 1664525u + 1013904223u;
    for (int i = 0; i < 2; ++i) {
        x += y * z;
        y += z * x;
        z += x * y;
        if (i == 0) {
            x ^= x >> 16;
            y ^= y >> 16;
            z ^= z >> 16;
        }
    }
    return vec3(float(x >> 8), float(y >> 8), float(z >> 8)) * R(1.1920929e-7) - vec3(R(1.0));
}

// Between the lattice points by quintics, so that slopes and curvature are continuous.
PURE vec3 noise_at(vec3 q, int seed)
{
    vec3 cell = floor(q);
    vec3 f = q - cell;
    vec3 w = f * f * f * (f * (f * R(6.0) - R(15.0)) + R(10.0));
    ivec3 c = ivec3(int(cell.x), int(cell.y), int(cell.z));
    vec3 sum = vec3(R(0.0));
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        float weight = (corner.x == 1 ? w.x : R(1.0) - w.x) * (corner.y == 1 ? w.y : R(1.0) - w.y) *
                       (corner.z == 1 ? w.z : R(1.0) - w.z);
        sum += weight * lattice_vector(c + corner, seed);
    }
    return sum;
}

// A Gaussian's density along the pixel's ray. The noise is that where its centre projects on the ray.
PURE Profile sight_profile(IN(Medium) medium, IN(Camera) camera, IN(Gaussian) g, vec3 direction)
{
    if (medium.noise.x <= R(0.0))
        return profile_along(g, vec3(R(0.0)), direction);
    float along = clamp(dot(g.center, direction), R(0.0), R(1e8) / medium.noise.y);
    vec3 shift = noise_at(in_world(camera, along * direction) * medium.noise.y + medium.noise_shift, int(medium.noise.z));
    vec3 seen = vec3(dot(shift, camera.right), dot(shift, camera.up), dot(shift, camera.back));
    vec3 d = direction + seen * (medium.noise.x / max(g.scale * length(g.center), R(1.0)));
    return profile_along(g, vec3(R(0.0)), d / max(length(d), R(1e-20)));
}
