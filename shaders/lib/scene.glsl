// What effects see of the scene: camera-relative, in metres. The members are those of brume_plugin_medium and
// brume_plugin_camera (brume_plugin.h); the host fills uniforms of these types by member name.

const int max_density_terms = 16;

struct Medium {
    vec3 scattering;   // sigma_s at unit density [1/m]
    vec3 absorption;   // sigma_a at unit density [1/m]
    vec3 emission;     // at unit density [radiance/m]
    vec3 luminance;    // weights of the working space
    vec4 phase;        // g of Henyey-Greenstein, g and alpha of Draine, weight of Draine
    vec4 noise;        // of the view ray at Gaussians: strength in radii, lattice points per metre, seed
    vec3 noise_shift;  // the camera's place in the noise's lattice
    float asymmetry;   // g, mean cosine of the phase function
    float constant;    // sum of the constant density terms
    int term_count;
    vec4 terms[max_density_terms];  // exponential: xyz = falloff * direction in camera space, w = log density at the camera
};

struct Camera {
    vec2 focal;          // [px]
    vec2 tangent_scale;  // tangent per pixel; y has the sign of the image's origin
    vec2 center;         // principal point [px]
    int depth_kind;
    int sky;
    vec2 depth_range;
    float far_distance;
    float sky_distance;
    float metres_per_unit;
    int nonpositive;
    vec3 right;          // the camera's axes in the world
    vec3 up;
    vec3 back;
};
