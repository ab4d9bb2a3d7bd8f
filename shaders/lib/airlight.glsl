// Airlight: what lights scatter once toward the camera (Sun et al. 2005 sec. 3, Zhou et al. 2007 sec. 3),
//   L = int_0^D C_s (rho_0 + sum_i colour_i rho_i) p(mu) I / d^2 e^(-C_t (P(v,x) + P(x,s))) dt.
// What its tiers share. Needs shadow.glsl, phase.glsl.

const int airlight_sun = 0;
const int airlight_fogshop = 1;
const int airlight_nodes = 2;
const int airlight_reference = 3;

struct AirlightSettings {
    int tier;
    int light_count;
    int gaussian_count;
    int smooth_nodes;   // per light, for the constant and exponential terms
    int blob_nodes;     // per light and Gaussian
    int near_nodes;     // the same where the light is within near_radii
    int dense_nodes;    // per light, for all that a long list holds
    int dense_from;     // lists of more Gaussians are integrated as one
    int environment_order; // of the spherical harmonics, 0 (none) to 6
    float near_radii;
    float culled;       // [m at unit density] at most missing from the lists, per path
};

struct Airlight {
    vec3 radiance;
    vec3 error;  // estimate of |radiance - exact|
};

// The pixel's ray, and what its tile lists: the Gaussians tile_gaussians[first .. first + count).
struct Sight {
    vec3 direction;  // unit
    float distance;  // [m], 0 to far_away
    int first;
    int count;
};

// blob_density: texel i (1 + light_count) + k is int rho dt of all Gaussians between origin k (shadow.glsl) and the centre of
// Gaussian i. sun_table: airlight_sun.glsl.
#define AIRLIGHT_IMAGES SHADOW_IMAGES, sampler2D lights, sampler2D tile_gaussians, sampler2D blob_density, sampler2D sun_table
#define AIRLIGHT_PASSED SHADOW_PASSED, lights, tile_gaussians, blob_density, sun_table

// Bounds what a light of no size does at its own place.
const float smallest_light = R(1e-6);       // [m]
const float smallest_light_angle = R(1e-4); // as seen from the camera
const float radiance_limit = R(1e30);

PURE float apparent_radius(IN(Light) light)
{
    return max(max(light.radius, smallest_light), smallest_light_angle * length(light.position));
}

// Radiance integrated over the directions from which a sphere of radius R and intensity 1 shines on a point at distance d:
// its solid angle over pi R^2, which is 1/d^2 from afar, and twice that where it is touched; constant within.
PURE float fluence(float d, float radius)
{
    float x = max(d, radius);
    return R(2.0) / (x * x + x * sqrt((x - radius) * (x + radius)));
}

PURE Gaussian listed_gaussian(sampler2D gaussians, sampler2D tile_gaussians, IN(Sight) sight, int i)
{
    return gaussian_at(gaussians, int(data_texel(tile_gaussians, sight.first + i).x));
}

// P(v, x(t)) of all terms.
PURE float sight_density(IN(Medium) medium, sampler2D gaussians, sampler2D tile_gaussians, IN(Sight) sight, float t)
{
    float p = density_integral(medium, sight.direction, t);
    for (int i = 0; i < sight.count; ++i) {
        Gaussian g = listed_gaussian(gaussians, tile_gaussians, sight, i);
        p += profile_depth(profile_along(g, vec3(R(0.0)), sight.direction), R(0.0), t);
    }
    return min(p, density_limit);
}

// What of a light arrives at the point t along the ray and is turned into it, per unit of scattering: p I / d^2 e^-tau.
PURE vec3 turned_light(IN(Medium) medium, IN(Camera) camera, SHADOW_IMAGES, IN(Sight) sight, int index, IN(Light) light,
                       float t, float view_density)
{
    vec3 point = t * sight.direction;
    float strength;
    float depth = view_density;
    if (light.type == light_directional) {
        strength = phase(medium, -dot(light.direction, sight.direction));
        depth += density_between(medium, point, -light.direction, far_away, light.distance);
    } else {
        vec3 from = point - light.position;
        float d = length(from);
        vec3 way = from / max(d, R(1e-20));
        strength = phase(medium, -dot(way, sight.direction)) * fluence(d, apparent_radius(light));
        if (light.type == light_spot)
            strength *= spot_factor(light, dot(way, light.direction));
        depth += density_between(medium, point, -way, d, d);
    }
    if (strength <= R(0.0))
        return vec3(R(0.0));
    depth += shadow_density(SHADOW_PASSED, camera, index, light, point);
    return min(strength * light.intensity, vec3(radiance_limit)) * transmittance(medium, min(depth, density_limit));
}
