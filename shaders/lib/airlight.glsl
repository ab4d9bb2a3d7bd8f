// Airlight: what lights scatter once toward the camera (Sun et al. 2005 sec. 3, Zhou et al. 2007 sec. 3),
//   L = int_0^D C_s (rho_0 + sum_i colour_i rho_i) p(mu) I / d^2 e^(-C_t (P(v,x) + P(x,s))) dt.
// What its tiers share. Needs shadow.glsl, shadow_map.glsl, phase.glsl.

const int airlight_sun = 0;
const int airlight_fogshop = 1;
const int airlight_nodes = 2;
const int airlight_reference = 3;

const int orders_single = 0;
const int orders_all = 1;  // tiers nodes and reference

struct AirlightSettings {
    int light_count;
    int gaussian_count;
    int environment_order; // of the spherical harmonics, 0 (none) to 6
    // nodes:
    int panels;            // of 8 nodes, at most per light and term or Gaussian
    int dense_from;        // lists of more Gaussians are integrated as one
    int cells;             // of that integral, at most max_cells
    float tolerance;       // of a panel, relative to the whole
    float near_radii;      // a light nearer than so many radii of a Gaussian needs other nodes
    float culled;          // share of the airlight that may be missing by what the lists leave out
    int orders;
    ivec4 shadowed;        // 1 + the light that map shadow_0 to shadow_3 is of; 0: there is none
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

// blob_density: texel i (1 + light_count) + k is int rho dt between origin k (shadow.glsl) and the centre of Gaussian i, without
// its own (airlight_fogshop.glsl). sun_table: airlight_sun.glsl. surroundings: surroundings.glsl, of orders_all.
#define AIRLIGHT_IMAGES SHADOW_IMAGES, sampler2D lights, sampler2D tile_gaussians, sampler2D blob_density, sampler2D sun_table, \
                        sampler2D surroundings, \
                        SHADOW_MAP_IMAGES
#define AIRLIGHT_PASSED SHADOW_PASSED, lights, tile_gaussians, blob_density, sun_table, surroundings, SHADOW_MAP_PASSED

// Bounds what a light of no size does at its own place.
const float smallest_light = R(1e-6);       // [m]
const float smallest_light_angle = R(1e-4); // as seen from the camera
const float radiance_limit = R(1e30);

// Where a light stands to a ray: the ray's point nearest to it, and how far it is from there.
struct Aspect {
    float foot;
    float height;
};

PURE Aspect aspect_of(IN(Light) light, vec3 direction)
{
    float least = max(smallest_light, smallest_light_angle * length(light.position));
    return Aspect(dot(light.position, direction), max(length(cross(direction, light.position)), least));
}

// Radiance integrated over the directions from which a sphere of radius R and intensity 1 shines on a point at distance d:
// its solid angle over pi R^2, which is 1/d^2 from afar, and twice that where it is touched; constant within.
PURE float fluence(float d, float radius)
{
    float x = max(d, radius);
    return R(2.0) / (x * x + x * sqrt((x - radius) * (x + radius)));
}

// p I / d^2 at t for I = 1, without extinction.
PURE float lit_strength(IN(Medium) medium, IN(Light) light, IN(Aspect) aspect, vec3 direction, float t)
{
    if (light.type == light_directional)
        return phase(medium, -dot(light.direction, direction));
    float x = t - aspect.foot;
    float d = sqrt(aspect.height * aspect.height + x * x);
    float s = phase(medium, -x / d) * fluence(d, light.radius);
    if (light.type == light_spot) {
        vec3 from = t * direction - light.position;
        s *= spot_factor(light, dot(from, light.direction) / max(length(from), R(1e-20)));
    }
    return s;
}

// int rho dt of the constant and exponential terms between the light and a point.
PURE float terms_to_light(IN(Medium) medium, IN(Light) light, vec3 point)
{
    if (light.type == light_directional)
        return density_between(medium, point, -light.direction, far_away, light.distance);
    vec3 way = light.position - point;
    float d = length(way);
    return density_between(medium, point, way / max(d, R(1e-20)), d, d);
}

PURE Gaussian listed_gaussian(sampler2D gaussians, sampler2D tile_gaussians, IN(Sight) sight, int i)
{
    return gaussian_at(gaussians, int(data_texel(tile_gaussians, sight.first + i).x));
}
