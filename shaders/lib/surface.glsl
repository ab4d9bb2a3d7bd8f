// What the medium between lamps and surfaces makes of the light that surfaces receive. Needs airlight.glsl, lamp_field.glsl.
//
// A lamp gives a plane that takes all that falls on it, under the cosine c at r, in clear air I c / r^2, and in the medium
//   I / r^2 [ N(x) c + (1 - a) (h' x^2 / x'^3 N(x') + k x / (1 + (10.7 - 4.3 g) x^2) N(x)) ],  x = s' r,  a = sigma_a / s',
// N being the lamp's net flux in an endless medium; h' = c x + 1.42 the height of its image below the plane, x' the way from there,
// which is right from afar; k what one scattering gives more than it takes, fitted to paths (surface_calibration says how
// well). Nothing is lost in fog that does not absorb: what leaves the beam arrives from aside.

// Light that comes flatter than so counts as if it came so. Its own share of the picture goes to nothing, and what else is there,
// from surface to surface, must not be taken for it.
const float least_cosine = R(0.1);

// What a surface receives of a lamp over what it would in clear air. scattering, absorption: optical depths of the way.
PURE float received_share(float scattering, float absorption, float asymmetry, float cosine)
{
    float g = clamp(asymmetry, -largest_asymmetry, largest_asymmetry);
    float s = min(scattering, orders_depth_limit);
    float d = min(absorption, orders_depth_limit);
    float x = d + (R(1.0) - g) * s;
    if (!(x > R(1e-9)))
        return R(1.0);
    float a = d / x;
    float c = clamp(cosine, R(0.0), R(1.0));
    float up = c * x + R(1.42);
    float square = x * x * (R(1.0) - c * c) + up * up;
    float below = sqrt(square);
    float image = up * (x / square) * (x / below) * net_flux(s * (below / x), d * (below / x), g);
    float forward = max(g, R(0.0));
    float once = (R(1.0) - forward) * (R(0.31) - R(0.57) * forward) +
                 (R(1.0) - c) * (R(0.18) + forward * (R(0.88) - R(0.65) * forward));
    float net = net_flux(s, d, g);
    float aside = image + once * x / (R(1.0) + (R(10.7) - R(4.3) * forward) * x * x) * net;
    return max(net + (R(1.0) - a) * aside / max(c, least_cosine), R(0.0));
}

// Where the surface is, and how it lies.
struct Surface {
    Bool seen;    // there is one
    vec3 point;   // camera space [m]
    vec3 normal;  // unit; 0 where nobody knows it: then it counts as facing every lamp
};

PURE Surface surface_at(IN(Ray) ray, vec3 normal)
{
    Bool seen = !ray.keep && ray.distance < farthest_surface;
    float size = length(normal);
    Bool known = is_finite(size) && size > R(1e-6);
    vec3 unit = vec3(choose(known, normal.x / size, R(0.0)), choose(known, normal.y / size, R(0.0)),
                     choose(known, normal.z / size, R(0.0)));
    return Surface(seen, choose(seen, ray.distance, R(0.0)) * ray.direction, unit);
}

// d, of the world, in camera axes.
PURE vec3 in_camera(IN(Camera) camera, vec3 d)
{
    return vec3(dot(d, camera.right), dot(d, camera.up), dot(d, camera.back));
}

// Cosine between the normal and the way to the lamp.
PURE float cosine_to(IN(Surface) surface, IN(Light) light)
{
    if (surface.normal == vec3(R(0.0)))
        return R(1.0);
    if (light.type == light_directional)
        return -dot(surface.normal, light.direction);
    vec3 way = light.position - surface.point;
    return dot(surface.normal, way) / max(length(way), R(1e-20));
}

// Irradiance in clear air and without shadows.
PURE vec3 clear_irradiance(IN(Surface) surface, IN(Light) light)
{
    float strength = clamp(cosine_to(surface, light), R(0.0), R(1.0));
    if (light.type != light_directional) {
        vec3 from = surface.point - light.position;
        strength *= fluence(max(length(from), smallest_light), light.radius);
        if (light.type == light_spot)
            strength *= spot_factor(light, dot(from, light.direction) / max(length(from), R(1e-20)));
    }
    return min(min(strength, radiance_limit) * light.intensity, vec3(radiance_limit));
}

// received_share() of each colour. Parallel light comes through a medium that has no end, which the model does not know: its share
// stays as it is.
PURE vec3 received_of_light(IN(Medium) medium, IN(Surface) surface, IN(Light) light, sampler2D gaussians, int gaussian_count)
{
    if (light.type == light_directional)
        return vec3(R(1.0));
    vec3 way = light.position - surface.point;
    float distance = length(way);
    vec3 direction = way / max(distance, R(1e-20));
    float p = terms_to_light(medium, light, surface.point);
    for (int i = 0; i < gaussian_count; ++i)
        p += profile_depth(profile_along(gaussian_at(gaussians, i), surface.point, direction), R(0.0), distance);
    p = clamp(p, R(0.0), density_limit);
    float cosine = cosine_to(surface, light);
    vec3 share = vec3(R(1.0));
    for (int c = 0; c < 3; ++c) {
        if (c > 0 && medium.scattering[c] == medium.scattering[c - 1] && medium.absorption[c] == medium.absorption[c - 1])
            share[c] = share[c - 1];
        else
            share[c] = received_share(min(medium.scattering[c] * p, orders_depth_limit),
                                      min(medium.absorption[c] * p, orders_depth_limit), medium.asymmetry, cosine);
    }
    return share;
}

