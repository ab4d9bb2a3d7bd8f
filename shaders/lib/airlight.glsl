// Airlight: what lights scatter once toward the camera (Sun et al. 2005 sec. 3, Zhou et al. 2007 sec. 3),
//   L = int_0^D C_s (rho_0 + sum_i color_i rho_i) p(mu) I / d^2 e^(-C_t (P(v,x) + P(x,s))) dt.
// What its tiers share. Needs shadow.glsl, shadow_map.glsl, lit.glsl.

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
    int shadowed;          // 1: some light has a shadow map
    float spared;          // share of a pixel's light that those lights may have which it leaves out
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

PURE Gaussian listed_gaussian(sampler2D gaussians, sampler2D tile_gaussians, IN(Sight) sight, int i)
{
    return gaussian_at(gaussians, int(data_texel(tile_gaussians, sight.first + i).x));
}