// Irradiance by an environment of `order` degrees of spherical harmonics (environment.glsl), of which those above 2 hardly count.
PURE vec3 environment_irradiance(sampler2D environment, int order, vec3 normal)
{
    vec3 sum = R(0.886226925453) * vec3(data_texel(environment, 0));
    if (order > 1)
        sum += R(1.02332670795) * (normal.y * vec3(data_texel(environment, 1)) + normal.z * vec3(data_texel(environment, 2)) +
                                   normal.x * vec3(data_texel(environment, 3)));
    if (order > 2) {
        sum += R(0.858085531) * (normal.x * normal.y * vec3(data_texel(environment, 4)) +
                                 normal.y * normal.z * vec3(data_texel(environment, 5)) +
                                 normal.x * normal.z * vec3(data_texel(environment, 7)));
        sum += R(0.2477079561) * (R(3.0) * normal.z * normal.z - R(1.0)) * vec3(data_texel(environment, 6));
        sum += R(0.4290427655) * (normal.x * normal.x - normal.y * normal.y) * vec3(data_texel(environment, 8));
    }
    return max(sum, vec3(R(0.0)));
}

struct SurfaceSettings {
    int light_count;
    int gaussian_count;
    int environment_order;
    int world_normals;
};

// normal: of the layer, or of normal_by_depth().
PURE Surface surface_of(IN(Camera) camera, IN(SurfaceSettings) settings, vec2 pixel, float raw, vec3 normal)
{
    return surface_at(pixel_ray(camera, pixel, raw), settings.world_normals != 0 ? in_camera(camera, normal) : normal);
}

#define SURFACE_IMAGES sampler2D lights, sampler2D ungrouped, sampler2D gaussians, sampler2D environment
#define SURFACE_PASSED lights, ungrouped, gaussians, environment

// The factor of what no lamp's own layer has: the lamps' factors by what they give in clear air, and 1 for the environment's
// part. ungrouped: of each light, 1 where it has a part in that.
PURE vec3 received_of_rest(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES,
                           IN(Surface) surface)
{
    vec3 all = vec3(R(0.0));
    vec3 change = vec3(R(0.0));
    for (int l = 0; l < settings.light_count; ++l) {
        if (data_texel(ungrouped, l).x == R(0.0))
            continue;
        Light light = light_at(lights, l);
        vec3 clear = clear_irradiance(surface, light);
        if (clear == vec3(R(0.0)))
            continue;
        all = min(all + clear, vec3(radiance_limit));
        change += clear * (received_of_light(medium, surface, light, gaussians, settings.gaussian_count) - vec3(R(1.0)));
    }
    if (settings.environment_order > 0)
        all += environment_irradiance(environment, settings.environment_order, in_world(camera, surface.normal));
    return max(vec3(R(1.0)) + change / max(all, vec3(R(1e-30))), vec3(R(0.0)));
}

// What a pixel shows of surfaces before and after: what is still to be divided among lamps, and what was.
struct Divided {
    vec3 rest;
    vec3 lit;
};

// group: the lamp's own layer of the picture.
PURE Divided divided_by_group(IN(Medium) medium, IN(SurfaceSettings) settings, IN(Surface) surface, IN(Light) light,
                              sampler2D gaussians, IN(Divided) pixel, vec3 group)
{
    vec3 own = finite_or_zero(group);
    vec3 share = surface.seen ? received_of_light(medium, surface, light, gaussians, settings.gaussian_count) : vec3(R(1.0));
    return Divided(pixel.rest - own, pixel.lit + own * share);
}

// The pixel in the end; source: as it was.
PURE vec3 relit(IN(Medium) medium, IN(Camera) camera, IN(SurfaceSettings) settings, SURFACE_IMAGES, IN(Surface) surface,
                vec3 source, IN(Divided) pixel, float limit)
{
    if (!surface.seen)
        return source;
    vec3 share = received_of_rest(medium, camera, settings, SURFACE_PASSED, surface);
    vec3 sum = finite_or_zero(pixel.rest) * share + pixel.lit;
    return vec3(composed(source.x, R(0.0), sum.x, limit), composed(source.y, R(0.0), sum.y, limit),
                composed(source.z, R(0.0), sum.z, limit));
}

// A point of the surface that a neighbouring pixel shows, relative to `point`; huge where it shows none.
PURE vec3 step_to(IN(Ray) ray, vec3 point)
{
    return ray.distance < farthest_surface ? ray.distance * ray.direction - point : vec3(R(1e15));
}

// Of two steps, one against the other, the shorter: beyond an edge surfaces are far.
PURE vec3 shorter_step(vec3 after, vec3 before)
{
    return dot(after, after) <= dot(before, before) ? after : -before;
}

PURE vec3 normal_by_depth(IN(Ray) ray, IN(Ray) left, IN(Ray) right, IN(Ray) before, IN(Ray) after)
{
    if (ray.distance >= farthest_surface)
        return vec3(R(0.0));
    vec3 point = ray.distance * ray.direction;
    vec3 u = shorter_step(step_to(right, point), step_to(left, point));
    vec3 v = shorter_step(step_to(after, point), step_to(before, point));
    vec3 n = cross(u / max(length(u), R(1e-20)), v / max(length(v), R(1e-20)));
    float size = length(n);
    if (max(dot(u, u), dot(v, v)) > R(1e26) || size < R(1e-6))
        return vec3(R(0.0));
    return (dot(n, ray.direction) > R(0.0) ? -n : n) / size;
}
